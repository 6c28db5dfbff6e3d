"""``tendon-statics plot unit``: the unit at its bend angle, as in the paper's Fig. 1."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING, Any

from .figures import BLUE, GREEN, ORANGE, VERMILION
from .options import UsageError
from .pair_options import add_pair_options, between, pair_from, pair_title

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZE = (6.4, 4.6)

add_arguments = add_pair_options


def draw(drawing: Figure, options: argparse.Namespace) -> None:
    """Draw the unit, its contact zone and the forces on it."""
    design, equilibrium = pair_from(options)
    axes = drawing.subplots()
    if equilibrium.bend_angle is None:
        raise UsageError(
            f'the unit is drawn at its bend angle, and these tensions do not determine it: '
            f'{equilibrium.regime}'
        )
    theta = equilibrium.bend_angle
    side = math.copysign(1.0, theta)
    millimetre = 1e3
    r = design.ball_radius * millimetre
    arm = r + design.cable_offset * millimetre
    com = design.com_distance * millimetre

    def turned(x: float, z: float) -> tuple[float, float]:
        """Coordinates in the ground frame of a point of the unit."""
        return (
            x * math.cos(theta) + z * math.sin(theta),
            z * math.cos(theta) - x * math.sin(theta),
        )

    def polyline(points: list[tuple[float, float]], **style: Any) -> None:
        axes.plot([x for x, _ in points], [z for _, z in points], **style)

    def arrow(tail: tuple[float, float], tip: tuple[float, float], colour: str) -> None:
        style = {'arrowstyle': '-|>', 'color': colour, 'linewidth': 1.8, 'mutation_scale': 14}
        axes.annotate('', xy=tip, xytext=tail, arrowprops=style)

    # The ball of the unit below, and the unit that turns on it.
    circle = [2.0 * math.pi * index / 120 for index in range(121)]
    axes.fill([r * math.sin(a) for a in circle], [r * math.cos(a) for a in circle], '#e4e4e4')
    axes.text(0.0, -0.62 * r, 'ball', ha='center', va='center', color='#666666')
    top = max(1.6 * r, 1.5 * abs(com))
    base = min(0.1 * r, r * math.cos(design.contact_end_angle))
    rim = [a * side for a in between(design.contact_start_angle, design.contact_end_angle)]
    shell = [(r * math.sin(a), r * math.cos(a)) for a in between(-math.pi / 2, math.pi / 2)]
    outline = [(-1.12 * arm, base), (-1.12 * arm, top), (1.12 * arm, top), (1.12 * arm, base)]
    body = [turned(x, z) for x, z in [*outline, *reversed([p for p in shell if p[1] >= base])]]
    axes.fill([x for x, _ in body], [z for _, z in body], facecolor='#cfe3f1', edgecolor=BLUE)
    polyline(
        [turned(r * math.sin(a), r * math.cos(a)) for a in rim],
        color=VERMILION,
        linewidth=5.0,
        solid_capstyle='butt',
    )

    # Axes and the angle between them.
    length = 1.25 * top
    polyline([(0.0, 0.0), (0.0, length)], color='black', linewidth=0.8, linestyle='--')
    polyline([(0.0, 0.0), turned(0.0, length)], color='black', linewidth=0.8, linestyle='--')
    polyline(
        [(1.15 * top * math.sin(a), 1.15 * top * math.cos(a)) for a in between(0.0, theta)],
        color='black',
        linewidth=1.0,
    )
    middle = 0.5 * theta
    axes.text(1.2 * top * math.sin(middle), 1.2 * top * math.cos(middle), 'θ', ha='center')

    # Forces: the cables pull along the unit's axis, the weight down.
    pull = 0.9 * top
    for name, tension, x in (
        ('l', equilibrium.tension_l, -arm),
        ('s', equilibrium.tension_s, arm),
    ):
        longest = max(equilibrium.tension_l, equilibrium.tension_s)
        end = turned(x, base - 0.35 * pull - 0.65 * pull * tension / longest)
        arrow(turned(x, top), end, GREEN)
        axes.annotate(
            f'T_{name} = {tension:g} N',
            end,
            xytext=(0, -4),
            textcoords='offset points',
            ha='center',
            va='top',
            color=GREEN,
        )
    centre = turned(0.0, com)
    arrow(centre, (centre[0], centre[1] - 0.55 * r), ORANGE)
    axes.plot(*centre, 'o', color=ORANGE, markersize=6)
    axes.annotate('W, at l', centre, xytext=(7, 2), textcoords='offset points', color='black')
    axes.plot(0.0, 0.0, 'o', color='black', markersize=3)

    contact = 0.5 * (design.contact_start_angle + design.contact_end_angle) * side
    axes.annotate(
        'contact zone,\nθ1 to θ2',
        turned(r * math.sin(contact), r * math.cos(contact)),
        xytext=(side * 1.75 * arm, -0.4 * top),
        ha='center',
        color=VERMILION,
        arrowprops={'arrowstyle': '-', 'color': VERMILION, 'linewidth': 0.8},
    )
    axes.set_aspect('equal')
    axes.set_xlabel('X_G, towards cable s [mm]')
    axes.set_ylabel('Z_G [mm]')
    axes.set_xlim(-2.2 * arm, 2.2 * arm)
    axes.set_ylim(-1.3 * top, 1.35 * top)
    axes.set_title(
        f'θ = {math.degrees(theta):.2f}°, p = {equilibrium.pressure:.1f} Pa, '
        + pair_title(equilibrium),
        fontsize=10,
    )
