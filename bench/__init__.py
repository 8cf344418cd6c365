"""Benchmarks: how much longer than bare USD the linter takes."""
