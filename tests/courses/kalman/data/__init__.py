"""The data of the course: a person who weighs 70 kg, on a scale that trembles."""

from pathlib import Path

import numpy as np

WHOSE = "the Kalman filter's"


def weighings() -> np.ndarray:
    """Return (20,) readings in kg; their standard deviation is 1 kg."""
    return np.loadtxt(Path(__file__).with_name("weighings.csv"), skiprows=1)
