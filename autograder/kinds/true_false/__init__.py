"""True or false: a table of statements."""
