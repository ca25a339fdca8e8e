"""Runs beside the student's code."""
