"""Queries to USD: about many prims at once, and about one attribute over time."""
