"""Practice: fresh variants of questions, marked at once, without points and without end."""
