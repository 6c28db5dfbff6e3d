"""A joint under its dead load, before the cables pull."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from .contact.law import ContactLaw
from .design import JointDesign
from .load import DeadLoad, Load

if TYPE_CHECKING:
    from .stacked_design import StackedDesign


class LoadedJoint(NamedTuple):
    """What a slip function takes from a joint under a dead load."""

    law: ContactLaw
    size: Any
    """|P| in N"""
    tilt: tuple[Any, Any]
    """cos ψ and sin ψ at zero bend"""
    lever: Any
    """(r + δ) / r"""
    moment_x: Any
    """Q_x / r in N"""
    moment_z: Any
    """Q_z / r in N"""
    stiffness: Any
    """k / r in N"""
    turning: Any
    """Size in N of all that turns with the unit"""

    @classmethod
    def of(cls, design: JointDesign | StackedDesign, dead: DeadLoad) -> LoadedJoint:
        """Return a joint under a dead load; of floats, or of arrays where one of the two is."""
        radius, friction = design.ball_radius, design.friction_coefficient
        size = dead.size
        nothing = size == 0.0  # has no direction; along the axis is as good as any
        moment_x, moment_z = dead.moment_x / radius, dead.moment_z / radius
        stiffness = design.stiffness / radius
        return cls(
            design.law,
            size,
            ((nothing - dead.force_z) / (size + nothing), dead.force_x / (size + nothing)),
            design.relative_lever,
            moment_x,
            moment_z,
            stiffness,
            (abs(moment_x) + abs(moment_z) + stiffness) / friction + friction * size,
        )


def loaded_joint(design: JointDesign | StackedDesign, load: Load) -> LoadedJoint:
    """Return a joint under a load; the last of a design is kept, since loads seldom change.

    That saves a twelfth of `solve`.
    """
    kept: tuple[Load, LoadedJoint] | None = design.__dict__.get('_loaded')
    if kept is not None and kept[0] is load:
        return kept[1]
    joint = LoadedJoint.of(design, load.on(design))
    design.__dict__['_loaded'] = load, joint
    return joint
