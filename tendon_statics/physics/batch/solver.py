"""`solve` for many pairs of cable tensions at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..array_roots import Floats, Lines, array_brackets, array_refine
from ..design import JointDesign
from ..errors import TensionError
from ..load import UPRIGHT, Load
from ..regime import Regime
from ..slip import Slip
from ..solver import solve
from ..tensions import MAX_TENSION
from .pairs import broadcast, chunks, dead_arrays, excess_of, facing_slips
from .results import INVALID, REGIME_CODES, EquilibriumBatch

SOLVED = (
    'regime',
    'root_count',
    'iterations',
    'bend_angle',
    'normal_force',
    'stable',
    'residual',
)
"""Fields that are solved for at once; the others follow"""


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
    left, right, load = broadcast(tension_l, tension_s, load)
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
    flat = {name: getattr(results, name).reshape(-1) for name in SOLVED}
    loads = load if isinstance(load, Load) else load.reshape(-1)
    with np.errstate(all='ignore'):
        for part, (chunk_l, chunk_s, *dead) in chunks(left, right, *dead_arrays(design, load)):
            rows = {name: array[part] for name, array in flat.items()}
            of_chunk = loads if isinstance(loads, Load) else loads[part]
            _solve_chunk(
                EquilibriumBatch(design, of_chunk, tension_l=chunk_l, tension_s=chunk_s, **rows),
                dead,
            )
    return results


class SlipRows:
    """The slip functions of many pairs as an `ArrayFunction`."""

    def __init__(self, slip: Slip) -> None:
        self.slip = slip

    def of(self, rows: Any) -> Slip:
        """Return the slip functions of some of the pairs."""
        return self.slip if isinstance(rows, slice) else self.slip.part(rows)

    def probe(self, rows: Any, places: Floats | float) -> Lines:
        """Look at places ahead in rad, one for each row."""
        slip = self.of(rows)
        *known, state = slip.probe(places)
        shape = slip.total.shape
        return [np.broadcast_to(line, shape) for line in (*known, *state)]

    def slope_bounds(self, rows: Any, one: Lines, other: Lines) -> tuple[Floats, Floats]:
        """Return bounds of ∂g/∂θ between two probes of each row."""
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

    light = excess_of(*of_taut()) > 0.0
    if not light.all():
        if design.law.carries_more_than_cables:
            for index in taut[~light]:
                _solve_one(chunk, index)
        taut = taut[light]
    rows = SlipRows(facing_slips(*of_taut()))
    stop = design.max_bend_angle
    found = array_brackets(rows, rows.slip.is_determined, 0.0, stop)
    counts = found.root_count
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
    ends = (list(end[:, rooted]) for end in (found.low, found.high))
    roots = array_refine(SlipRows(slip), *ends)
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
    for name in SOLVED[1:]:
        value = getattr(answer, name)
        array = getattr(chunk, name)
        array[index] = value if value is not None else False if array.dtype == bool else np.nan
