"""How angle and pressure follow tensions, tilt and design, to first order."""

from __future__ import annotations

from math import hypot, isfinite
from typing import Any, NamedTuple

from .contact.law import NormalSlopes
from .load import DeadLoad
from .named import named
from .slip import Slip, SlipPoint


class TensionGradient(NamedTuple):
    """Derivatives of one quantity by the two cable tensions."""

    tension_l: Any
    tension_s: Any

    def as_dict(self) -> dict[str, Any]:
        """Return `_asdict`, spelt out, which takes a fifth of the time."""
        by_l, by_s = self
        return {'tension_l': by_l, 'tension_s': by_s}

    def stddev(self, tension_stddev: float) -> float:
        """Standard deviation of the quantity, to first order.

        Parameters
        ----------
        tension_stddev : float
            Standard deviation of each tension in N, the two independent.
        """
        return tension_stddev * hypot(self.tension_l, self.tension_s)


def stddev_of(gradient: TensionGradient | None, tension_stddev: float) -> float | None:
    """Return `TensionGradient.stddev` where there is a gradient, else None."""
    return None if gradient is None else gradient.stddev(tension_stddev)


def finite(gradient: TensionGradient) -> TensionGradient | None:
    """Return a gradient if it is one of finite numbers, else None."""
    by_l, by_s = gradient
    return gradient if isfinite(by_l) and isfinite(by_s) else None


ByCable = tuple[Any, Any]
"""Derivatives by the tension of the cable behind the unit and of that ahead of it"""


def slip_by_tensions(slip: Slip, point: SlipPoint, lever: float) -> ByCable:
    """∂g/∂T in units of r, per N; floats, or arrays of one shape.

    Parameters
    ----------
    lever : float
        (r + δ) / r.
    """
    share = slip.share
    common = share * point.by_share - point.moment
    return (common - lever) / slip.total, (common + lever) / slip.total


def slip_by_load(slip: Slip, point: SlipPoint, change: DeadLoad, radius: float) -> float:
    """∂g/∂x in units of r T, for a dead load that a quantity x changes by `change` of each unit.

    Parameters
    ----------
    change : DeadLoad
        In the joint frame.
    radius : float
        r in m.
    """
    (cosine, sine), side = point.turn, slip.side
    moment = (side * change.moment_x * cosine - change.moment_z * sine) / (radius * slip.total)
    force_x, force_z = side * change.force_x, change.force_z
    if not (force_x or force_z):
        return float(moment)
    axial, across = -force_x * sine - force_z * cosine, force_x * cosine - force_z * sine
    size = slip.share * slip.total
    by_share = (point.cosine * axial + point.sine * across) / slip.total
    by_tilt = (point.cosine * across - point.sine * axial) / size if size else 0.0
    return float(moment - point.by_share * by_share - point.by_tilt * by_tilt)


def angle_by_tensions(slip: Slip, point: SlipPoint, lever: float) -> ByCable:
    """∂θ/∂T of the root of g in rad/N, ahead."""
    (behind, ahead), slope = slip_by_tensions(slip, point, lever), point.slope
    return -behind / slope, -ahead / slope


def root_gradient(slip: Slip, point: SlipPoint, lever: float) -> TensionGradient | None:
    """∂θ/∂T of a root of g in rad/N; None where it is infinite."""
    if point.slope == 0.0:
        return None
    return finite(of_sides(slip, angle_by_tensions(slip, point, lever), slip.side))


def normal_by_tensions(
    slip: Slip,
    point: SlipPoint,
    normal: NormalSlopes,
    lever: float,
    *,
    angle: ByCable,
    at_limit: bool,
) -> ByCable:
    """∂N/∂T.

    Parameters
    ----------
    lever : float
        (r + δ) / r.
    angle : ByCable
        ∂θ/∂T in rad/N, ahead; zeros for a unit that stays where it is.
    at_limit : bool
        Whether friction is at its limit; otherwise it takes up the moment.
    """
    share, total, by_tilt = slip.share, slip.total, point.by_tilt
    share_part = share * point.by_share
    n, n_by_share, n_by_tilt, n_by_moment = normal
    common = n - share * n_by_share
    behind, ahead = total * angle[0], total * angle[1]
    if at_limit:
        of_behind, of_ahead = by_tilt * behind - share_part, by_tilt * ahead - share_part
    else:
        of_behind, of_ahead = -lever - point.moment, lever - point.moment
    return (
        common + n_by_tilt * behind + n_by_moment * of_behind,
        common + n_by_tilt * ahead + n_by_moment * of_ahead,
    )


def of_sides(slip: Slip, by_cable: ByCable, sign: Any = 1.0) -> TensionGradient:
    """Derivatives by T_l and T_s; `sign` turns what is counted ahead into what is towards s."""
    behind, ahead = by_cable
    by_l, by_s = slip.numbers.swapped(slip.side < 0.0, behind, ahead)
    return named(TensionGradient, (sign * by_l, sign * by_s))
