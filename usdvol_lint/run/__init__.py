"""Runs the engine in worker processes, which may die, and collects their reports."""
