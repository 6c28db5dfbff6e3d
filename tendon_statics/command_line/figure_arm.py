"""Figures of an arm that was followed through a recording: its units, joints and tip."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..estimation.regimes import REGIME_COLOURS
from ..physics import Arm, Regime
from ..physics.arm.shape import joint_centres
from ..recordings.replay.arm_result import ArmReplay
from ..recordings.session import Floats
from .figure_recording import MANY, places_of, regime_bars
from .figures import BLUE, GREEN, GREY, HOLDS, ORANGE, SKY, VERMILION
from .options import UsageError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE = (7.4, 6.2)
TIP_SIZE = (7.4, 6.4)
MOMENTS = 9
"""At which the arm is drawn"""

COLOURS = (BLUE, ORANGE, GREEN, VERMILION, SKY, GREY)
MILLIMETRE = 1e3

FILLED = {
    regime.value: REGIME_COLOURS[regime]
    for regime in (Regime.HELD, Regime.SLIPPING, Regime.DRIVEN_TO_STOP)
}
"""Regime → what fills the joint"""


def draw_arm(drawing: Figure, replayed: ArmReplay) -> None:
    """Draw the arm at some moments, and angles and tensions over time.

    Raises
    ------
    UsageError
        If it is determined at no moment.
    """
    known = np.flatnonzero(np.isfinite(replayed.tip[0]))
    if not len(known):
        raise UsageError(
            f'{replayed.recording.name}: in no sample is the arm determined: in each a joint is '
            'slack, or it is not valid'
        )
    chosen = known[np.linspace(0, len(known) - 1, MOMENTS).round().astype(int)]
    above, middle, below = drawing.subplots(3, 1, height_ratios=(1.1, 1.2, 0.8))
    _draw_arms(above, replayed, chosen.tolist())
    places, label = places_of(replayed.recording)
    _draw_angles(middle, replayed, places)
    for index, (name, tensions) in enumerate(replayed.recording.cable_tensions.items()):
        side = '-' if replayed.arm.cables[index].side == 's' else ':'
        below.plot(places, tensions, side, color=_colour(index // 2), label=name)
    below.set_ylabel('tension [N]')
    below.set_xlabel(f'{label}; dotted: cables l')
    below.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), frameon=False)
    for axes in (middle, below):
        for number, moment in enumerate(chosen.tolist(), start=1):
            axes.axvline(places[moment], color='#bbbbbb', linewidth=0.8, zorder=0)
            if axes is middle:
                axes.annotate(
                    str(number),
                    (places[moment], 1.0),
                    xycoords=('data', 'axes fraction'),
                    xytext=(0, 2),
                    textcoords='offset points',
                    ha='center',
                    fontsize=8,
                    color='#666666',
                )


def draw_tip(drawing: Figure, replayed: ArmReplay) -> None:
    """Draw margins and regimes of all joints over time, and the tip's path."""
    places, label = places_of(replayed.recording)
    grid = drawing.add_gridspec(3, 1, height_ratios=(1.2, 0.2 + 0.13 * len(replayed.joints), 1.4))
    of_margins = drawing.add_subplot(grid[0])
    of_regimes = drawing.add_subplot(grid[1], sharex=of_margins)
    of_margins.axhspan(-1.0, 1.0, color=HOLDS, label='friction can hold')
    many = len(replayed.recording) > MANY
    for index, joint in enumerate(replayed.joints):
        style: dict[str, Any] = {'color': _colour(index), 'linewidth': 1.2, 'rasterized': many}
        of_margins.plot(places, joint.slip_margin, label=f'joint {index + 1}', **style)
    of_margins.set_ylim(-2.0, 2.0)
    of_margins.set_ylabel('slip margin')
    of_margins.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), frameon=False)

    shown: dict[str, Any] = {}
    for index, joint in enumerate(replayed.joints):
        for regime, colour, bars in regime_bars(places, joint.regime):
            drawn = of_regimes.broken_barh(bars, (index + 0.6, 0.8), color=colour, linewidth=0.6)
            shown[regime.replace('_', ' ')] = drawn
    of_regimes.set_ylabel('joint')
    of_regimes.set_yticks(range(1, len(replayed.joints) + 1))
    of_regimes.grid(visible=False)
    of_regimes.set_xlabel(label)
    of_regimes.legend(
        shown.values(), shown.keys(), loc='center left', bbox_to_anchor=(1.0, 0.5), frameon=False
    )
    _draw_path(drawing.add_subplot(grid[2]), replayed)


def _draw_path(axes: Axes, replayed: ArmReplay) -> None:
    measured = _measured_tip(replayed)
    if measured is not None:
        axes.plot(*measured, color=GREY, linewidth=4.0, label='by the measured angles')
    x, z = (MILLIMETRE * of for of in replayed.tip[:2])
    axes.plot(x, z, color=VERMILION, linewidth=1.2, label=f'estimated ({replayed.estimation})')
    known = np.flatnonzero(np.isfinite(x))
    for place, marker, name in zip(known[[0, -1]], ('o', 's'), ('first', 'last'), strict=True):
        axes.plot(x[place], z[place], marker, color='black', markersize=5, label=name)
    axes.set_xlabel('tip, x [mm], towards cables s')
    axes.set_ylabel('z [mm]')
    axes.set_aspect('equal', adjustable='datalim')
    axes.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), frameon=False)


def _measured_tip(replayed: ArmReplay) -> tuple[Floats, Floats] | None:
    """Where the measured angles put the tip in mm; None unless every joint has some."""
    measured = [joint.recording.bend_angle for joint in replayed.joints]
    if any(angles is None for angles in measured):
        return None
    tilts = np.cumsum(np.array(measured), axis=0)
    lengths = [unit.length for unit in replayed.arm.units]
    x = sum(length * np.sin(tilt) for length, tilt in zip(lengths, tilts, strict=True))
    z = sum(length * np.cos(tilt) for length, tilt in zip(lengths, tilts, strict=True))
    return MILLIMETRE * x, MILLIMETRE * z


def _draw_angles(axes: Axes, replayed: ArmReplay, places: Floats) -> None:
    many = len(replayed.recording) > MANY
    style: dict[str, Any]
    for index, joint in enumerate(replayed.joints):
        style = {'color': _colour(index), 'rasterized': many}
        measured = joint.recording.bend_angle
        if measured is not None:
            axes.plot(places, np.degrees(measured), linewidth=5.0, alpha=0.3, **style)
        if joint.interval is not None:
            low, high = (np.degrees(end) for end in joint.interval)
            axes.fill_between(places, low, high, alpha=0.25, linewidth=0.0, **style)
        degrees = np.degrees(joint.bend_angle)
        style['linestyle'] = ('-', '--')[index // len(COLOURS) % 2]
        sure = np.where(joint.angle_assured, degrees, np.nan)
        axes.plot(places, sure, label=f'joint {index + 1}', **style)
        unsure = np.where(joint.angle_assured, np.nan, degrees)
        if np.isfinite(unsure).any():
            axes.plot(places, unsure, **{**style, 'linestyle': ':', 'linewidth': 1.0})
    if any(
        not joint.angle_assured[np.isfinite(joint.bend_angle)].all() for joint in replayed.joints
    ):
        axes.plot([], [], ':', color='black', linewidth=1.0, label='not assured')
    if replayed.recording.bend_angles:
        axes.plot([], [], color='black', linewidth=5.0, alpha=0.3, label='measured')
    axes.set_ylabel('bend angle θ [°]')
    axes.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), frameon=False)


def _draw_arms(axes: Axes, replayed: ArmReplay, moments: list[int]) -> None:
    """Draw the arm at some moments, side by side; a joint shows what it does."""
    arm = replayed.arm
    gap = 1.4 * MILLIMETRE * max(design.cable_lever for design in arm.designs)
    marker: dict[str, Any] = {'marker': 'o', 'markersize': 5, 'linestyle': 'none'}
    marker |= {'markeredgecolor': 'black', 'markeredgewidth': 0.8}
    style: dict[str, Any]
    start = 0.0
    for number, moment in enumerate(moments, start=1):
        angles = [float(joint.bend_angle[moment]) for joint in replayed.joints]
        places = _centres_of(arm, angles)
        start -= min(-gap, *(x - gap for x, _ in places))
        half = 0.9 * MILLIMETRE * arm.designs[0].cable_lever
        axes.plot([start - half, start + half], [0.0, 0.0], color='#888888', linewidth=3.0)
        tilt = 0.0
        for index, joint in enumerate(replayed.joints):
            (x, z), (end_x, end_z) = places[index], places[index + 1]
            tilt += angles[index]
            half = 0.6 * MILLIMETRE * arm.designs[index].cable_lever
            across = half * math.cos(tilt), -half * math.sin(tilt)
            axes.fill(
                [start + corner for corner in _corners(x, end_x, across[0])],
                _corners(z, end_z, across[1]),
                facecolor='#e8f1f8',
                edgecolor=_colour(index),
                linewidth=1.0,
            )
            axes.plot(start + x, z, color=FILLED[str(joint.regime[moment])], **marker)
        style = {'ha': 'center', 'va': 'top', 'fontsize': 8, 'color': '#666666'}
        axes.text(start, -0.6 * gap, str(number), **style)
        start += max(gap, *(x + gap for x, _ in places))
    for regime, name in zip(FILLED, ('held', 'slipping', 'pressed on its stop'), strict=True):
        axes.plot([], [], color=FILLED[regime], label=name, **marker)
    axes.legend(loc='lower left', bbox_to_anchor=(0.0, 1.0), ncols=3, frameon=False)
    axes.set_aspect('equal')
    axes.grid(visible=False)
    axes.set_axis_off()


def _corners(start: float, end: float, across: float) -> list[float]:
    """One coordinate of the corners of a unit."""
    return [start + across, end + across, end - across, start - across]


def _centres_of(arm: Arm, angles: list[float]) -> list[tuple[float, float]]:
    return [(MILLIMETRE * x, MILLIMETRE * z) for x, z in joint_centres(arm, tuple(angles))]


def _colour(index: int) -> str:
    return COLOURS[index % len(COLOURS)]
