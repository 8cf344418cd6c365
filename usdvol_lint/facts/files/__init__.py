"""The files that asset attributes name: where each value leads, and what is there."""
