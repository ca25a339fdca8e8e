"""Text: an answer in words, which a person marks by a rubric."""
