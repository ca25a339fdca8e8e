"""A package, so that notebooks can import modules that you put beside them."""
