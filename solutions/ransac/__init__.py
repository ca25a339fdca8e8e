"""RANSAC: lines, planes and walls as the course explains them, and the probabilities."""
