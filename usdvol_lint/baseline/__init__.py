"""What a library of stages is known to have: written to a file, read again, and compared."""
