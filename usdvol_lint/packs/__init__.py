"""Loads folders of rules and their pages, and selects the active rules."""
