"""Opens a stage, runs the rules on it, and makes findings of what they yield."""
