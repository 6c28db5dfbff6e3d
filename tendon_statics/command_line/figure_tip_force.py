"""``tendon-statics plot tip-force``: what a recording tells of a force at the tip, over time."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

import numpy as np

from ..recordings.replay.tip_forces import TipForces
from ..recordings.session import Session
from .figures import BLUE, GREY, ORANGE, SKY, VERMILION
from .options import (
    add_bend_angle_stddev_option,
    add_design_option,
    add_load_options,
    add_tension_stddev_option,
)
from .recorded_tip_force import recorded_tip_forces
from .recording_options import (
    add_recording_options,
    report_damage,
    report_notes,
    unit_and_recording,
)
from .tip_force_options import add_line_options

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZE = (7.2, 4.4)

MOST = 2000
"""Samples that are drawn, evenly chosen"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the figure takes."""
    add_recording_options(parser)
    add_design_option(parser)
    add_line_options(parser, required=True)
    add_bend_angle_stddev_option(parser)
    add_load_options(parser)
    add_tension_stddev_option(parser, default=None)


def draw(drawing: Figure, options: argparse.Namespace) -> int:
    """Read, ask and draw; return the exit code."""
    unit, recording = unit_and_recording(options)
    draw_tip_forces(drawing, recording, recorded_tip_forces(options, unit, recording, MOST))
    report_notes(unit, recording)
    return report_damage(recording)


def draw_tip_forces(drawing: Figure, recording: Session, found: TipForces) -> None:
    """Draw the interval, what was measured, and the probability of a free tip over time."""
    times, label = recording.time, 'time [s]'
    if times is None or recording.disorder:
        times, label = np.arange(float(len(recording))), 'sample'
    times = times[found.places]
    of_force, of_free = drawing.subplots(2, sharex=True, height_ratios=(4.0, 1.2))
    ends = np.concatenate([found.low, found.high, [0.0]])
    if found.measured is not None:
        ends = np.concatenate([ends, found.measured])
    ends = ends[np.isfinite(ends)]
    spare = 0.08 * (ends.max() - ends.min()) + 1e-3
    bottom, top = ends.min() - spare, ends.max() + spare
    of_force.fill_between(
        *(times, found.low.clip(bottom, top), found.high.clip(bottom, top)),
        color=SKY,
        alpha=0.5,
        linewidth=0.0,
        label=f'forces that explain it ({100.0 * found.level:g} %)',
    )
    limit = found.at_limit & found.known
    if limit.any():
        middle = 0.5 * (found.low + found.high)[limit]
        of_force.errorbar(
            *(times[limit], middle),
            yerr=0.5 * (found.high - found.low)[limit],
            fmt='.',
            color=BLUE,
            label='at the limit of friction',
        )
    if found.measured is not None:
        of_force.plot(times, found.measured, color=VERMILION, linewidth=1.2, label='measured')
    of_force.axhline(0.0, color=GREY, linewidth=0.8)
    of_force.set_ylim(bottom, top)
    of_force.set_ylabel('force at the tip [N]')
    of_force.legend(loc='lower right', bbox_to_anchor=(1.0, 0.98), ncols=3, frameon=False)
    of_free.plot(times, found.probability_free, color=ORANGE, linewidth=1.2)
    of_free.set_ylim(-0.1, 1.1)
    of_free.set_ylabel('P(free tip)')
    of_free.set_xlabel(label)
    drawing.align_ylabels()
