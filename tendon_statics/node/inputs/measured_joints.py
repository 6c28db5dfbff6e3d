"""Measured angles of joints, by name."""

from __future__ import annotations

from collections.abc import Sequence

from sensor_msgs.msg import JointState

from ...tensions.named_values import cable_values


def measured_joints(
    message: JointState, joint_names: Sequence[str]
) -> tuple[dict[int, float], str]:
    """Return the angles of the joints that a message names, and what is against it.

    Joints count from 1 at the base. A message about other joints alone has no angles, and nothing
    is against it.
    """
    found = cable_values(message.name, message.position, joint_names, 'position')
    if found.fault is not None:
        return {}, found.fault[1]
    return {
        joint: angle for joint, angle in enumerate(found.values, start=1) if angle is not None
    }, ''
