"""What is authored on prims, held against what the schemas declare."""
