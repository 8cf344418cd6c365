"""The layers that a stage is composed of, and what could not be composed."""
