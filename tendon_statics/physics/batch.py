"""Many pairs of cable tensions at once, as NumPy arrays."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .array_roots import ArraySlipEquation
from .contact import Contact, ContactForces, ForceRemainder, split_contact
from .design import JointDesign
from .equilibrium import Regime
from .errors import TensionError
from .sensitivity import TensionGradient, derivatives
from .solver import MAX_TENSION, solve

REGIME_CODES = {regime: code for code, regime in enumerate(Regime)}
"""Regime → its number in `EquilibriumBatch.regime`"""

INVALID = -1
"""The number in `EquilibriumBatch.regime` of a pair for which `solve` raises"""

CHUNK = 16384
"""Pairs that are worked on at a time, so that the processor's cache holds them"""

_NAMES = np.array([*(regime.value for regime in Regime), 'invalid'])

Floats = NDArray[np.float64]


@dataclasses.dataclass(frozen=True, eq=False)
class EquilibriumBatch:
    """The answers of `solve_batch`: the fields of `Equilibrium` as arrays of one shape.

    What the model does not determine is NaN, or False where it would be true or false. The
    pressure, the forces and the gradients are worked out, and then kept, when they are asked for.
    """

    design: JointDesign
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
    """N = p C w in N"""
    stable: NDArray[np.bool_]
    residual: Floats
    """g(θ) = N_m − N_f in N"""

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
    def forces(self) -> ContactForces:
        """The forces on the joint surface in N."""
        return self._contact.forces

    @property
    def force_remainder(self) -> ForceRemainder:
        """What Eqs. (1) and (2) leave over, one by one, in N."""
        return self._contact.remainder

    @property
    def branch_consistent(self) -> NDArray[np.bool_]:
        """Whether μ N sin(β + θ) > W."""
        flags: Any = self._contact.branch_consistent
        return flags  # type: ignore[no-any-return]

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
    def _contact(self) -> Contact:
        shape = self.bend_angle.shape
        numbers: Any = np.empty((6, *shape))
        consistent: Any = np.empty(shape, np.bool_)
        rows, flags = numbers.reshape(6, -1), consistent.reshape(-1)
        with np.errstate(all='ignore'):
            for part, chunk in _chunks(*self._tensions, self.bend_angle, self.normal_force):
                contact = _contact_of(self.design, *chunk)
                rows[:, part] = (*contact.forces, *contact.remainder)
                flags[part] = contact.branch_consistent
        return Contact(ContactForces(*numbers[:4]), ForceRemainder(*numbers[4:]), consistent)

    @cached_property
    def _gradients(self) -> tuple[TensionGradient, TensionGradient]:
        numbers: Any = np.empty((4, *self.bend_angle.shape))
        rows = numbers.reshape(4, -1)
        with np.errstate(all='ignore'):
            for part, chunk in _chunks(*self._tensions, self.bend_angle, self.regime):
                rows[:, part] = _gradients_of(self.design, *chunk)
        return TensionGradient(*numbers[:2]), TensionGradient(*numbers[2:])

    @property
    def _tensions(self) -> tuple[Floats, Floats]:
        return self.tension_l, self.tension_s


def solve_batch(
    design: JointDesign, tension_l: ArrayLike, tension_s: ArrayLike
) -> EquilibriumBatch:
    """Solve for many pairs of tensions: what `solve` answers for each, as arrays.

    The angles are those of `solve` to 1e-12 rad as a rule, and to 1e-9 always: each is found
    within a bracket of 1e-10 rad over which g changes sign. A pair that `solve` would refuse does
    not stop the others; its regime is `INVALID`.

    Parameters
    ----------
    tension_l, tension_s : array_like
        Cable tensions T_l and T_s in N, of shapes that broadcast to one another.

    Raises
    ------
    TensionError
        If the tensions are not numbers, or their shapes do not fit.
    """
    left, right = _broadcast(tension_l, tension_s)
    shape = left.shape
    results = EquilibriumBatch(
        design=design,
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
    with np.errstate(all='ignore'):
        for part, (chunk_l, chunk_s) in _chunks(left, right):
            rows = {name: array[part] for name, array in flat.items()}
            _solve_chunk(EquilibriumBatch(design, tension_l=chunk_l, tension_s=chunk_s, **rows))
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


def _broadcast(tension_l: ArrayLike, tension_s: ArrayLike) -> tuple[Floats, Floats]:
    """Return the tensions as arrays of one shape.

    Raises
    ------
    TensionError
        As `solve_batch` does.
    """
    arrays = []
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
    try:
        left, right = np.broadcast_arrays(*arrays)
    except ValueError:
        raise TensionError(
            f'tension_l has shape {arrays[0].shape} and tension_s {arrays[1].shape}, '
            'which do not fit: equal shapes are needed, or ones that NumPy can broadcast'
        ) from None
    return left, right


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


def _solve_chunk(chunk: EquilibriumBatch) -> None:
    """Fill in the results of one chunk."""
    design, tension_l, tension_s = chunk.design, chunk.tension_l, chunk.tension_s
    weak: Any = np.minimum(tension_l, tension_s)
    strong: Any = np.maximum(tension_l, tension_s)
    taken = (weak >= 0.0) & (strong <= MAX_TENSION)
    chunk.regime[taken & (weak == 0.0)] = REGIME_CODES[Regime.SLACK]
    (taut,) = np.nonzero(taken & (weak > 0.0))
    weak, strong = weak[taut], strong[taut]
    equation = ArraySlipEquation(design, weak, strong)
    light: Any = equation.excess > 0.0
    if not light.all():
        taut, equation = taut[light], equation.of(light)
    stop = design.max_bend_angle
    brackets = equation.brackets(stop)
    unresolved = brackets.unresolved

    driven = (brackets.root_count == 0) & brackets.slips_at_zero
    regimes = np.where(
        driven, REGIME_CODES[Regime.DRIVEN_TO_STOP], REGIME_CODES[Regime.HELD]
    ).astype(np.int8)
    (rooted,) = np.nonzero(brackets.root_count)
    regimes[rooted] = REGIME_CODES[Regime.EQUILIBRIUM]
    chunk.regime[taut] = regimes
    chunk.root_count[taut] = brackets.root_count

    at = taut[driven]
    part = equation.of(np.flatnonzero(driven))
    _fill(chunk, at, part, part.points_at(equation.geometry.attitude(stop)))
    chunk.stable[at] = True

    at = taut[rooted]
    part = equation.of(rooted)
    roots = part.roots(brackets.low[rooted], brackets.high[rooted])
    points = part.points(roots.bend_angle)
    _fill(chunk, at, part, points)
    of_moment, of_force = part.slopes(points)
    chunk.stable[at] = of_moment < of_force
    chunk.iterations[at] = roots.steps
    unresolved[rooted] |= roots.unresolved

    for index in taut[unresolved]:
        _solve_one(chunk, index)


def _fill(
    chunk: EquilibriumBatch, at: NDArray[Any], equation: ArraySlipEquation, points: Floats
) -> None:
    """Fill in what follows from the angles, which are towards the stronger cable."""
    angle, moment, force, _, _ = points
    mirrored = chunk.tension_l[at] > chunk.tension_s[at]
    chunk.bend_angle[at] = np.where(mirrored, -angle, angle)
    chunk.normal_force[at] = equation.total * force
    chunk.residual[at] = equation.total * (moment - force)


def _solve_one(chunk: EquilibriumBatch, index: int) -> None:
    """Fill in the answer of `solve`."""
    answer = solve(chunk.design, float(chunk.tension_l[index]), float(chunk.tension_s[index]))
    chunk.regime[index] = REGIME_CODES[answer.regime]
    for name in _SOLVED[1:]:
        value = getattr(answer, name)
        array = getattr(chunk, name)
        array[index] = value if value is not None else False if array.dtype == bool else np.nan


def _contact_of(
    design: JointDesign, tension_l: Any, tension_s: Any, bend_angle: Any, normal_force: Any
) -> Contact:
    """`contact_at` for a chunk."""
    geometry = design.slip_geometry
    side = np.where(tension_l > tension_s, -1.0, 1.0)
    sine, cosine = np.sin(bend_angle), np.cos(bend_angle)
    # Of φ, the sine with the sign of the side.
    sin_phi = geometry.sine * side * cosine + geometry.cosine * sine
    cos_phi = geometry.cosine * cosine - geometry.sine * side * sine
    return split_contact(
        design,
        tension_l + tension_s,
        normal_force,
        side * (design.friction_coefficient * normal_force),
        phi=(sin_phi, cos_phi),
        theta=(sine, cosine),
    )


def _gradients_of(
    design: JointDesign, tension_l: Any, tension_s: Any, bend_angle: Any, regime: Any
) -> Floats:
    """`gradients_at_limit` for a chunk: ∂θ/∂T_l, ∂θ/∂T_s, ∂p/∂T_l, ∂p/∂T_s."""
    equation = ArraySlipEquation(
        design, np.minimum(tension_l, tension_s), np.maximum(tension_l, tension_s)
    )
    points = equation.points(np.abs(bend_angle))
    of_moment, of_force = equation.slopes(points)
    slope: Any = of_moment - of_force
    slope[regime == REGIME_CODES[Regime.DRIVEN_TO_STOP]] = np.inf
    by_total: Any = (1.0 - points[2]) / points[3]
    by_angle: Any = of_force
    behind, ahead = derivatives(design, by_total=by_total, by_angle=by_angle, slope=slope)
    mirrored = tension_l > tension_s
    gradients = np.array(
        [
            np.where(mirrored, -ahead[0], behind[0]),
            np.where(mirrored, -behind[0], ahead[0]),
            np.where(mirrored, ahead[1], behind[1]),
            np.where(mirrored, behind[1], ahead[1]),
        ]
    )
    gradients[:, ~np.isfinite(gradients).all(axis=0)] = np.nan
    return gradients
