"""What a person types and reads: the command line, its outputs, its progress."""
