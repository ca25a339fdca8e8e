"""Small systematic changes of what is right: they prove the hidden cases, and name mistakes."""
