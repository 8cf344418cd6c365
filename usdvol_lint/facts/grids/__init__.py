"""The grids that fields ask for, and those that their files hold."""
