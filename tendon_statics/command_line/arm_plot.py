"""``tendon-statics arm plot``: an arm going through a table of tensions."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..physics import Arm, ArmState, ArmTracker, Regime
from ..physics.arm.shape import joint_centres
from .arm_options import add_arm_options, add_table_option, arm_from, table_from
from .figures import BLUE, FORMATS, GREEN, GREY, ORANGE, SKY, VERMILION, write_figure
from .options import UsageError, say_written

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE = (7.4, 6.2)
MOMENTS = 9
"""At which the arm is drawn"""

COLOURS = (BLUE, ORANGE, GREEN, VERMILION, SKY, GREY)
MILLIMETRE = 1e3


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the verb takes."""
    add_arm_options(parser)
    add_table_option(parser)
    parser.add_argument(
        '--output',
        type=Path,
        required=True,
        metavar='FILE',
        help=f'ending: {", ".join(FORMATS)}',
    )


def run(options: argparse.Namespace) -> None:
    """Draw and write the figure."""
    arm, angles, load = arm_from(options)
    table = table_from(options, arm)
    tracker = ArmTracker(arm, angles)
    states = [tracker.update(tensions, load) for tensions in table.tensions]
    if any(state.is_slack for state in states):
        raise UsageError('a joint is slack on the way, which is outside the model')
    places = table.time or [float(number) for number in range(1, len(states) + 1)]
    unit = 'time [s]' if table.time else 'row'
    write_figure(options.output, lambda drawing: _draw(drawing, arm, states, places, unit), SIZE)
    say_written(options.output, options)


def _draw(
    drawing: Figure, arm: Arm, states: list[ArmState], places: list[float], unit: str
) -> None:
    above, middle, below = drawing.subplots(3, 1, height_ratios=(1.1, 1.2, 0.8))
    moments = [round(index * (len(states) - 1) / (MOMENTS - 1)) for index in range(MOMENTS)]
    _draw_arms(above, arm, [states[moment] for moment in moments])

    for joint in range(len(arm.units)):
        degrees = [math.degrees(angle) for angle in _angles_of(joint, states)]
        style: dict[str, Any] = {'linestyle': ('-', '--')[joint // len(COLOURS) % 2]}
        middle.plot(places, degrees, color=_colour(joint), label=f'joint {joint + 1}', **style)
    middle.set_ylabel('bend angle θ [°]')
    middle.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), frameon=False)
    for index, name in enumerate(arm.cable_names):
        tensions = [state.tensions[name] for state in states]
        side = '-' if arm.cables[index].side == 's' else ':'
        below.plot(places, tensions, side, color=_colour(index // 2), label=name)
    below.set_ylabel('tension [N]')
    below.set_xlabel(f'{unit}; dotted: cables l')
    below.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), frameon=False)
    for axes in (middle, below):
        for number, moment in enumerate(moments, start=1):
            axes.axvline(places[moment], color='#bbbbbb', linewidth=0.8, zorder=0)
            if axes is middle:
                top = (places[moment], 1.0)
                axes.annotate(
                    str(number),
                    top,
                    xycoords=('data', 'axes fraction'),
                    xytext=(0, 2),
                    textcoords='offset points',
                    ha='center',
                    fontsize=8,
                    color='#666666',
                )


def _draw_arms(axes: Axes, arm: Arm, states: list[ArmState]) -> None:
    """Draw the arm at some moments, side by side; a joint shows what it does."""
    gap = 1.4 * MILLIMETRE * max(design.cable_lever for design in arm.designs)
    marker: dict[str, Any] = {'marker': 'o', 'markersize': 5, 'linestyle': 'none'}
    marker |= {'markeredgecolor': 'black', 'markeredgewidth': 0.8}
    style: dict[str, Any]
    start = 0.0
    for number, state in enumerate(states, start=1):
        places = _centres_of(arm, state)
        start -= min(-gap, *(x - gap for x, _ in places))
        half = 0.9 * MILLIMETRE * arm.designs[0].cable_lever
        axes.plot([start - half, start + half], [0.0, 0.0], color='#888888', linewidth=3.0)
        tilt = 0.0
        for joint, answer in enumerate(state.joints):
            (x, z), (end_x, end_z) = places[joint], places[joint + 1]
            tilt += answer.bend_angle or 0.0
            half = 0.6 * MILLIMETRE * arm.designs[joint].cable_lever
            across = half * math.cos(tilt), -half * math.sin(tilt)
            axes.fill(
                [start + corner for corner in _corners(x, end_x, across[0])],
                _corners(z, end_z, across[1]),
                facecolor='#e8f1f8',
                edgecolor=_colour(joint),
                linewidth=1.0,
            )
            filled = {Regime.DRIVEN_TO_STOP: VERMILION, Regime.SLIPPING: ORANGE}
            axes.plot(
                *(start + x, z),
                color=filled.get(answer.regime, '#ffffff'),
                **marker,
            )
        style = {'ha': 'center', 'va': 'top', 'fontsize': 8, 'color': '#666666'}
        axes.text(start, -0.6 * gap, str(number), **style)
        start += max(gap, *(x + gap for x, _ in places))
    for colour, text in (
        ('#ffffff', 'held'),
        (ORANGE, 'slipping'),
        (VERMILION, 'pressed on its stop'),
    ):
        axes.plot([], [], color=colour, label=text, **marker)
    axes.legend(loc='lower left', bbox_to_anchor=(0.0, 1.0), ncols=3, frameon=False)
    axes.set_aspect('equal')
    axes.grid(visible=False)
    axes.set_axis_off()


def _corners(start: float, end: float, across: float) -> list[float]:
    """One coordinate of the corners of a unit."""
    return [start + across, end + across, end - across, start - across]


def _centres_of(arm: Arm, state: ArmState) -> list[tuple[float, float]]:
    assert state.bend_angles is not None
    return [(MILLIMETRE * x, MILLIMETRE * z) for x, z in joint_centres(arm, state.bend_angles)]


def _angles_of(joint: int, states: list[ArmState]) -> list[float]:
    return [state.joints[joint].bend_angle or 0.0 for state in states]


def _colour(index: int) -> str:
    return COLOURS[index % len(COLOURS)]
