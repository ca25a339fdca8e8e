"""What leaves the instructor's hands: the student bundle, and the grader for Gradescope."""
