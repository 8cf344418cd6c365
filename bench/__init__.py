"""Benchmarks: the time of the linter in relation to that of bare USD."""
