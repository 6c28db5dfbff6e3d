"""An independent solver: Eq. (4) as a quartic in tan(θ/2), in 60 digits.

The merged equation, before its root is taken, is (1 − μ²) N² − 2 B N + T² − W² = 0 with N from the
moment equation. N and B are linear in sin θ and cos θ, so that with t = tan(θ/2) it becomes a
polynomial of degree four. mpmath finds all of its roots; those of the other branch are told by the
sign of B − (1 − μ²) N, which is R on the paper's branch and −R on the other.
"""

from __future__ import annotations

import itertools
import warnings
from typing import NamedTuple

import mpmath as mp

from tendon_statics import JointDesign

DIGITS = 60


class Solution(NamedTuple):
    """All that a comparison needs."""

    regime: str
    roots: list[float]
    """Angles in rad, from 0 to the stop, on the side of the stronger cable"""
    pressure: float | None
    doubtful: bool
    """Whether a root lies so near an end or another root that rounding decides the count"""


def solve_quartic(design: JointDesign, tension_l: float, tension_s: float) -> Solution:
    """Solve for one pair of valid tensions."""
    with mp.workdps(DIGITS):
        return _solve(design, *sorted((mp.mpf(tension_l), mp.mpf(tension_s))))


def _solve(design: JointDesign, weak: mp.mpf, strong: mp.mpf) -> Solution:
    mu, r, delta, arm = (
        mp.mpf(value)
        for value in (
            design.friction_coefficient,
            design.ball_radius,
            design.cable_offset,
            design.com_distance,
        )
    )
    total = weak + strong
    weight = mp.mpf(design.mass) * mp.mpf(design.gravity)
    beta = (mp.mpf(design.contact_start_angle) + mp.mpf(design.contact_end_angle)) / 2
    eta = (mp.mpf(design.contact_end_angle) - mp.mpf(design.contact_start_angle)) / 2
    stop = mp.mpf(design.max_bend_angle)
    offset, gain = (strong - weak) * (r + delta) / (mu * r), weight * arm / (mu * r)
    constant = total**2 - weight**2

    def moment(theta):
        return offset + gain * mp.sin(theta)

    def linear(theta):
        return total - mu * weight * mp.sin(beta + theta)

    def force(theta):
        b = linear(theta)
        if mu == 1:
            return constant / (2 * b)
        return (b - mp.sqrt(b**2 - (1 - mu**2) * constant)) / (1 - mu**2)

    # Coefficients of 1, t, t² after multiplying with 1 + t².
    n = [offset, 2 * gain, offset]
    p, q = mu * weight * mp.sin(beta), mu * weight * mp.cos(beta)
    b = [total - p, -2 * q, total + p]
    one = [mp.mpf(1), mp.mpf(0), mp.mpf(1)]
    coefficients = [
        (1 - mu**2) * nn - 2 * bn + constant * oo
        for nn, bn, oo in zip(_times(n, n), _times(b, n), _times(one, one), strict=True)
    ]
    while coefficients and abs(coefficients[-1]) < mp.mpf(10) ** (10 - DIGITS) * total**2:
        coefficients.pop()
    found, doubtful = [], False
    tolerance = mp.mpf(10) ** -9
    with warnings.catch_warnings():
        # mpmath 1.4 asks for an argument that 1.2, Ubuntu 24.04's, does not have.
        warnings.simplefilter('ignore', DeprecationWarning)
        parameters = mp.polyroots(coefficients[::-1], maxsteps=500, extraprec=400)
    for t in parameters:
        theta = 2 * mp.atan(mp.re(t))
        near_real = abs(mp.im(t)) < tolerance
        near_range = -tolerance < theta < stop + tolerance
        if near_real and near_range:
            ends = min(abs(theta), abs(theta - stop))
            doubtful |= ends < tolerance or abs(mp.im(t)) > mp.mpf(10) ** -40
            normal = moment(theta)
            if normal > 0 and linear(theta) - (1 - mu**2) * normal > 0:
                found.append(theta)
    # Two that all but merge, whether on the range or beside it, real or not: between them the
    # equation is flat, so that the rounding of a double moves them by more than is tested.
    merging = mp.mpf(10) ** -6
    doubtful |= any(
        abs(a - b) < merging and -merging < 2 * mp.atan(mp.re(a)) < stop + merging
        for a, b in itertools.combinations(parameters, 2)
    )
    found.sort()
    doubtful |= any(b - a < tolerance for a, b in itertools.pairwise(found))
    if found:
        regime, theta = 'equilibrium', found[0]
    elif moment(0) > force(mp.mpf(0)):
        regime, theta = 'driven_to_stop', stop
    else:
        return Solution('held', [], None, doubtful)
    pressure = force(theta) / (2 * r * mp.sin(eta) * mp.mpf(design.contact_width))
    return Solution(regime, [float(root) for root in found], float(pressure), doubtful)


def _times(left: list, right: list) -> list:
    product = [mp.mpf(0)] * (len(left) + len(right) - 1)
    for i, a in enumerate(left):
        for j, b in enumerate(right):
            product[i + j] += a * b
    return product
