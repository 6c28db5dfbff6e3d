"""The figures of docs/friction.md: what friction holds, and how its band moves a unit."""

from __future__ import annotations

from dataclasses import replace
from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tendon_statics import (
    StickSlipTracker,
    admissible_angles,
    default_design_path,
    load_design,
    slip_margin,
)
from tendon_statics.command_line.figures import (
    BLUE,
    GREEN,
    HOLDS,
    TENSION_L,
    TENSION_S,
    VERMILION,
    write_figure,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

UNIT = load_design(default_design_path())

WITH_BACKBONE = replace(UNIT, stiffness=0.03)
"""A unit that bends back, so that it does not run from stop to stop"""


def draw_margins(drawing: Figure) -> None:
    """Draw the share of friction that each angle asks for, at three tensions of cable s."""
    axes = drawing.subplots()
    stop = UNIT.max_bend_angle
    angles = np.linspace(-stop, stop, 121)
    axes.axhspan(-1.0, 1.0, color=HOLDS)
    axes.text(-28.5, 0.03, 'friction can hold', color=BLUE, va='bottom')
    axes.text(-28.5, 1.19, 'it cannot: the unit slides towards s', color=VERMILION, va='bottom')
    for tension, colour, line, word in (
        (1.5, GREEN, '-.', 'held, at any angle'),
        (2.0, BLUE, '-', 'held up to 17°'),
        (2.2, VERMILION, '--', 'slides to the stop'),
    ):
        margins = [slip_margin(UNIT, 1.0, tension, angle) for angle in angles]
        label = f'T_s = {tension:g} N: {word}'
        axes.plot(np.degrees(angles), margins, line, color=colour, label=label)
    _, end = admissible_angles(UNIT, 1.0, 2.0)[-1]
    axes.plot(degrees(end), 1.0, 'o', color=BLUE, markersize=7)
    axes.annotate(
        f'about to slip\nat {degrees(end):.2f}°',
        (degrees(end), 1.0),
        xytext=(12, -38),
        textcoords='offset points',
        arrowprops={'arrowstyle': '-', 'color': BLUE},
        color=BLUE,
    )
    axes.set_xlim(-30.0, 30.0)
    axes.set_ylim(-0.1, 1.27)
    axes.set_xlabel('bend angle θ at which the unit might be [°]')
    axes.set_ylabel('share of friction that is used, M/K')
    axes.legend(loc='lower center', bbox_to_anchor=(0.5, 1.0), frameon=False)


def draw_path(drawing: Figure) -> None:
    """Draw a unit that is pulled and let go, and the angles that friction can hold meanwhile."""
    corners = [(0.0, 1.0), (4.0, 2.45), (7.0, 1.0), (8.5, 1.0), (13.0, 2.6), (16.0, 0.42)]
    time = np.linspace(0.0, 16.0, 641)
    pulled = np.interp(time, *zip(*corners, strict=True))
    tracker = StickSlipTracker(WITH_BACKBONE)
    path, low, high = [], [], []
    for tension in pulled:
        path.append(degrees(tracker.update(1.0, tension).bend_angle or 0.0))
        held = admissible_angles(WITH_BACKBONE, 1.0, tension)
        low.append(degrees(held[0][0]))
        high.append(degrees(held[-1][1]))
    above, below = drawing.subplots(2, sharex=True, height_ratios=(1.0, 2.2))
    above.plot(time, pulled, color=TENSION_S, label='T_s')
    above.plot(time, np.full_like(time, 1.0), color=TENSION_L, label='T_l')
    above.set_ylabel('tension [N]')
    above.legend(loc='lower center', bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False)
    below.fill_between(time, low, high, color=HOLDS, label='angles that friction can hold')
    below.plot(time, path, color=VERMILION, label='the unit')
    moves = np.abs(np.diff(path)) > 1e-9
    for first, last in _runs(~moves):
        if last - first > 40:
            middle = (first + last) // 2
            below.text(time[middle], path[middle] + 0.9, 'stuck', ha='center', color='#555555')
    below.set_xlabel('time [s]')
    below.set_ylabel('bend angle θ [°]')
    below.legend(loc='upper center', bbox_to_anchor=(0.5, -0.22), ncols=2, frameon=False)


def _runs(flags: np.ndarray) -> list[tuple[int, int]]:
    """First and last index of each run of true values."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def write(folder: Path) -> None:
    """Write both figures."""
    write_figure(folder / 'friction_margin.svg', draw_margins, (6.4, 4.6))
    write_figure(folder / 'friction_path.svg', draw_path, (6.4, 5.0))


if __name__ == '__main__':
    write(Path(__file__).resolve().parents[1] / 'docs')
