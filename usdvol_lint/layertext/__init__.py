"""The text of `.usda` layers: where specs stand in it, and what USD reads there and drops."""
