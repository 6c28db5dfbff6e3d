"""Many pairs of tensions and their loads: arrays of one shape, gone through in parts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..array_numbers import ARRAYS
from ..array_roots import Floats
from ..design import JointDesign
from ..errors import LoadError, TensionError
from ..load import DeadLoad, Load, tension_excess
from ..slip import LoadedJoint, Slip

CHUNK = 16384
"""Pairs that are worked on at a time, so that the processor's cache holds them"""


def broadcast(
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


def dead_arrays(design: JointDesign, load: Load | NDArray[np.object_]) -> tuple[NDArray[Any], ...]:
    """The dead loads of several loads, part by part; nothing of a single load."""
    if isinstance(load, Load):
        return ()
    parts = np.array([one.on(design) for one in load.flat], np.float64).reshape(-1, 4)
    return tuple(part.reshape(load.shape) for part in parts.T)


def chunks(*arrays: NDArray[Any]) -> Iterator[tuple[slice, tuple[NDArray[Any], ...]]]:
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


def excess_of(
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


def facing_slips(
    design: JointDesign, load: Any, tension_l: Any, tension_s: Any, dead: Sequence[Any]
) -> Slip:
    """The slip functions of taut pairs, each towards the side of the stronger cable."""
    of_load: Any = DeadLoad(*dead) if dead else load.on(design)
    excess = excess_of(design, load, tension_l, tension_s, dead)
    side = np.where(tension_l > tension_s, -1.0, 1.0)
    return Slip(LoadedJoint.of(design, of_load), excess, tension_l, tension_s, side, ARRAYS)
