"""``tendon-statics plot map``: an answer over both cable tensions."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..estimation.regimes import REGIME_COLOURS
from ..physics import UPRIGHT, Load, Regime, paper
from ..physics.batch import REGIME_CODES, EquilibriumBatch
from ..recordings.session import Floats
from .figures import pale
from .options import add_design_option
from .pair_options import setting_title
from .sweep import add_grid_options, grid_from

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE = (6.4, 5.0)


class _Quantity(NamedTuple):
    """What is shown in colour."""

    label: str
    colours: str
    """Colour map of even steps in lightness, readable with any colour vision"""


QUANTITIES = {
    'bend_angle': _Quantity('bend angle θ [°], towards cable s', 'PRGn'),
    'pressure': _Quantity('joint pressure p [Pa]', 'cividis'),
    'sensitivity': _Quantity('bend angle per tension, |∂θ/∂T| [°/N]', 'cividis'),
}

AT_STOP = {
    'bend_angle': 'driven to a stop: ±θ_max',
    'sensitivity': 'driven to a stop: 0',
}
"""Quantity → what it is where a unit lies against a stop, which has a colour of its own"""

WIDE = 20.0
"""Ratio of the largest to the smallest value above which the colours are logarithmic"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what the figure takes."""
    parser.add_argument(
        '--quantity',
        choices=QUANTITIES,
        default='bend_angle',
        help='default: %(default)s; sensitivity is the length of the gradient of the angle by the '
        'two tensions',
    )
    add_grid_options(parser)
    parser.set_defaults(points=401)
    add_design_option(parser)


def draw(drawing: Figure, options: argparse.Namespace) -> None:
    """Draw the map, and the areas that have no number."""
    from matplotlib.colors import ListedColormap, LogNorm
    from matplotlib.patches import Patch

    answers = grid_from(options)
    quantity = QUANTITIES[options.quantity]
    values = _values(answers, options.quantity)
    across, up = answers.tension_l[:, 0], answers.tension_s[0]
    axes = drawing.subplots()
    axes.grid(visible=False)

    has_no_number = {
        'friction holds: not determined': (
            answers.regime == REGIME_CODES[Regime.HELD],
            pale(REGIME_COLOURS[Regime.HELD]),
        ),
        'slack, or the joint not seated': (
            (answers.regime == REGIME_CODES[Regime.SLACK]) | (answers.regime < 0),
            '#7f7f7f',
        ),
    }
    if options.quantity != 'pressure':
        # So that they are not taken for the largest angles of an equilibrium.
        at_stop = answers.regime == REGIME_CODES[Regime.DRIVEN_TO_STOP]
        has_no_number[AT_STOP[options.quantity]] = (
            at_stop,
            pale(REGIME_COLOURS[Regime.DRIVEN_TO_STOP]),
        )
    patches = []
    for label, (where, colour) in has_no_number.items():
        if where.any():
            area = np.ma.masked_where(~where, np.ones(where.shape))
            axes.pcolormesh(across, up, area.T, cmap=ListedColormap([colour]), rasterized=True)
            patches.append(Patch(facecolor=colour, label=label))

    shown = np.ma.masked_invalid(values)
    limits: dict[str, Any] = {}
    if options.quantity == 'bend_angle' and shown.count():
        largest = math.degrees(answers.design.max_bend_angle)
        limits = {'vmin': -largest, 'vmax': largest}
    elif shown.count() and shown.max() > WIDE * shown.min():
        limits = {'norm': LogNorm()}
    mesh = axes.pcolormesh(across, up, shown.T, cmap=quantity.colours, rasterized=True, **limits)
    if shown.count():
        drawing.colorbar(mesh, label=quantity.label)
    for side, sign in (('s', 1.0), ('l', -1.0)):
        _name_stop(axes, answers, side, sign)
    _mark_published(axes, across, up)
    load = answers.load if isinstance(answers.load, Load) else UPRIGHT  # one for all, from options
    drawing.suptitle('\n'.join(setting_title(answers.design, load)), fontsize=10)
    axes.set_xlabel('tension of cable l, T_l [N]')
    axes.set_ylabel('tension of cable s, T_s [N]')
    if patches:
        axes.legend(
            handles=patches,
            loc='lower center',
            bbox_to_anchor=(0.5, 1.0),
            ncols=2,
            frameon=False,
        )


def _mark_published(axes: Axes, across: Floats, up: Floats) -> None:
    """Mark the tensions of the paper's published case, where they are on the map."""
    if across[0] <= paper.TENSION_L <= across[-1] and up[0] <= paper.TENSION_S <= up[-1]:
        axes.plot(
            *(paper.TENSION_L, paper.TENSION_S, 'o'),
            markersize=7.0,
            markerfacecolor='white',
            markeredgecolor='black',
        )
        axes.annotate(
            "the paper's\npublished case",
            (paper.TENSION_L, paper.TENSION_S),
            xytext=(14, -34),
            textcoords='offset points',
            arrowprops={'arrowstyle': '-', 'shrinkB': 4.0},
        )


def _values(answers: EquilibriumBatch, quantity: str) -> Floats:
    if quantity == 'bend_angle':
        at_stop = answers.regime == REGIME_CODES[Regime.DRIVEN_TO_STOP]
        return np.where(at_stop, math.nan, np.degrees(answers.bend_angle))
    if quantity == 'pressure':
        return answers.pressure
    slope = np.hypot(*answers.bend_angle_gradient)
    return np.where(slope > 0.0, np.degrees(slope), math.nan)


def _name_stop(axes: Axes, answers: EquilibriumBatch, side: str, sign: float) -> None:
    """Label the area in which the unit is driven to one of its stops."""
    stopped = answers.regime == REGIME_CODES[Regime.DRIVEN_TO_STOP]
    there = stopped & (sign * answers.bend_angle > 0.0)
    if there.mean() < 0.05:
        return
    axes.text(
        float(np.median(answers.tension_l[there])),
        float(np.median(answers.tension_s[there])),
        f'driven to the\nstop towards {side}',
        ha='center',
        va='center',
        bbox={'facecolor': 'white', 'alpha': 0.75, 'edgecolor': 'none', 'pad': 2.0},
    )
