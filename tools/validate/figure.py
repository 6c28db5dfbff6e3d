"""docs/validation.svg: the laws as lines, the simulations as marks."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tendon_statics.command_line.figures import BLUE, GREEN, VERMILION, write_figure

from . import rest
from .constructions import BALL_RADIUS, BOWL, CASES, EQUATOR_SEAT, HANGING, LOW_SEAT
from .laws import LAWS, capacity
from .results import Results, read

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FILE = Path(__file__).resolve().parents[2] / 'docs' / 'validation.svg'
SIZE = (8.0, 6.4)
STYLES = {
    'merged': {'color': VERMILION, 'linestyle': '--'},
    'friction_circle': {'color': BLUE, 'linestyle': '-.'},
    'elastic_seat': {'color': GREEN, 'linestyle': '-'},
}
FRICTIONS = np.linspace(0.02, 1.15, 114)


def draw(drawing: Figure, results: Results) -> None:
    """Draw the onset of each construction over friction, and the rest angle over tension."""
    panels = drawing.subplots(2, 2)
    for axes, construction in zip(panels.flat, (LOW_SEAT, EQUATOR_SEAT, BOWL), strict=False):
        for law in LAWS:
            moments = [capacity(law, construction, friction, 1.0) for friction in FRICTIONS]
            if None not in moments:
                axes.plot(FRICTIONS, np.array(moments) / BALL_RADIUS, label=law, **STYLES[law])
        onsets = [
            onset
            for (simulated, _), onset in zip(CASES, results.onsets, strict=True)
            if simulated == construction
        ]
        frictions = [onset.friction for onset in onsets]
        _mark(axes, frictions, [onset.rigid_body for onset in onsets], 'rigid body')
        _cross(axes, frictions, [onset.bristles for onset in onsets], 'bristles')
        axes.set_title(construction.name, fontsize=10)
        axes.set_xlim(0.0, 1.15)
        axes.set_ylim(0.0)
        axes.set_xlabel('friction coefficient μ')
        axes.set_ylabel('slip onset K / (r T)')
    _draw_rest(panels[1, 1], results)
    handles, labels = panels[0, 0].get_legend_handles_labels()
    drawing.legend(handles, labels, loc='outside lower center', ncols=len(labels), frameon=False)


def _draw_rest(axes: Axes, results: Results) -> None:
    low, high = HANGING.tensions_s[0], HANGING.tensions_s[-1]
    tensions = np.linspace(low - 0.05, high + 0.05, 25)
    for law in LAWS:
        angles = [math.degrees(rest.by_law(HANGING, tension, law)) for tension in tensions]
        axes.plot(tensions, angles, **STYLES[law])
    _mark(axes, HANGING.tensions_s, results.rest_angles_deg, 'rigid body')
    axes.set_title(f'hanging unit, {HANGING.seat.name}, μ = {HANGING.friction:g}', fontsize=10)
    axes.set_ylim(0.0)
    axes.set_xlabel(f'T_s [N], T_l = {HANGING.tension_l:g} N')
    axes.set_ylabel('rest angle after slip [°]')


def _mark(axes: Axes, x, y, label: str) -> None:
    axes.plot(x, y, 'o', color='black', markerfacecolor='white', markersize=7, label=label)


def _cross(axes: Axes, x, y, label: str) -> None:
    axes.plot(x, y, '+', color='black', markersize=6, label=label)


def write() -> None:
    """Write the figure."""
    results = read()
    write_figure(FILE, lambda drawing: draw(drawing, results), SIZE)
