"""What would tell contact laws apart that the data do not, by how much.

The best law's slips are predicted, without noise, for the angles and total tensions that were
recorded, as they were recorded and then in another experiment. Another law, with its own best
values, leaves a sum of losses there, which is by how much the criterion of the comparison would
tell the two apart, on average.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ..array_numbers import ARRAYS
from ..array_roots import Floats
from ..errors import CalibrationError
from ..load import Load
from ..loaded_joint import LoadedJoint
from ..sample_loads import SampleLoads
from ..slip import Slip
from .parameters import Model, ParameterSpace
from .problem import Problem
from .samples import SortedSamples

BASE_TILT = math.radians(60.0)
"""Of the base in an experiment"""

MOST_SLIPS = 1000
"""That somebody would record"""

MEASURABLE = ('friction_coefficient', 'cable_offset', 'contact_width')
"""What might be measured on the unit's parts instead of fitted"""

PRESSURE_NOISE = 0.02
"""Of a pressure in an experiment, as a share of its median"""


class Advice(NamedTuple):
    """An experiment that would tell laws apart, and what it would say of them."""

    text: str
    difference: float
    """Of the criterion, on average; of the laws that it tells least"""


@dataclasses.dataclass(frozen=True, eq=False)
class Slips:
    """Slips of a unit without noise: the `Samples` of an experiment."""

    tension_l: Floats
    tension_s: Floats
    bend_angle: Floats
    pressure: Floats | None
    base_tilt: Floats
    base_roll: Floats
    tip_force_x: Floats
    tip_force_z: Floats
    tip_distance: float
    state: None = None
    time: None = None


def predicted_slips(
    model: Model, samples: SortedSamples, loads: SampleLoads, *, with_pressure: bool
) -> Slips:
    """Predict the tensions at which a unit slips, at recorded angles and total tensions.

    Slips for which a cable would have to push are left out.

    Parameters
    ----------
    loads : SampleLoads
        Of the slipping samples in the experiment.
    """
    design, of = model.design, samples.slipping
    angle = samples.bend_angle[of]
    measured_l, measured_s = model.cells.tensions(samples.tension_l[of], samples.tension_s[of])
    total = measured_l + measured_s
    side = samples.distance(model, of).side
    dead = loads.on(design)
    with np.errstate(all='ignore'):
        joint = LoadedJoint.of(design, dead)
        half = 0.5 * total
        slip = Slip(joint, total - dead.size, half, half, side, ARRAYS)
        point = slip.at(side * angle)
        # M is linear in the difference of the tensions, and K depends on their sum alone.
        difference = -side * point.excess * total / design.relative_lever
        normal = slip.law.normal(point.state, point.capacity)
        pressure = total * normal / design.contact_area
    tension_l, tension_s = 0.5 * (total - difference), 0.5 * (total + difference)
    cells = model.cells
    there = np.isfinite(difference) & (np.minimum(tension_l, tension_s) > 0.0)
    loads = loads.part(there)
    return Slips(
        (tension_l[there] - cells.bias_l) / cells.gain_l,
        (tension_s[there] - cells.bias_s) / cells.gain_s,
        angle[there],
        pressure[there] if with_pressure else None,
        np.arctan2(loads.gravity_x, -loads.gravity_z),
        np.arccos(np.clip(np.hypot(loads.gravity_x, loads.gravity_z), 0.0, 1.0)),
        loads.force_x,
        loads.force_z,
        loads.distance,
    )


def advice(possible: Sequence[Problem], needed: float) -> list[Advice]:
    """Say what would tell laws apart, the most telling first.

    Parameters
    ----------
    possible : sequence of Problem
        The fits of laws that the data do not tell apart, the best first.
    needed : float
        Difference of the criterion that is asked for.
    """
    best, others = possible[0], possible[1:]
    model, samples = best.model, best.samples
    count = int(samples.slipping.sum())
    loads = samples.loads.part(samples.slipping)
    with_pressure = bool(samples.with_pressure.any())
    found = []

    def slips(under: SampleLoads = loads, *, pressure: bool = with_pressure) -> Slips:
        return predicted_slips(model, samples, under, with_pressure=pressure)

    def expected(experiment: Sequence[Slips], known: Sequence[str] = ()) -> float:
        return min(_left_over(other, experiment, model, known) for other in others)

    as_recorded = slips()
    here = expected([as_recorded])
    if here > 0.0 and count * needed / here <= MOST_SLIPS:
        more = math.ceil(count * max(needed / here, 1.0))
        found.append(Advice(f'about {more} slips of this kind in all', needed))
    if not np.ptp(np.arctan2(loads.gravity_x, -loads.gravity_z)) > 0.5 * BASE_TILT:
        tilted = loads._replace(
            gravity_x=np.full(count, math.sin(BASE_TILT)),
            gravity_z=np.full(count, -math.cos(BASE_TILT)),
        )
        text = f'as many slips again with the base tilted by {math.degrees(BASE_TILT):.0f} deg'
        found.append(Advice(text, expected([as_recorded, slips(tilted)])))
    weight, distance = model.design.weight, 2.0 * abs(model.design.com_distance)
    if not (loads.force_x.any() or loads.force_z.any()) and weight * distance > 0.0:
        hung = loads._replace(
            force_x=weight * loads.gravity_x, force_z=weight * loads.gravity_z, distance=distance
        )
        text = (
            f'as many slips again with a weight of {weight:.2g} N hung {distance:.2g} m from the '
            'centre of the ball, and its force recorded'
        )
        found.append(Advice(text, expected([as_recorded, slips(hung)])))
    if not with_pressure:
        text = 'a measured pressure of each slip, with a contact_width that is known'
        of_pressure = expected([slips(pressure=True)], ('contact_width',))
        found.append(Advice(text, of_pressure))
    for name in MEASURABLE:
        if name in best.space.names:
            by_law = ', '.join(
                f'{of.model.value(name):.3g} by {of.model.design.contact_law}' for of in possible
            )
            text = f'a {name} that is measured otherwise: it is {by_law}'
            found.append(Advice(text, expected([as_recorded], (name,))))
    telling = [one for one in found if one.difference >= needed]
    return sorted(telling, key=lambda one: -one.difference)


def _left_over(
    problem: Problem, slips: Sequence[Slips], truth: Model, known: Sequence[str] = ()
) -> float:
    """Sum of losses that a law leaves at slips of another, with its best values; 0 if it has none.

    Parameters
    ----------
    problem : Problem
        The law's fit to the data, where the search begins.
    known : sequence of str
        Parameters that are measured otherwise, and so are as in truth.
    """
    data = _joined(slips)
    noise = problem.samples.noise
    if data.pressure is not None and not problem.samples.with_pressure.any():
        noise = noise._replace(pressure=PRESSURE_NOISE * float(np.median(abs(data.pressure))))
    start = problem.model.with_values({name: truth.value(name) for name in known})
    parameters = [one for one in problem.space.parameters if one.name not in known]
    try:
        samples = SortedSamples(start.design, data, noise, Load(tip_distance=data.tip_distance))
        trial = Problem(ParameterSpace(start, parameters, samples), samples)
        if parameters:
            trial.search()
    except CalibrationError:
        return 0.0
    return float(np.nan_to_num(trial.loss()))


def _joined(slips: Sequence[Slips]) -> Slips:
    """Slips of several experiments as those of one."""
    *_, last = slips
    arrays: dict[str, Any] = {
        field.name: np.concatenate([getattr(one, field.name) for one in slips])
        for field in dataclasses.fields(Slips)
        if isinstance(getattr(last, field.name), np.ndarray)
    }
    return dataclasses.replace(last, **arrays)
