"""Paths become a report, in processes that may die."""
