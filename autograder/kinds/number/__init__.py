"""Number: one value."""
