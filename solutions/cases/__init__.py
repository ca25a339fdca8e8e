"""Inputs for the function questions, and how a result is compared with the reference's."""
