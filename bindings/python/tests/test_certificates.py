"""What solutions claim, against exact rational arithmetic."""

import math
import random
from fractions import Fraction

import pytest

import roundel

HALF = Fraction(1, 2)


def problem(draw, offset, scale):
    """Rows of small numbers around a point far from zero, and their right sides: two unknowns."""
    rows = [[float(draw.randint(-5, 5) + 7 * (k == j)) for j in range(2)] for k in range(3)]
    point = [offset * draw.uniform(-1, 1) for _ in range(2)]
    b = [sum(a * x for a, x in zip(row, point)) + 0.3 * draw.uniform(-1, 1) for row in rows]
    return rows, b, [scale] * 3


def energy(rows, b, weights, x):
    """The exact energy at exact values."""
    residuals = [sum(Fraction(a) * v for a, v in zip(row, x)) - Fraction(r) for row, r in zip(rows, b)]
    return sum(Fraction(w) * r * r for w, r in zip(weights, residuals))


def least(rows, b, weights, integers):
    """The exact optimum: the last unknown is integer if there are two integers."""
    normal = [[sum(Fraction(w) * Fraction(r[i]) * Fraction(r[j]) for r, w in zip(rows, weights)) for j in range(2)] for i in range(2)]
    pull = [sum(Fraction(w) * Fraction(r[i]) * Fraction(v) for r, v, w in zip(rows, b, weights)) for i in range(2)]

    def best_for(x0):
        x1 = (pull[1] - normal[0][1] * x0) / normal[1][1]
        if integers == 2:
            x1 = Fraction(math.floor(x1 + HALF))
        return energy(rows, b, weights, (x0, x1))

    # The energy over the relaxation is at least `curvature` times the square of the distance of x0 from its
    # relaxed value, so integers further away than this are worse than the nearest.
    determinant = normal[0][0] * normal[1][1] - normal[0][1] ** 2
    curvature = determinant / normal[1][1]
    centre = (pull[0] * normal[1][1] - pull[1] * normal[0][1]) / determinant
    relaxed = energy(rows, b, weights, (centre, (pull[1] - normal[0][1] * centre) / normal[1][1]))
    nearest = math.floor(centre + HALF)
    within = math.isqrt(math.ceil((best_for(Fraction(nearest)) - relaxed) / curvature)) + 2
    return min(best_for(Fraction(x0)) for x0 in range(nearest - within, nearest + within + 1))


@pytest.mark.parametrize("integers", [1, 2])
@pytest.mark.parametrize("scale", [2.0**-40, 1.0, 1e12])
@pytest.mark.parametrize("offset", [1e2, 1e4, 1e6, 1e8])
def test_no_bound_is_above_the_optimum_and_no_energy_is_another(offset, scale, integers):
    draw = random.Random(f"{offset} {scale} {integers}")
    for _ in range(25):
        rows, b, weights = problem(draw, offset, scale)
        found = roundel.solve(A=rows, b=b, weights=weights, integers=list(range(integers)), strategy="exact")
        optimum = least(rows, b, weights, integers)
        there = energy(rows, b, weights, [Fraction(v) for v in found.values])
        assert found.proved
        assert found.lower_bound <= optimum
        assert abs(Fraction(found.energy) - there) <= there / 10**9
        # The continuous unknown is rounded to a float.
        rounding = sum(w * (16 * offset * 2.0**-52) ** 2 for w in weights)
        assert there <= optimum * (1 + Fraction(1, 10**9)) + Fraction(rounding)
