"""Gradescope: the zip to upload, what runs in its container, and the results it reads."""
