"""``tendon-statics plot recording``: a recorded session and what the model says of it."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..estimation.regimes import INVALID, REGIME_COLOURS
from ..physics import JointDesign
from ..recordings.replay.result import Replay
from ..recordings.replay.slip_tensions import slip_tensions
from ..recordings.session import Floats, Session
from .figures import BLUE, GREY, HOLDS, TENSION_L, TENSION_S, VERMILION
from .options import add_design_option, add_load_options, add_tension_stddev_option
from .recording_options import (
    add_recording_options,
    report_damage,
    report_notes,
    unit_and_recording,
)
from .replay_options import add_estimation_options, replay_from

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE = (7.2, 8.2)

DOUBT = '#f3e3c3'
"""Behind an angle that is not assured"""

MANY = 1000
"""Samples above which they are drawn as an image, so that the file stays small"""

_COLOURS = {regime.value: colour for regime, colour in REGIME_COLOURS.items()}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the figure takes."""
    add_recording_options(parser)
    add_design_option(parser)
    add_estimation_options(parser)
    add_load_options(parser)
    add_tension_stddev_option(parser, default=None)


def draw(drawing: Figure, options: argparse.Namespace) -> int:
    """Read, replay and draw; return the exit code."""
    unit, recording = unit_and_recording(options)
    design = unit.design
    replayed = replay_from(options, unit, design, recording)
    draw_replay(drawing, design, replayed)
    report_notes(unit, recording)
    return report_damage(recording)


def draw_replay(drawing: Figure, design: JointDesign, replayed: Replay) -> None:
    """Draw tensions, angle, pressure, slip margin and regime, one above the other over time."""
    recording = replayed.recording
    times, label = places_of(recording)
    of_tensions, of_angle, of_pressure, of_margin, of_regime = drawing.subplots(
        5, sharex=True, height_ratios=(4.0, 4.0, 2.6, 2.0, 0.6)
    )
    _draw_tensions(of_tensions, times, design, replayed)
    _draw_angles(of_angle, times, replayed)
    stop = np.degrees(design.max_bend_angle)
    of_angle.set_ylim(-1.35 * stop, 1.35 * stop)
    of_angle.set_yticks([-stop, 0.0, stop], [f'−{stop:.3g}', '0', f'{stop:.3g}'])
    of_angle.set_ylabel('bend angle θ [°]')
    _legend(of_angle)

    _draw_pressures(of_pressure, times, replayed)

    of_margin.axhspan(-1.0, 1.0, color=HOLDS, label='friction can hold')
    of_margin.plot(
        *(times, replayed.slip_margin, '.'),
        markersize=2.5,
        color=BLUE,
        rasterized=len(recording) > MANY,
    )
    of_margin.set_ylim(-2.0, 2.0)
    of_margin.set_ylabel('slip margin')
    _legend(of_margin)

    _draw_regimes(of_regime, times, replayed)
    of_regime.set_xlabel(label)
    drawing.align_ylabels()


def places_of(recording: Session) -> tuple[Floats, str]:
    """Where along an axis the samples stand, and what the axis is: time, or their number."""
    if recording.time is None or recording.disorder:
        return np.arange(float(len(recording))), 'sample'
    return recording.time, 'time [s]'


def _draw_tensions(axes: Axes, times: Any, design: JointDesign, replayed: Replay) -> None:
    """Draw them, and those at which the unit is to slip where it was measured to be."""
    recording = replayed.recording
    at_slip = slip_tensions(design, replayed) or (None, None)
    for measured, predicted, colour, name in (
        (recording.tension_l, at_slip[0], TENSION_L, 'T_l'),
        (recording.tension_s, at_slip[1], TENSION_S, 'T_s'),
    ):
        axes.plot(times, measured, color=colour, linewidth=1.2, label=name)
        if predicted is not None and np.isfinite(predicted).any():
            axes.plot(
                *(times, predicted),
                color=colour,
                linewidth=1.0,
                linestyle=(0, (1.5, 1.5)),
                label=f'{name} at slip, predicted',
            )
    axes.set_ylabel('tension [N]')
    _legend(axes)


def _draw_pressures(axes: Axes, times: Any, replayed: Replay) -> None:
    """Draw the estimated pressure over the measured one."""
    recording = replayed.recording
    is_image = len(recording) > MANY
    if recording.pressure is not None:
        axes.plot(
            *(times, recording.pressure, '.'),
            markersize=5.0,
            color=GREY,
            label='measured',
            rasterized=is_image,
        )
    axes.plot(
        *(times, replayed.pressure, '.'),
        markersize=2.5,
        color=VERMILION,
        label=f'estimated ({replayed.estimation})',
        rasterized=is_image,
    )
    axes.set_ylabel('pressure [Pa]')
    if np.isfinite(replayed.pressure).any():
        _legend(axes)


def _draw_angles(axes: Axes, times: Any, replayed: Replay) -> None:
    recording = replayed.recording
    in_doubt = np.isfinite(replayed.bend_angle) & ~replayed.angle_assured
    if in_doubt.any():
        axes.broken_barh(
            _runs(times, in_doubt),
            (0.0, 1.0),
            transform=axes.get_xaxis_transform(),
            color=DOUBT,
            linewidth=0.0,
            label='in doubt',
        )
    if recording.bend_angle is not None:
        axes.plot(
            times, np.degrees(recording.bend_angle), color=GREY, linewidth=4.0, label='measured'
        )
    if replayed.interval is not None:
        low, high = replayed.interval
        axes.fill_between(
            times,
            np.degrees(low),
            np.degrees(high),
            color=VERMILION,
            alpha=0.35,
            linewidth=0.0,
            label=f'{100.0 * replayed.confidence:.4g} % interval',
            rasterized=len(recording) > MANY,
        )
    angle = np.degrees(replayed.bend_angle)
    for where, colour, label in (
        (replayed.angle_assured, VERMILION, f'estimated ({replayed.estimation})'),
        (~replayed.angle_assured, 'black', 'estimated, not assured'),
    ):
        shown = np.where(where, angle, np.nan)
        if np.isfinite(shown).any():
            axes.plot(
                *(times, shown, '.'),
                markersize=2.5,
                color=colour,
                label=label,
                rasterized=len(recording) > MANY,
            )


def _draw_regimes(axes: Axes, times: Any, replayed: Replay) -> None:
    """Draw a strip with the colour of the regime of each sample until the next."""
    handles = [
        axes.broken_barh(
            bars, (0.0, 1.0), color=colour, linewidth=0.6, label=regime.replace('_', ' ')
        )
        for regime, colour, bars in regime_bars(times, replayed.regime)
    ]
    axes.set_yticks([])
    axes.grid(visible=False)
    axes.set_ylabel('regime', rotation=0, ha='right', va='center')
    axes.legend(
        handles=handles,
        loc='upper center',
        bbox_to_anchor=(0.5, -1.6),
        ncols=len(handles),
        frameon=False,
        handlelength=1.2,
    )


def regime_bars(
    times: Any, regimes: NDArray[np.str_]
) -> Iterator[tuple[str, str, list[tuple[float, float]]]]:
    """Each regime that is there, its colour, and its runs: from when on, for how long."""
    for regime, colour in {**_COLOURS, INVALID: 'black'}.items():
        where = regimes == regime
        if where.any():
            yield regime, colour, _runs(times, where)


def _runs(times: Any, where: NDArray[np.bool_]) -> list[tuple[float, float]]:
    """Return begin and length of each run of samples, as bars until the next sample."""
    ends = np.append(times[1:], times[-1])
    edges = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]]).astype(int)))
    return [
        (times[first], ends[after - 1] - times[first]) for first, after in edges.reshape(-1, 2)
    ]


def _legend(axes: Axes) -> None:
    if axes.get_legend_handles_labels()[0]:
        axes.legend(
            loc='lower right',
            bbox_to_anchor=(1.0, 0.97),
            ncols=4,
            frameon=False,
            handlelength=1.4,
            columnspacing=1.2,
        )
