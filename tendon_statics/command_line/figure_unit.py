"""``tendon-statics plot unit``: the unit at its bend angle, as in the paper's Fig. 1."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING, Any

from .figures import BLUE, TENSION_L, TENSION_S, VERMILION
from .options import UsageError
from .pair_options import add_pair_options, between, pair_from, pair_title

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZE = (6.4, 4.6)

WEIGHT = '#555555'

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
    load = equilibrium.load
    tilt = load.base_tilt
    side = math.copysign(1.0, theta)
    millimetre = 1e3
    r = design.ball_radius * millimetre
    arm = r + design.cable_offset * millimetre
    com = design.com_distance * millimetre

    def turned(x: float, z: float, angle: float = tilt + theta) -> tuple[float, float]:
        """Coordinates in the ground frame of a point of the unit, or of what has the angle."""
        return (
            x * math.cos(angle) + z * math.sin(angle),
            z * math.cos(angle) - x * math.sin(angle),
        )

    def polyline(points: list[tuple[float, float]], **style: Any) -> None:
        axes.plot([x for x, _ in points], [z for _, z in points], **style)

    def arrow(tail: tuple[float, float], tip: tuple[float, float], colour: str) -> None:
        style = {'arrowstyle': '-|>', 'color': colour, 'linewidth': 1.8, 'mutation_scale': 14}
        axes.annotate('', xy=tip, xytext=tail, arrowprops=style)

    # The base with its ball, and the unit that turns on it.
    stem = [
        (-0.55 * r, -0.8 * r),
        (-0.55 * r, -1.7 * r),
        (0.55 * r, -1.7 * r),
        (0.55 * r, -0.8 * r),
    ]
    foot = [turned(x, z, tilt) for x, z in stem]
    axes.fill([x for x, _ in foot], [z for _, z in foot], '#f1f1f1')
    circle = [2.0 * math.pi * index / 120 for index in range(121)]
    axes.fill([r * math.sin(a) for a in circle], [r * math.cos(a) for a in circle], '#e4e4e4')
    axes.text(*turned(0.0, -0.62 * r, tilt), 'ball', ha='center', va='center', color='#666666')
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

    # Axes and the angles between them: vertical, the base's, the unit's.
    length = 1.25 * top
    for axis in (tilt, tilt + theta):
        polyline(
            [(0.0, 0.0), turned(0.0, length, axis)],
            color='black',
            linewidth=0.8,
            linestyle='--',
        )
    corners = [('θ', tilt, tilt + theta, 1.15 * top)]
    if tilt:
        polyline([(0.0, 0.0), (0.0, length)], color='black', linewidth=0.8, linestyle=':')
        corners.append(('γ', 0.0, tilt, 1.02 * top))
    for name, start, stop, radius in corners:
        arc = [turned(0.0, radius, angle) for angle in between(start, stop)]
        polyline(arc, color='black', linewidth=1.0)
        place = turned(0.0, radius + 0.05 * top, 0.5 * (start + stop))
        axes.text(*place, name, ha='center', clip_on=True)

    # Forces: the cables pull along the unit's axis, the weight down.
    pull = 0.9 * top
    for name, tension, x, colour in (
        ('l', equilibrium.tension_l, -arm, TENSION_L),
        ('s', equilibrium.tension_s, arm, TENSION_S),
    ):
        longest = max(equilibrium.tension_l, equilibrium.tension_s)
        end = turned(x, base - 0.35 * pull - 0.65 * pull * tension / longest)
        arrow(turned(x, top), end, colour)
        axes.annotate(
            f'T_{name} = {tension:g} N',
            end,
            xytext=(0, -4),
            textcoords='offset points',
            ha='center',
            va='top',
        )
    centre = turned(0.0, com)
    down = math.hypot(load.gravity_direction[0], load.gravity_direction[2])
    if down > 0.05:  # the rest of gravity goes into the picture
        arrow(centre, (centre[0], centre[1] - 0.55 * r * down), WEIGHT)
    axes.plot(*centre, 'o', color=WEIGHT, markersize=6)
    axes.annotate('W, at l', centre, xytext=(7, 2), textcoords='offset points', color='black')
    axes.plot(0.0, 0.0, 'o', color='black', markersize=3)

    push = math.hypot(*load.tip_force)
    if push:
        tip = turned(0.0, load.tip_distance * millimetre)
        force_x, force_z = (part / push * 1.1 * r for part in load.tip_force)
        x, z = turned(force_x, force_z, tilt)
        arrow(tip, (tip[0] + x, tip[1] + z), VERMILION)
        style: dict[str, Any] = {
            'ha': 'right' if x > 0.0 else 'left',
            'va': 'center',
            'clip_on': True,
        }
        axes.text(tip[0] - 0.2 * x, tip[1] - 0.2 * z, f'F = {push:.3g} N', **style)

    contact = 0.5 * (design.contact_start_angle + design.contact_end_angle) * side
    axes.annotate(
        'contact zone,\nθ1 to θ2',
        turned(r * math.sin(contact), r * math.cos(contact)),
        xytext=turned(side * 1.75 * arm, -0.4 * top, tilt),
        ha='center',
        color=VERMILION,
        arrowprops={'arrowstyle': '-', 'color': VERMILION, 'linewidth': 0.8},
    )
    axes.set_aspect('equal')
    axes.set_xlabel('X_G, towards cable s [mm]')
    axes.set_ylabel('Z_G [mm]')
    across, up = 2.2 * arm, 1.35 * top
    if tilt or push:
        across = up = max(across, up, load.tip_distance * millimetre * bool(push) + 1.5 * r)
    axes.set_xlim(-across, across)
    axes.set_ylim(-min(1.3 * top, up) if not tilt else -up, up)
    axes.set_title(
        f'θ = {math.degrees(theta):.2f}°, p = {equilibrium.pressure:.1f} Pa, '
        + pair_title(equilibrium),
        fontsize=10,
    )
