"""An arm as RViz draws it."""

from __future__ import annotations

import math

from geometry_msgs.msg import Point
from std_msgs.msg import Header
from visualization_msgs.msg import Marker, MarkerArray

from ...estimation.arm_estimate import ArmEstimate
from ...estimation.regimes import REGIME_COLOURS, red_green_blue
from ...physics.arm.shape import joint_centres
from .markers import (
    FORCE_COLOUR,
    GRAVITY_COLOUR,
    fan,
    make_arrow,
    make_band,
    make_label,
    new_marker,
)

KINDS = UNIT, BAND = 'units', 'bands'
"""Namespaces of the markers that each unit has, by its number from 0 at the base"""

WHOLE = 'arm'
"""Namespace of those of the arm as a whole"""

LABEL, GRAVITY, TIP_FORCE = range(3)
"""Identifiers in that"""


def arm_markers(estimate: ArmEstimate, header: Header) -> MarkerArray:
    """Draw all units where they are, and the angles at which friction can hold each, and the load.

    The band of a unit starts from its joint: there it would stay, with all other joints frozen,
    under the tensions that cross it. Colours are those of the regimes; the label names the joint
    that asks for attention most. Lengths in m, in the base's frame. What is not determined is
    taken away if it was drawn.
    """
    arm, load = estimate.arm, estimate.known.load
    count = len(arm.units)
    markers = {(of, n): new_marker(n, header, of) for n in range(count) for of in KINDS}
    whole = [new_marker(number, header, WHOLE) for number in range(3)]
    label, gravity, tip_force = whole
    angles = estimate.bend_angles
    size = arm.designs[0].ball_radius
    reach = sum(unit.length for unit in arm.units)
    if angles is None:
        for marker in markers.values():
            marker.action = Marker.DELETE
    else:
        centres = [Point(x=x, z=z) for x, z in joint_centres(arm, angles)]
        base_tilt = 0.0
        bands = estimate.bands
        for number, unit in enumerate(arm.units):
            colour = red_green_blue(REGIME_COLOURS[estimate.regimes[number]])
            start, end = centres[number : number + 2]
            width = 0.5 * unit.design.ball_radius
            make_arrow(markers[UNIT, number], start, end, width, colour)
            make_band(
                markers[BAND, number],
                [
                    Point(x=start.x + point.x, z=start.z + point.z)
                    for low, high in bands[number]
                    for point in fan(unit.length, base_tilt + low, base_tilt + high)
                ],
                colour,
            )
            base_tilt += angles[number]

    worst = estimate.worst
    make_label(
        label,
        estimate.summary,
        Point(z=reach + 2.0 * size),
        0.7 * size,
        red_green_blue(REGIME_COLOURS[estimate.regimes[worst]]),
    )
    x, y, z = (0.3 * reach * part for part in load.gravity_direction)
    beside = -2.0 * size
    make_arrow(gravity, Point(y=beside), Point(x=x, y=beside + y, z=z), 0.2 * size, GRAVITY_COLOUR)
    force = math.hypot(*load.tip_force)
    if angles is None or not force > 0.0:
        tip_force.action = Marker.DELETE
    else:
        x, z = (0.3 * reach * part / force for part in load.tip_force)
        tip = centres[-1]
        start = Point(x=tip.x - x, z=tip.z - z)
        make_arrow(tip_force, start, tip, 0.2 * size, FORCE_COLOUR)
    return MarkerArray(markers=[*markers.values(), *whole])
