"""Writing the course: masters become notebooks, and the course proves itself."""
