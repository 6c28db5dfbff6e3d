"""``tendon-statics plot calibration``: how well a fitted design meets a recorded session."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

import numpy as np

from ..physics.calibration import HELD, SLIPPING, Calibration
from ..physics.calibration.boundary_distance import boundary_distance
from ..recordings.recording import Recording
from .calibration_options import add_calibration_options, calibration_from
from .figure_recording import MANY
from .figures import BLUE, GREY, SKY, VERMILION
from .options import add_design_option, add_load_options
from .recording_options import (
    add_recording_options,
    report_damage,
    report_notes,
    unit_and_recording,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE = (6.4, 5.6)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the figure takes."""
    add_recording_options(parser)
    add_design_option(parser)
    add_calibration_options(parser)
    add_load_options(parser)


def draw(drawing: Figure, options: argparse.Namespace) -> int:
    """Read, fit and draw; return the exit code."""
    unit, recording = unit_and_recording(options)
    calibration = calibration_from(options, unit, recording).calibration
    draw_calibration(drawing, calibration, recording)
    report_notes(unit, recording)
    return report_damage(recording)


def draw_calibration(drawing: Figure, calibration: Calibration, recording: Recording) -> None:
    """Draw the samples' distances from the boundary of slip, and the fitted values."""
    of_distance, of_values = drawing.subplots(
        2, height_ratios=(3.0, 0.5 + 0.45 * len(calibration.parameters))
    )
    _draw_distances(of_distance, calibration, recording)
    _draw_values(of_values, calibration)


def _draw_distances(axes: Axes, calibration: Calibration, recording: Recording) -> None:
    assert recording.bend_angle is not None
    degrees = np.degrees(recording.bend_angle)
    slipping, held = (calibration.roles == role for role in (SLIPPING, HELD))
    pressure = np.full(len(recording), np.nan)
    before = boundary_distance(
        calibration.start,
        recording.tension_l,
        recording.tension_s,
        recording.bend_angle,
        pressure,
        calibration.noise,
        calibration.loads,
    ).standardised
    after = calibration.distance.standardised
    axes.axhspan(-2.0, 2.0, color='#e6f1f8', label='within 2 standard deviations')
    axes.axhline(0.0, color='black', linewidth=0.8)
    if held.any():
        axes.plot(
            *(degrees[held], after[held], '.'),
            markersize=2.0,
            color=SKY,
            label='held, fitted design',
            rasterized=int(held.sum()) > MANY,
        )
    axes.plot(
        *(degrees[slipping], before[slipping], 'o'),
        markersize=5.0,
        fillstyle='none',
        color=GREY,
        label='slipping, start design',
    )
    axes.plot(
        *(degrees[slipping], after[slipping], 'o'),
        markersize=5.0,
        color=VERMILION,
        label='slipping, fitted design',
    )
    axes.set_yscale('symlog', linthresh=5.0)
    ticks = (-100, -30, -5, 0, 5, 30, 100)
    axes.set_yticks(ticks, [f'{tick}'.replace('-', '−') for tick in ticks])
    shown = np.concatenate([before[slipping], after[slipping], after[held], [-4.0, 4.0]])
    axes.set_ylim(1.5 * np.nanmin(shown), 1.5 * np.nanmax(shown))
    axes.set_xlabel('measured bend angle θ [°]')
    axes.set_ylabel('distance from the boundary of slip\n[standard deviations; log beyond ±5]')
    _explain_sides(axes)
    axes.legend(
        loc='lower center', bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False, markerscale=1.2
    )


def _explain_sides(axes: Axes) -> None:
    """Say at the right what it means to lie above 0 and below."""
    share = axes.transAxes.inverted().transform(axes.transData.transform((0.0, 0.0)))[1]
    for place, text in (
        (0.5 * (1.0 + share), 'friction\ncannot hold'),
        (0.5 * share, 'friction holds'),
    ):
        axes.text(
            *(1.01, place, text),
            transform=axes.transAxes,
            rotation=90,
            va='center',
            color='#555555',
        )


def _draw_values(axes: Axes, calibration: Calibration) -> None:
    """Draw each fitted value with its 95 % interval as a share of where the fit began."""
    names = []
    for row, parameter in enumerate(calibration.parameters):
        names.append(parameter.name.replace('_', ' '))
        scale = 100.0 / parameter.start if parameter.start else np.nan
        if parameter.value is None or parameter.interval is None:
            axes.annotate(
                'not determined',
                (100.0, row),
                xytext=(6, 0),
                textcoords='offset points',
                va='center',
            )
            continue
        if not parameter.start:  # has no share
            low, high = parameter.interval
            axes.annotate(
                f'{parameter.value:.3g}, from {low:.3g} to {high:.3g}; it began at 0',
                (100.0, row),
                xytext=(6, 0),
                textcoords='offset points',
                va='center',
            )
            continue
        low, high = (scale * end for end in parameter.interval)
        axes.plot([low, high], [row, row], color=BLUE, linewidth=3.0, solid_capstyle='butt')
        axes.plot(scale * parameter.value, row, 'o', color=BLUE, markersize=6.0)
    axes.axvline(100.0, color=GREY, linestyle='--', linewidth=1.2)
    axes.annotate(
        'start',
        (100.0, 1.0),
        xycoords=('data', 'axes fraction'),
        xytext=(0, 2),
        textcoords='offset points',
        ha='center',
        color='#555555',
    )
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.set_xlabel('fitted value with 95 % interval [% of the start value]')
