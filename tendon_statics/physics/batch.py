"""Many pairs of cable tensions at once, as NumPy arrays."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .array_numbers import ARRAYS
from .array_roots import Floats, Lines, array_brackets, array_refine
from .design import JointDesign
from .errors import LoadError, TensionError
from .forces import ContactForces, ForceRemainder, contact_forces
from .gradients import TensionGradient, angle_by_tensions, normal_by_tensions, of_sides
from .load import UPRIGHT, DeadLoad, Load, tension_excess
from .slip import LoadedJoint, Slip, SlipPoint
from .solver import solve
from .state import Regime
from .tensions import MAX_TENSION

REGIME_CODES = {regime: code for code, regime in enumerate(Regime)}
"""Regime → its number in `EquilibriumBatch.regime`"""

INVALID = -1
"""The number in `EquilibriumBatch.regime` of a pair for which `solve` raises"""

CHUNK = 16384
"""Pairs that are worked on at a time, so that the processor's cache holds them"""

_NAMES = np.array([*(regime.value for regime in Regime), 'invalid'])


@dataclasses.dataclass(frozen=True, eq=False)
class EquilibriumBatch:
    """The answers of `solve_batch`: the fields of `Equilibrium` as arrays of one shape.

    What the model does not determine is NaN, or False where it would be true or false. The
    pressure, the forces and the gradients are worked out, and then kept, when they are asked for.
    """

    design: JointDesign
    load: Load | NDArray[np.object_]
    """What acts beside the cables: one load, or an array of them of the shape of the results"""
    regime: NDArray[np.int8]
    """Numbers by `REGIME_CODES`; `INVALID` for a pair for which `solve` raises"""
    tension_l: Floats
    """T_l in N, as given: a view where one will do, so leave what it shows as it is"""
    tension_s: Floats
    """T_s in N, likewise"""
    root_count: NDArray[np.uint8]
    iterations: NDArray[np.uint8]
    """Steps to the root: of Newton's method, or of the bisection where that was needed"""
    bend_angle: Floats
    """θ in rad"""
    normal_force: Floats
    """N in N"""
    stable: NDArray[np.bool_]
    residual: Floats
    """(|M| − K) / (μ r) in N"""

    @property
    def regime_names(self) -> NDArray[np.str_]:
        """The regimes as text: the values of `Regime`, or ``invalid``."""
        names: NDArray[np.str_] = _NAMES[self.regime]
        return names

    @cached_property
    def pressure(self) -> Floats:
        """P in Pa."""
        return self.normal_force / self.design.contact_area

    @property
    def slip_margin(self) -> Floats:
        """M / K at the angle: ±1 at the limit of friction, beyond that only against the stop."""
        margins = np.empty(self.bend_angle.shape)
        flat = margins.reshape(-1)
        with np.errstate(all='ignore'):
            for part, slip, point in self._points():
                flat[part] = slip.side * point.moment / point.capacity
        return np.where(np.isnan(self.bend_angle), np.nan, margins)

    @property
    def forces(self) -> ContactForces:
        """The forces on the joint surface in N."""
        return self._contact[0]

    @property
    def force_remainder(self) -> ForceRemainder:
        """What Eqs. (1) and (2) leave over, one by one, in N."""
        return self._contact[1]

    @property
    def branch_consistent(self) -> NDArray[np.bool_]:
        """Whether Eqs. (1) and (2) ask for the contact force taken."""
        return self._contact[2]

    @property
    def bend_angle_gradient(self) -> TensionGradient:
        """∂θ/∂T in rad/N; NaN also where it is infinite."""
        return self._gradients[0]

    @property
    def pressure_gradient(self) -> TensionGradient:
        """∂p/∂T in Pa/N; NaN also where it is infinite."""
        return self._gradients[1]

    def bend_angle_stddev(self, tension_stddev: float) -> Floats:
        """Return the standard deviation of each angle in rad, as `Equilibrium` does."""
        by_l, by_s = self.bend_angle_gradient
        deviation: Floats = tension_stddev * np.hypot(by_l, by_s)
        return deviation

    def pressure_stddev(self, tension_stddev: float) -> Floats:
        """Return the standard deviation of each pressure in Pa."""
        by_l, by_s = self.pressure_gradient
        deviation: Floats = tension_stddev * np.hypot(by_l, by_s)
        return deviation

    @cached_property
    def _contact(self) -> tuple[ContactForces, ForceRemainder, NDArray[np.bool_]]:
        shape = self.bend_angle.shape
        numbers: Any = np.full((6, *shape), np.nan)
        consistent: Any = np.zeros(shape, np.bool_)
        rows, flags = numbers.reshape(6, -1), consistent.reshape(-1)
        with np.errstate(all='ignore'):
            for at, slip, point in self._points():
                state, limit = point.state, point.capacity
                normal = slip.law.normal(state, limit)
                forces, remainder = contact_forces(slip, point, limit, normal)
                for row, values in zip(rows, (*forces, *remainder), strict=True):
                    row[at] = values
                flags[at] = slip.law.consistent(state, limit)
        return ContactForces(*numbers[:4]), ForceRemainder(*numbers[4:]), consistent

    @cached_property
    def _gradients(self) -> tuple[TensionGradient, TensionGradient]:
        numbers: Any = np.full((4, *self.bend_angle.shape), np.nan)
        rows = numbers.reshape(4, -1)
        regimes = self.regime.reshape(-1)
        with np.errstate(all='ignore'):
            for at, slip, point in self._points():
                at_stop = regimes[at] == REGIME_CODES[Regime.DRIVEN_TO_STOP]
                gradients = _gradients_of(self.design, slip, point, at_stop)
                for row, values in zip(rows, gradients, strict=True):
                    row[at] = values
        return TensionGradient(*numbers[:2]), TensionGradient(*numbers[2:])

    def _points(self) -> Iterator[tuple[NDArray[np.intp], Slip, SlipPoint]]:
        """Walk through the pairs with an angle: yield where they are, and the slip functions."""
        for part, chunk in _chunks(
            *(self.tension_l, self.tension_s, self.bend_angle),
            *_dead_arrays(self.design, self.load),
        ):
            (known,) = np.nonzero(~np.isnan(chunk[2]))
            tension_l, tension_s, angle, *dead = (values[known] for values in chunk)
            at = known + part.start
            load = self.load if isinstance(self.load, Load) else self.load.reshape(-1)[at]
            slip = _facing_slips(self.design, load, tension_l, tension_s, dead)
            yield at, slip, slip.at(np.abs(angle))


def solve_batch(
    design: JointDesign,
    tension_l: ArrayLike,
    tension_s: ArrayLike,
    load: Load | Sequence[Any] | NDArray[np.object_] = UPRIGHT,
) -> EquilibriumBatch:
    """Solve for many pairs of tensions: what `solve` answers for each, as arrays.

    The angles are those of `solve` to 1e-12 rad as a rule, and to 1e-9 always: each is found
    within a bracket of 1e-10 rad over which the slip function changes sign. A pair that `solve`
    would refuse does not stop the others; its regime is `INVALID`.

    Parameters
    ----------
    tension_l, tension_s : array_like
        Cable tensions T_l and T_s in N, of shapes that broadcast to one another.
    load : Load or array_like of Load
        What acts beside them: one for all, or of a shape that broadcasts with theirs.

    Raises
    ------
    TensionError
        If the tensions are not numbers, or the shapes do not fit.
    LoadError
        If the loads are not loads.
    """
    left, right, load = _broadcast(tension_l, tension_s, load)
    shape = left.shape
    results = EquilibriumBatch(
        design=design,
        load=load,
        regime=np.full(shape, INVALID, np.int8),
        tension_l=left,
        tension_s=right,
        root_count=np.zeros(shape, np.uint8),
        iterations=np.zeros(shape, np.uint8),
        bend_angle=np.full(shape, np.nan),
        normal_force=np.full(shape, np.nan),
        stable=np.zeros(shape, np.bool_),
        residual=np.full(shape, np.nan),
    )
    flat = {name: getattr(results, name).reshape(-1) for name in _SOLVED}
    loads = load if isinstance(load, Load) else load.reshape(-1)
    with np.errstate(all='ignore'):
        for part, (chunk_l, chunk_s, *dead) in _chunks(left, right, *_dead_arrays(design, load)):
            rows = {name: array[part] for name, array in flat.items()}
            of_chunk = loads if isinstance(loads, Load) else loads[part]
            _solve_chunk(
                EquilibriumBatch(design, of_chunk, tension_l=chunk_l, tension_s=chunk_s, **rows),
                dead,
            )
    return results


_SOLVED = (
    'regime',
    'root_count',
    'iterations',
    'bend_angle',
    'normal_force',
    'stable',
    'residual',
)


def _broadcast(
    tension_l: ArrayLike, tension_s: ArrayLike, load: Any
) -> tuple[Floats, Floats, Load | NDArray[np.object_]]:
    """Return tensions, and loads if there are several, as arrays of one shape.

    Raises
    ------
    TensionError, LoadError
        As `solve_batch` does.
    """
    arrays: list[NDArray[Any]] = []
    for name, values in (('tension_l', tension_l), ('tension_s', tension_s)):
        try:
            array = np.asarray(values)
        except ValueError:
            raise TensionError(f'{name} is no array: its rows differ in length') from None
        if array.dtype.kind not in 'iuf':
            raise TensionError(
                f'{name} has values of type {array.dtype}, real numbers are needed; in N'
            )
        arrays.append(array.astype(np.float64, copy=False))
    shapes = f'tension_l has shape {arrays[0].shape} and tension_s {arrays[1].shape}'
    if not isinstance(load, Load):
        loads = np.asarray(load, dtype=object)
        if not all(isinstance(one, Load) for one in loads.flat):
            raise LoadError(f'load is {load!r}, but a Load, or an array of them, is needed')
        arrays.append(loads)
        shapes += f' and load {loads.shape}'
    try:
        left, right, *rest = np.broadcast_arrays(*arrays)
    except ValueError:
        raise TensionError(
            f'{shapes}, which do not fit: equal shapes are needed, or ones that NumPy can '
            'broadcast'
        ) from None
    return left, right, rest[0] if rest else load


def _dead_arrays(
    design: JointDesign, load: Load | NDArray[np.object_]
) -> tuple[NDArray[Any], ...]:
    """The dead loads of several loads, part by part; nothing of a single load."""
    if isinstance(load, Load):
        return ()
    parts = np.array([one.on(design) for one in load.flat], np.float64).reshape(-1, 4)
    return tuple(part.reshape(load.shape) for part in parts.T)


def _chunks(*arrays: NDArray[Any]) -> Iterator[tuple[slice, tuple[NDArray[Any], ...]]]:
    """Walk through arrays of one shape: yield a slice of the flat result, and what is there."""
    walk = np.nditer(
        arrays,
        flags=['external_loop', 'buffered', 'zerosize_ok'],
        order='C',
        buffersize=CHUNK,
    )
    start = 0
    for chunk in walk if walk.itersize else ():
        end = start + len(chunk[0])
        yield slice(start, end), chunk
        start = end


def _excess(
    design: JointDesign, load: Any, tension_l: Any, tension_s: Any, dead: Sequence[Any]
) -> Floats:
    """T − |P| in N of each pair."""
    of_load: Any = DeadLoad(*dead) if dead else load.on(design)
    size = of_load.size
    excess: Any = tension_l + tension_s - size
    # Few pairs are so near the load that they need the exact sum.
    for index in np.flatnonzero(np.abs(excess) <= 0.01 * size):
        its_load, its_size = (load[index], size[index]) if dead else (load, size)
        excess[index] = tension_excess(
            *(design, its_load, float(its_size)), float(tension_l[index]), float(tension_s[index])
        )
    return excess  # type: ignore[no-any-return]


def _facing_slips(
    design: JointDesign, load: Any, tension_l: Any, tension_s: Any, dead: Sequence[Any]
) -> Slip:
    """The slip functions of taut pairs, each towards the side of the stronger cable."""
    of_load: Any = DeadLoad(*dead) if dead else load.on(design)
    excess = _excess(design, load, tension_l, tension_s, dead)
    side = np.where(tension_l > tension_s, -1.0, 1.0)
    return Slip(LoadedJoint.of(design, of_load), excess, tension_l, tension_s, side, ARRAYS)


class _Rows:
    """The slip functions of many pairs as an `ArrayFunction`."""

    def __init__(self, slip: Slip) -> None:
        self.slip = slip

    def of(self, rows: Any) -> Slip:
        """Return the slip functions of some of the pairs."""
        return self.slip if isinstance(rows, slice) else self.slip.part(rows)

    def probe(self, rows: Any, places: Floats | float) -> Lines:
        slip = self.of(rows)
        *known, state = slip.probe(places)
        shape = slip.total.shape
        return [np.broadcast_to(line, shape) for line in (*known, *state)]

    def slope_bounds(self, rows: Any, one: Lines, other: Lines) -> tuple[Floats, Floats]:
        return self.of(rows).slope_bounds(*((*ends[:8], tuple(ends[8:])) for ends in (one, other)))


def _solve_chunk(chunk: EquilibriumBatch, dead: Sequence[Any]) -> None:
    """Fill in the results of one chunk."""
    design, tension_l, tension_s = chunk.design, chunk.tension_l, chunk.tension_s
    weak: Any = np.minimum(tension_l, tension_s)
    taken = (weak >= 0.0) & (np.maximum(tension_l, tension_s) <= MAX_TENSION)
    chunk.regime[taken & (weak == 0.0)] = REGIME_CODES[Regime.SLACK]
    (taut,) = np.nonzero(taken & (weak > 0.0))

    def of_taut() -> tuple[Any, ...]:
        load = chunk.load[taut] if dead else chunk.load  # type: ignore[index]
        return design, load, tension_l[taut], tension_s[taut], [part[taut] for part in dead]

    light = _excess(*of_taut()) > 0.0
    if not light.all():
        if design.law.carries_more_than_cables:
            for index in taut[~light]:
                _solve_one(chunk, index)
        taut = taut[light]
    rows = _Rows(_facing_slips(*of_taut()))
    stop = design.max_bend_angle
    found = array_brackets(rows, len(taut), 0.0, stop)
    counts = np.where(rows.slip.is_determined, found.root_count, 0)
    driven = (counts == 0) & (found.at_low > 0.0)
    chunk.regime[taut] = REGIME_CODES[Regime.HELD]
    chunk.root_count[taut] = counts

    (at_stop,) = np.nonzero(driven)
    chunk.regime[taut[at_stop]] = REGIME_CODES[Regime.DRIVEN_TO_STOP]
    _fill(chunk, taut[at_stop], rows.slip.part(at_stop), stop)
    chunk.stable[taut[at_stop]] = True

    (rooted,) = np.nonzero(counts)
    chunk.regime[taut[rooted]] = REGIME_CODES[Regime.EQUILIBRIUM]
    slip = rows.slip.part(rooted)
    roots = array_refine(_Rows(slip), *(list(ends[:, rooted]) for ends in (found.low, found.high)))
    slope = _fill(chunk, taut[rooted], slip, roots.places)
    chunk.stable[taut[rooted]] = slope < 0.0
    chunk.iterations[taut[rooted]] = roots.steps

    unresolved = found.unresolved
    unresolved[rooted] |= roots.unresolved
    for index in taut[unresolved]:
        _solve_one(chunk, index)


def _fill(chunk: EquilibriumBatch, at: NDArray[Any], slip: Slip, ahead: Floats | float) -> Floats:
    """Fill in what follows from the angles ahead, in rad; return ∂g/∂θ there."""
    probe = slip.probe(ahead)
    slope, state = probe[2], probe[8]
    chunk.bend_angle[at] = slip.side * ahead
    chunk.normal_force[at] = slip.total * slip.law.normal(state, state[0])
    chunk.residual[at] = slip.residual_at(probe)
    return slope  # type: ignore[no-any-return]


def _solve_one(chunk: EquilibriumBatch, index: int) -> None:
    """Fill in the answer of `solve`."""
    load = chunk.load if isinstance(chunk.load, Load) else chunk.load[index]
    pair = float(chunk.tension_l[index]), float(chunk.tension_s[index])
    try:
        answer = solve(chunk.design, *pair, load)
    except TensionError:
        return
    chunk.regime[index] = REGIME_CODES[answer.regime]
    for name in _SOLVED[1:]:
        value = getattr(answer, name)
        array = getattr(chunk, name)
        array[index] = value if value is not None else False if array.dtype == bool else np.nan


def _gradients_of(
    design: JointDesign, slip: Slip, point: SlipPoint, at_stop: NDArray[np.bool_]
) -> Floats:
    """∂θ/∂T_l, ∂θ/∂T_s, ∂p/∂T_l and ∂p/∂T_s of units that are about to slip, or at their stop."""
    lever = design.relative_lever
    behind, ahead = angle_by_tensions(slip, point, lever)
    angle = np.where(at_stop, 0.0, behind), np.where(at_stop, 0.0, ahead)
    slopes = slip.law.normal_slopes(point.state, point.capacity)
    normal = normal_by_tensions(slip, point, slopes, lever, angle=angle, at_limit=True)
    gradients = np.array(
        [
            *of_sides(slip, angle, slip.side),
            *(by / design.contact_area for by in of_sides(slip, normal)),
        ]
    )
    gradients[:, ~np.isfinite(gradients).all(axis=0)] = np.nan
    return gradients
