"""The same for many scans at once."""
