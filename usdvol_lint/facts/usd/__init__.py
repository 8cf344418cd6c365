"""What USD says, asked in one way: of many prims at once, of one attribute over time."""
