"""``tendon-statics plot residual``: Eq. (4) over the bend angle, as in the paper's Fig. 2."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from ..physics import residual
from .figures import BLUE, VERMILION
from .load_text import DEFAULT_LAW
from .pair_options import add_pair_options, between, pair_from, pair_title

if TYPE_CHECKING:
    from matplotlib.figure import Figure

POINTS = 301

add_arguments = add_pair_options


def draw(drawing: Figure, options: argparse.Namespace) -> None:
    """Draw the residual and its root."""
    design, equilibrium = pair_from(options)
    axes = drawing.subplots()
    weak, strong = sorted((equilibrium.tension_l, equilibrium.tension_s))
    load = equilibrium.load
    if equilibrium.tension_l > equilibrium.tension_s:
        load = load.mirrored()  # as the unit slips towards cable s
    stop = design.max_bend_angle
    angles = between(0.0, stop, POINTS)
    values = [
        residual(design, weak, strong, angle, load) / design.contact_area for angle in angles
    ]
    axes.axhline(0.0, color='black', linewidth=0.8)
    axes.plot([math.degrees(angle) for angle in angles], values, color=BLUE)
    if equilibrium.root_count and equilibrium.bend_angle is not None:
        angle = math.degrees(abs(equilibrium.bend_angle))
        axes.plot([angle], [0.0], 'o', color=VERMILION)
        is_right = angle > 0.5 * math.degrees(stop)
        axes.annotate(
            f'θ = {angle:.2f}°, p = {equilibrium.pressure:.1f} Pa',
            (angle, 0.0),
            xytext=(-8, 10) if is_right else (8, -16),
            textcoords='offset points',
            horizontalalignment='right' if is_right else 'left',
        )
    axes.set_xlim(0.0, math.degrees(stop))
    axes.set_xlabel('bend angle θ towards the stronger cable [°]')
    equation = 'Eq. (4), left − right-hand side'
    if design.contact_law != DEFAULT_LAW:
        equation = '(M − K) / (μ r) per area of contact'
    axes.set_ylabel(f'{equation} [Pa]')
    axes.set_title(pair_title(equilibrium), fontsize=10)
