"""The scalar Kalman filter: a reference, its known mistakes, and inputs that tell them apart."""


def correct(mean, variance, reading, noise):
    """Return mean and variance after a reading with the variance `noise`, as a tuple."""
    gain = variance / (variance + noise)
    return mean + gain * (reading - mean), (1 - gain) * variance


def keeps_variance(mean, variance, reading, noise):
    gain = variance / (variance + noise)
    return mean + gain * (reading - mean), variance


def swaps_gain(mean, variance, reading, noise):
    gain = noise / (variance + noise)
    return mean + gain * (reading - mean), (1 - gain) * variance


def correct_cases(rng):
    """Return inputs: a public one that students see, and hidden ones that are drawn anew."""
    mean, variance, reading, noise = map(float, rng.uniform([60, 2, 60, 0.5], [80, 9, 80, 1.5]))
    return [
        {"name": "a guess of 72 kg", "args": [72.0, 4.0, 70.0, 1.0], "public": True},
        {"name": "any weight", "args": [mean, variance, reading, noise]},
        {"name": "a scale without noise", "args": [mean, variance, reading, 0.0]},
    ]
