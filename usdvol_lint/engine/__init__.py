"""A stage becomes findings."""
