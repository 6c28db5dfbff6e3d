"""What each sample of a recording is used for in a calibration."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..array_roots import Floats
from ..design import JointDesign
from ..errors import CalibrationError
from ..load import UPRIGHT, Load
from ..sample_loads import SampleLoads, seating_tension
from ..tensions import MAX_TENSION
from .boundary_distance import BoundaryDistance, Noise, boundary_distance
from .measured import Samples
from .parameters import Model, Models
from .result import HELD, SLIPPING
from .sessions import follow_each_other

AT_STOP = 3.0
"""Standard deviations of the angle within which a unit at rest is taken to be at its stop"""

STILL = 6.0
"""The same within which two samples of a unit at rest are, one after the other"""

HELD_CONFIDENCE = 0.99865
"""Probability with which noise alone leaves a hold that reaches the boundary uncounted: that of
three standard deviations to one side"""


class SortedSamples:
    """Samples as arrays, sorted by what they are used for.

    Parameters
    ----------
    design : JointDesign
        At which it is judged whether the joint is seated, and where the stop is.
    load : Load
        What of the load was not recorded.
    others : sequence of JointDesign
        Designs that have to take each sample too.

    Attributes
    ----------
    tension_l, tension_s, bend_angle, pressure : ndarray
        Shape ``(n,)``, NaN where there is none.
    loads : SampleLoads
        What acts beside the cables.
    roles : ndarray
        Of each sample, ``slipping``, ``held`` or why it is not used.
    slipping, held, with_pressure : ndarray
        Which samples those are.
    counts : dict
        Samples by role, and how many holds there are.

    Raises
    ------
    CalibrationError
        If it is not known which samples are slipping, or none of them can be used.
    """

    def __init__(
        self,
        design: JointDesign,
        data: Samples,
        noise: Noise,
        load: Load = UPRIGHT,
        others: Sequence[JointDesign] = (),
    ) -> None:
        if data.bend_angle is None:
            raise CalibrationError('there is no measured bend angle in the data')
        why = '' if data.state is not None else follow_each_other(data)
        if why:
            raise CalibrationError(
                f'the samples follow each other in time, as {why}, but have no state that says '
                'which of them are slipping: take it from the motions of the angle (mark_motion), '
                'or say that all are (the state slipping)'
            )
        self.noise = noise
        self.tension_l = as_floats(data.tension_l)
        self.tension_s = as_floats(data.tension_s)
        self.bend_angle = np.where(
            np.isfinite(angle := as_floats(data.bend_angle)), angle, math.nan
        )
        count = len(self.tension_l)
        missing = np.full(count, math.nan)
        self.pressure = missing if data.pressure is None else as_floats(data.pressure)
        self.loads = SampleLoads.of(
            load,
            count,
            base_tilt=data.base_tilt,
            base_roll=data.base_roll,
            tip_force_x=data.tip_force_x,
            tip_force_z=data.tip_force_z,
        )
        self.states_are_known = data.state is not None
        state = [SLIPPING] * count if data.state is None else data.state
        self.roles = self._roles([design, *others], np.array(state, dtype=object))
        self.slipping = self.roles == SLIPPING
        self.held = self.roles == HELD
        self.with_pressure = self.slipping & np.isfinite(self.pressure)
        self._first_of_hold, sizes = self._holds()
        self._explained = _largest_of(sizes)
        self.counts = self._counts()
        if not self.slipping.any():
            unused = ', '.join(f'{n} {name}' for name, n in self.counts.items() if n)
            hint = ''
            if self.counts.get('beyond the stop'):
                hint = '; angles without a unit are in rad'
            raise CalibrationError(
                f'none of {count} samples is known to be slipping and can be used ({unused}){hint}'
            )

    def _roles(
        self, designs: Sequence[JointDesign], state: NDArray[np.object_]
    ) -> NDArray[np.str_]:
        """State of every sample, or why it cannot be used."""
        self._rests = self._numbered_rests(state)
        angle = abs(_medians(self.bend_angle, self._rests))
        near = AT_STOP * self.noise.bend_angle
        stop = designs[0].max_bend_angle
        total = self.tension_l + self.tension_s
        loads = self.loads
        seating = np.max([seating_tension(of, loads.on(of)) for of in designs], axis=0)
        weak = np.minimum(self.tension_l, self.tension_s)
        strong = np.maximum(self.tension_l, self.tension_s)
        # Later ones are stronger.
        reasons = {
            'of no known state': (state != SLIPPING) & (state != HELD),
            'at the stop': angle >= stop - near,
            'beyond the stop': angle > stop + near,
            'without an angle': ~np.isfinite(self.bend_angle),
            'below the weight': ~(total > seating),
            'without a base tilt': ~np.isfinite(loads.gravity_x + loads.gravity_z),
            'without a tip force': ~np.isfinite(loads.force_x + loads.force_z),
            'slack': weak == 0.0,
            'of invalid tensions': ~((weak >= 0.0) & (strong <= MAX_TENSION)),
        }
        roles = np.where(state == SLIPPING, SLIPPING, HELD).astype('<U24')
        for reason, holds in reasons.items():
            roles[holds] = reason
        roles[self._repeats(roles == SLIPPING)] = 'repeated'
        return roles

    def _numbered_rests(self, state: NDArray[np.object_]) -> NDArray[np.intp]:
        """Number of the rest that each sample belongs to.

        A rest is a run of held samples whose angle stays what it was but for noise, and the
        slipping one that ends it; any other sample is one by itself.
        """
        change = abs(np.diff(_last_known(self.bend_angle), prepend=math.nan))
        goes_on = (state == HELD) | (state == SLIPPING)
        goes_on[1:] &= state[:-1] == HELD
        goes_on[:1] = False
        return np.cumsum(~goes_on | (change > STILL * self.noise.bend_angle))

    def _repeats(self, of: NDArray[np.bool_]) -> NDArray[np.intp]:
        """Indices of samples that are the same as an earlier one to the last digit.

        A copied row, or a reading that was not renewed, is no measurement of its own.
        """
        indices = np.flatnonzero(of)
        rows = np.stack(
            [self.tension_l, self.tension_s, self.bend_angle, self.pressure, *self.loads[:4]]
        )
        _, first = np.unique(
            np.nan_to_num(rows[:, indices], nan=-math.inf), axis=1, return_index=True
        )
        return np.delete(indices, first)

    def _holds(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Where each hold begins among the held samples, and how many samples it has."""
        rests = self._rests[self.held]
        _, first, sizes = np.unique(rests, return_index=True, return_counts=True)
        return first, sizes

    def _counts(self) -> dict[str, int]:
        names, numbers = np.unique(self.roles, return_counts=True)
        return {
            SLIPPING: 0,
            'with pressure': int(self.with_pressure.sum()),
            HELD: 0,
            'holds': len(self._first_of_hold),
            **{str(name): int(n) for name, n in zip(names, numbers, strict=True)},
        }

    def distance(self, model: Model, of: NDArray[np.bool_]) -> BoundaryDistance:
        """Distance of some of the samples from the boundary of a model."""
        return BoundaryDistance(
            *(values[:, 0] for values in self.distances(Models.of([model]), of))
        )

    def distances(self, models: Models, of: NDArray[np.bool_]) -> BoundaryDistance:
        """Distance of some of the samples from the boundaries of models.

        Shape ``(n, models)``, or ``(n, 1)`` if it is the same from all.
        """
        column = np.flatnonzero(of)[:, np.newaxis]
        return boundary_distance(
            models.design,
            self.tension_l[column],
            self.tension_s[column],
            self.bend_angle[column],
            self.pressure[column],
            self.noise,
            self.loads.part(column),
            models.cells,
        )

    def hold_excesses(self, held_distances: Floats, scale: float) -> Floats:
        """How far each hold lies beyond the boundary, other than by noise, shape ``(holds,)``.

        Parameters
        ----------
        held_distances : ndarray
            Of the held samples from the boundary, in standard deviations of the stated noise; of
            several models one in each column.
        scale : float
            What the noise is, as a multiple of the stated.
        """
        if not len(held_distances):
            return held_distances
        farthest = np.maximum.reduceat(held_distances, self._first_of_hold)
        excesses: Floats = np.maximum(farthest.T - scale * self._explained, 0.0).T
        return excesses


def as_floats(values: ArrayLike) -> Floats:
    """Return an array of one dimension."""
    return np.atleast_1d(np.asarray(values, dtype=np.float64))


def _last_known(values: Floats) -> Floats:
    """Values with that before it in place of every NaN."""
    places = np.where(np.isnan(values), 0, np.arange(len(values)))
    return values[np.maximum.accumulate(places)]


def _medians(values: Floats, groups: NDArray[np.intp]) -> Floats:
    """Median over the group of each value, without NaN; groups are 1, 2, ... in a row."""
    groups = groups - 1
    known = np.bincount(groups, ~np.isnan(values)).astype(np.intp)
    ordered = values[np.lexsort((values, groups))]  # NaN come last in each group
    first = np.flatnonzero(np.diff(groups, prepend=-1))
    lower, upper = ordered[first + (known - 1).clip(0) // 2], ordered[first + known // 2]
    medians: Floats = (0.5 * (lower + upper))[groups]
    return medians


def _largest_of(sizes: NDArray[np.intp]) -> Floats:
    """What the largest of so many Gaussian noises stays below with `HELD_CONFIDENCE`."""
    from scipy.special import ndtri

    largest: Floats = ndtri(HELD_CONFIDENCE ** (1.0 / sizes))
    return largest
