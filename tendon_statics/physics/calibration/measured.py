"""What `calibrate` takes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from numpy.typing import ArrayLike


class Samples(Protocol):
    """What `calibrate` fits to, such as a `Recording`; arrays of shape ``(n,)``."""

    @property
    def tension_l(self) -> ArrayLike:
        """T_l in N."""

    @property
    def tension_s(self) -> ArrayLike:
        """T_s in N."""

    @property
    def bend_angle(self) -> ArrayLike | None:
        """θ in rad, NaN where it was not measured."""

    @property
    def pressure(self) -> ArrayLike | None:
        """Measured p in Pa, likewise, or None."""

    @property
    def base_tilt(self) -> ArrayLike | None:
        """Measured γ in rad, the tilt of the base towards cable s, likewise."""

    @property
    def base_roll(self) -> ArrayLike | None:
        """Measured tilt of the base out of the plane of bending in rad; None: there is none."""

    @property
    def tip_force_x(self) -> ArrayLike | None:
        """Measured force at the tip along X in N, likewise."""

    @property
    def tip_force_z(self) -> ArrayLike | None:
        """Along Z."""

    @property
    def state(self) -> Sequence[str] | None:
        """``slipping``, ``held`` or anything else.

        None: every sample is slipping, unless they follow each other in time.
        """

    @property
    def time(self) -> ArrayLike | None:
        """In s; None: the samples do not follow each other in time."""
