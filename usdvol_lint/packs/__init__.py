"""Folders of rules and their pages become what is in force."""
