"""Expression: a formula, compared by its values."""
