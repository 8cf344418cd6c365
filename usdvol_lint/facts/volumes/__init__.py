"""What Volumes bind, where that stands, and whether their extents enclose it."""
