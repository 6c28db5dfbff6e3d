"""``tendon-statics plot hysteresis``: the path of a unit whose cables trade tension."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from ..physics import StickSlipTracker, admissible_angles
from ..physics.tensions import check_tensions, taut_slip
from .figures import HOLDS, VERMILION
from .pair_options import add_pair_options, between, pair_from, setting_title

if TYPE_CHECKING:
    from matplotlib.figure import Figure

add_arguments = add_pair_options


def draw(drawing: Figure, options: argparse.Namespace) -> None:
    """Draw the path at a constant total, and the angles that friction can hold."""
    design, equilibrium = pair_from(options)
    load = equilibrium.load
    axes = drawing.subplots()
    total = equilibrium.tension_l + equilibrium.tension_s
    # Far enough for the unit to slip both ways, within what the cables can trade.
    not_held = [
        difference
        for difference in between(-0.999 * total, 0.999 * total, 1000)
        if not admissible_angles(design, *_share(total, difference), load)
    ]
    at_limit = [
        min((side * d for d in not_held if side * d > 0.0), default=0.8 * total)
        for side in (-1.0, 1.0)
    ]
    reach = min(1.25 * max(at_limit), 0.999 * total)
    ramp = between(0.0, reach, 401) + between(reach, -reach, 801) + between(-reach, reach, 801)
    tracker = StickSlipTracker(design)
    states = [tracker.update(*_share(total, difference), load) for difference in ramp]

    differences = between(-reach, reach, 401)
    stop = design.max_bend_angle
    angles = between(-stop, stop, 121)
    slips = [
        taut_slip(design, check_tensions(*_share(total, difference)), load)
        for difference in differences
    ]
    margins = [[slip.margin(angle) for slip in slips] for angle in angles]
    degrees = [math.degrees(angle) for angle in angles]
    axes.contourf(differences, degrees, margins, levels=[-1.0, 1.0], colors=[HOLDS])
    axes.plot(
        ramp,
        [math.degrees(state.bend_angle or 0.0) for state in states],
        color=VERMILION,
        # A slip takes no tension: it is drawn upright, at the tensions at which it is found.
        drawstyle='steps-post',
        label='path of the unit: load, unload, load the other way',
    )
    axes.fill_between([], [], color=HOLDS, label='angles that friction can hold')
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
    axes.set_xlim(-1.06 * reach, 1.06 * reach)
    axes.set_ylim(-1.15 * math.degrees(stop), 1.15 * math.degrees(stop))
    axes.legend(loc='upper center', bbox_to_anchor=(0.5, 1.2), ncols=1, frameon=False)
    drawing.suptitle('\n'.join(setting_title(design, load)), fontsize=10)


def _share(total: float, difference: float) -> tuple[float, float]:
    """Tensions of a given sum and difference."""
    return 0.5 * (total - difference), 0.5 * (total + difference)
