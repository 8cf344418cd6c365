"""Faults that runs have to end well with: see `python -m tests.faults --help`."""
