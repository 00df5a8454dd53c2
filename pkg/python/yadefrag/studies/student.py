"""Student's t distribution of a whole number of degrees of freedom."""

import math


def within(t: float, freedom: int) -> float:
    """Probability of a value from -t to t: Abramowitz and Stegun 1964, 26.7.3 and 26.7.4."""
    angle = math.atan(t / math.sqrt(freedom))
    cosine, sine = math.cos(angle), math.sin(angle)
    isOdd = freedom % 2
    term = cosine if isOdd else 1.
    total = term if freedom > 1 else 0.
    for k in range(3 if isOdd else 2, freedom - 1, 2):
        term *= (k - 1) / k * cosine**2
        total += term
    return 2 / math.pi * (angle + sine * total) if isOdd else sine * total


def quantile(confidence: float, freedom: int) -> float:
    """Inverse of `within`: the t for which a value is from -t to t with probability 0 < confidence < 1."""
    if freedom > 1000:  # then the normal distribution differs by less than 10⁻³
        from statistics import NormalDist
        return NormalDist().inv_cdf((1 + confidence) / 2)
    low, high = 0., 1.
    while within(high, freedom) < confidence and high < 1e300:
        high *= 2
    for _ in range(200):
        middle = (low + high) / 2
        if not low < middle < high:
            break
        low, high = (middle, high) if within(middle, freedom) < confidence else (low, middle)
    return (low + high) / 2
