def heaviest(weights):
    """Return the weight of the heaviest apple."""
    most = weights[0]  # the reference's own comment
    for weight in weights:
        most = max(most, weight)
    return most


def forgets_the_first(weights):
    return max(weights[1:], default=0.0)


def lightest(weights):
    return min(weights)


def heaviest_cases(rng):
    hidden = [float(w) for w in rng.uniform(50, 250, 6)]
    return [
        {"name": "three apples", "args": [[120.0, 180.0, 150.0]], "public": True},
        {"name": "the first is the heaviest", "args": [[251.5, *hidden]]},
        {"name": "a basket", "args": [[49.0, *hidden]]},
    ]
