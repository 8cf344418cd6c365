"""The command line: its arguments, outputs and progress bar."""
