"""What maintains the repository itself; not part of the package."""
