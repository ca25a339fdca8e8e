"""Tells a kernel that its notebook is being built."""

# Set while a notebook is built, whose file is written only after it has run.
BUILDING = "AUTOGRADER_BUILDING"
