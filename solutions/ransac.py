"""RANSAC: find a model that many points agree with, although most may not."""

from solutions.ransac_probabilities import (
    candidate_count,
    outlier_model_probability,
    required_iterations,
    success_probability,
)

__all__ = [
    "candidate_count",
    "outlier_model_probability",
    "required_iterations",
    "success_probability",
]
