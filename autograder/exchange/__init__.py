"""What crosses between trusted and untrusted processes: formats and their checks, no policy."""
