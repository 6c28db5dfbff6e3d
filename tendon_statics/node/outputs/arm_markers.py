"""An arm as RViz draws it."""

from __future__ import annotations

from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from ...estimation.arm_estimate import ArmEstimate
from ...estimation.regimes import REGIME_COLOURS, red_green_blue
from ...physics.arm.shape import joint_centres
from .markers import NAMESPACE


def arm_markers(estimate: ArmEstimate, header: Header) -> MarkerArray:
    """Draw each unit as an arrow from its joint to the next, in the colour of its regime.

    Lengths in m, in the base's frame. While the arm is slack its units are taken away.
    """
    angles = estimate.bend_angles
    if angles is None:
        gone = Marker(header=header, ns=NAMESPACE, action=Marker.DELETEALL)
        return MarkerArray(markers=[gone])
    points = [Point(x=x, z=z) for x, z in joint_centres(estimate.arm, angles)]
    found = []
    for number, (design, regime) in enumerate(
        zip(estimate.arm.designs, estimate.regimes, strict=True)
    ):
        red, green, blue = red_green_blue(REGIME_COLOURS[regime])
        marker = Marker(
            header=header,
            ns=NAMESPACE,
            id=number,
            type=Marker.ARROW,
            action=Marker.ADD,
            points=points[number : number + 2],
            color=ColorRGBA(r=red, g=green, b=blue, a=1.0),
        )
        marker.pose.orientation.w = 1.0
        marker.scale.x, marker.scale.y = 0.5 * design.ball_radius, design.ball_radius
        found.append(marker)
    return MarkerArray(markers=found)
