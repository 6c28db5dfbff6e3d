"""The bisection in C, compiled and called: what the solver and the batch are measured against."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tendon_statics import JointDesign

SOURCE = Path(__file__).with_name('bisection.c')

TAKEN = (
    *('ball_radius', 'cable_offset', 'com_distance', 'mass', 'friction_coefficient'),
    *('contact_start_angle', 'contact_end_angle', 'max_bend_angle', 'gravity', 'contact_width'),
)
"""What it takes of a design, in its order: the paper's law, and no backbone"""

Floats = NDArray[np.float64]


class Yardstick:
    """``bisection.c`` for one design.

    Parameters
    ----------
    halved : str
        What is bisected: ``equation`` or ``quartic``.

    Raises
    ------
    RuntimeError
        If there is no C compiler, or it fails.
    """

    def __init__(self, design: JointDesign, halved: str = 'equation') -> None:
        compiler = shutil.which('cc')
        if compiler is None:
            raise RuntimeError('there is no C compiler: install one that is called cc')
        with tempfile.TemporaryDirectory() as folder:
            library = Path(folder) / 'bisection.so'
            done = subprocess.run(
                [
                    *(compiler, '-O3', '-shared', '-fPIC', f'-DHALVED={halved}'),
                    *('-o', library, SOURCE, '-lm'),
                ],
                capture_output=True,
                text=True,
                check=False,
            )
            if done.returncode != 0:
                raise RuntimeError(f'{compiler} failed on {SOURCE.name}: {done.stderr}')
            self._library = ctypes.CDLL(str(library))
        self._library.design_size.restype = ctypes.c_size_t
        self._library.solve_each.restype = ctypes.c_double
        self._design = ctypes.create_string_buffer(self._library.design_size())
        self._library.prepare(
            self._design, *(ctypes.c_double(getattr(design, name)) for name in TAKEN)
        )

    def solve_each(self, tension_l: Floats, tension_s: Floats) -> float:
        """Solve pair by pair for angle and pressure; return their sum."""
        total: float = self._library.solve_each(
            self._design,
            ctypes.c_size_t(len(tension_l)),
            _pointer(tension_l),
            _pointer(tension_s),
        )
        return total

    def solve_many(self, tension_l: Floats, tension_s: Floats) -> tuple[Floats, NDArray[np.int8]]:
        """Solve pair by pair for all fields; return 14 rows of numbers and five of codes."""
        count = len(tension_l)
        numbers, codes = np.empty((14, count)), np.empty((5, count), np.int8)
        self._library.solve_many(
            self._design,
            ctypes.c_size_t(count),
            *map(_pointer, (tension_l, tension_s, numbers, codes)),
        )
        return numbers, codes


def _pointer(array: NDArray[np.generic]) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)
