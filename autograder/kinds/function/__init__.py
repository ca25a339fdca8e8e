"""Function: code, compared by what it returns."""
