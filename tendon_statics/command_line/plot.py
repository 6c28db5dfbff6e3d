"""``tendon-statics plot``: figures, as SVG, PNG or PDF."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..physics import (
    Equilibrium,
    JointDesign,
    Regime,
    StickSlipTracker,
    admissible_angles,
    paper,
    residual,
    slip_margin,
    solve,
)
from .figures import BLUE, FORMATS, GREEN, ORANGE, VERMILION, figure
from .options import UsageError, add_design_option, add_tension_options, design_from

if TYPE_CHECKING:
    from matplotlib.axes import Axes

POINTS = 301


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    figures = parser.add_subparsers(dest='figure', metavar='FIGURE', required=True)
    for name, (description, _) in FIGURES.items():
        figure_parser = figures.add_parser(name, help=description, description=description)
        add_tension_options(figure_parser, defaults=(paper.TENSION_L, paper.TENSION_S))
        add_design_option(figure_parser)
        figure_parser.add_argument(
            '--output',
            type=Path,
            required=True,
            metavar='FILE',
            help=f'ending: {", ".join(FORMATS)}',
        )


def run(options: argparse.Namespace) -> None:
    """Draw and write the figure."""
    design = design_from(options)
    equilibrium = solve(design, options.tension_l, options.tension_s)
    if equilibrium.regime is Regime.SLACK:
        raise UsageError('there is nothing to draw: a cable is slack, which is outside the model')
    _, draw = FIGURES[options.figure]
    height = 4.6 if options.figure == 'unit' else 4.0
    with figure(options.output, height=height) as axes:
        draw(axes, design, equilibrium)


def _draw_residual(axes: Axes, design: JointDesign, equilibrium: Equilibrium) -> None:
    weak, strong = sorted((equilibrium.tension_l, equilibrium.tension_s))
    stop = design.max_bend_angle
    angles = [stop * index / (POINTS - 1) for index in range(POINTS)]
    values = [residual(design, weak, strong, angle) / design.contact_area for angle in angles]
    axes.axhline(0.0, color='black', linewidth=0.8)
    axes.plot([math.degrees(angle) for angle in angles], values, color=BLUE)
    if equilibrium.root_count and equilibrium.bend_angle is not None:
        angle = math.degrees(abs(equilibrium.bend_angle))
        axes.plot([angle], [0.0], 'o', color=VERMILION)
        axes.annotate(
            f'θ = {angle:.2f}°, p = {equilibrium.pressure:.1f} Pa',
            (angle, 0.0),
            xytext=(-8, 10),
            textcoords='offset points',
            horizontalalignment='right',
        )
    axes.set_xlim(0.0, math.degrees(stop))
    axes.set_xlabel('bend angle θ towards the stronger cable [°]')
    axes.set_ylabel('Eq. (4), left − right-hand side [Pa]')
    axes.set_title(_title(equilibrium), fontsize=10)


def _draw_unit(axes: Axes, design: JointDesign, equilibrium: Equilibrium) -> None:
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
    rim = [a * side for a in _between(design.contact_start_angle, design.contact_end_angle)]
    shell = [(r * math.sin(a), r * math.cos(a)) for a in _between(-math.pi / 2, math.pi / 2)]
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
        [(1.15 * top * math.sin(a), 1.15 * top * math.cos(a)) for a in _between(0.0, theta)],
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
        + _title(equilibrium),
        fontsize=10,
    )


def _draw_hysteresis(axes: Axes, design: JointDesign, equilibrium: Equilibrium) -> None:
    """Draw the path of a unit whose cables trade tension at a constant total."""
    total = equilibrium.tension_l + equilibrium.tension_s
    # Far enough for the unit to slip both ways, within what the cables can trade.
    at_limit = [
        abs(difference)
        for difference in _between(-0.999 * total, 0.999 * total, 1000)
        if not admissible_angles(design, *_share(total, difference))
    ]
    reach = min(1.25 * min(at_limit, default=0.8 * total), 0.999 * total)
    ramp = _between(0.0, reach, 401) + _between(reach, -reach, 801) + _between(-reach, reach, 801)
    tracker = StickSlipTracker(design)
    states = [tracker.update(*_share(total, difference)) for difference in ramp]

    differences = _between(-reach, reach, 401)
    stop = design.max_bend_angle
    angles = _between(-stop, stop, 121)
    margins = [
        [slip_margin(design, *_share(total, difference), angle) for difference in differences]
        for angle in angles
    ]
    degrees = [math.degrees(angle) for angle in angles]
    axes.contourf(differences, degrees, margins, levels=[-1.0, 1.0], colors=['#cfe3f1'])
    axes.plot(
        ramp,
        [math.degrees(state.bend_angle or 0.0) for state in states],
        color=VERMILION,
        label='path of the unit: load, unload, load the other way',
    )
    axes.fill_between([], [], color='#cfe3f1', label='angles that friction can hold')
    axes.plot([0.0], [0.0], 'o', color=VERMILION, markersize=5)
    for share in (0.13, 0.33, 0.42, 0.7, 0.85):
        index = int(share * len(ramp))
        tail, tip = (
            (ramp[i], math.degrees(states[i].bend_angle or 0.0)) for i in (index, index + 10)
        )
        style = {'arrowstyle': '-|>', 'color': VERMILION, 'mutation_scale': 14}
        axes.annotate('', xy=tip, xytext=tail, arrowprops=style)
    axes.set_xlabel(f'tension difference T_s − T_l [N], at T_l + T_s = {total:g} N')
    axes.set_ylabel('bend angle θ [°]')
    axes.set_ylim(-1.15 * math.degrees(stop), 1.15 * math.degrees(stop))
    axes.legend(loc='upper center', bbox_to_anchor=(0.5, 1.2), ncols=1, frameon=False)


def _share(total: float, difference: float) -> tuple[float, float]:
    """Tensions of a given sum and difference."""
    return 0.5 * (total - difference), 0.5 * (total + difference)


def _between(start: float, end: float, count: int = 41) -> list[float]:
    return [start + (end - start) * index / (count - 1) for index in range(count)]


def _title(equilibrium: Equilibrium) -> str:
    return (
        f'{equilibrium.regime} at T_l = {equilibrium.tension_l:g} N, '
        f'T_s = {equilibrium.tension_s:g} N'
    )


FIGURES = {
    'residual': ("Eq. (4) over the bend angle (the paper's Fig. 2)", _draw_residual),
    'hysteresis': (
        'the path of a unit whose cables trade tension, and the angles that friction can hold',
        _draw_hysteresis,
    ),
    'unit': ("the unit at its bend angle, with what acts on it (the paper's Fig. 1)", _draw_unit),
}
"""Figure → what it shows, and what draws it."""
