"""Which topics of a bag hold what was measured."""

from __future__ import annotations

import dataclasses

FORCE_COMPONENTS = ('x', 'y', 'z', 'norm')


@dataclasses.dataclass(frozen=True)
class BagTopics:
    """Topics of a bag, and where in their messages the numbers are.

    The defaults are the estimator's own topics and parameters.
    """

    tensions: tuple[str, ...] = ('/tensions',)
    """One topic of ``std_msgs/Float64MultiArray`` [T_l, T_s], of ``sensor_msgs/JointState`` with
    tensions as effort or of ``tendon_statics_interfaces/Estimate``, or a pair of
    ``geometry_msgs/WrenchStamped``, cable l first; N"""
    cable_names: tuple[str, str] = ('cable_l', 'cable_s')
    """Names of the cables in a ``JointState``"""
    force_component: str = 'z'
    """Of a ``WrenchStamped``: one of `FORCE_COMPONENTS`"""
    bend_angle: str | None = None
    """Topic of ``std_msgs/Float64`` or of ``sensor_msgs/JointState`` with the angle as position,
    rad; None: ``/measured_bend_angle`` if the bag has it"""
    joint_name: str | None = None
    """Name of the joint in that ``JointState``; None if it has just one"""
    pressure: str | None = None
    """Topic of ``std_msgs/Float64``, Pa; None: ``/measured_pressure`` if the bag has it"""
    state: str | None = None
    """Topic of ``std_msgs/String``: ``slipping`` or ``held``"""
    max_skew: float = 0.02
    """s by which a message may be apart from the tensions that it is taken to belong to"""
