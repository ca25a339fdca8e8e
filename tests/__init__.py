"""The tests: a regular package, since old versions of IPython put another `tests` on the path."""
