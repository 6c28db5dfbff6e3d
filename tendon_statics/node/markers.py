"""The unit as RViz draws it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from ..physics import Equilibrium, JointDesign, Regime

NAMESPACE = 'tendon_statics'
UNIT, BAND, LABEL = range(3)
"""Identifiers of the markers"""

ARC_STEP = math.radians(2.0)

# Okabe and Ito's palette, told apart with any colour vision.
COLOURS = {
    Regime.EQUILIBRIUM: (0.90, 0.62, 0.00),
    Regime.HELD: (0.00, 0.62, 0.45),
    Regime.SLIPPING: (0.80, 0.47, 0.65),
    Regime.DRIVEN_TO_STOP: (0.84, 0.37, 0.00),
    Regime.SLACK: (0.60, 0.60, 0.60),
}


def unit_markers(
    design: JointDesign,
    result: Equilibrium,
    intervals: Sequence[tuple[float, float]],
    header: Header,
) -> MarkerArray:
    """Draw the unit at its angle, the angles at which friction can hold it, and the regime.

    What is not determined is not drawn, and taken away if it was. Lengths in m, in the joint
    frame: Z along the unit at zero bend, X towards cable s.
    """
    length = 2.0 * max(abs(design.com_distance), design.ball_radius)
    along = math.copysign(1.0, design.com_distance)
    colour = COLOURS[result.regime]
    markers = [_marker(kind, header) for kind in (UNIT, BAND, LABEL)]
    unit, band, label = markers

    if result.bend_angle is None:
        unit.action = Marker.DELETE
    else:
        unit.type = Marker.ARROW
        unit.points = [Point(), _on_arc(along * length, result.bend_angle)]
        unit.scale.x, unit.scale.y = 0.5 * design.ball_radius, design.ball_radius
        unit.color = _colour(colour, 1.0)

    if not intervals:
        band.action = Marker.DELETE
    else:
        band.type = Marker.TRIANGLE_LIST
        band.scale.x = band.scale.y = band.scale.z = 1.0
        band.color = _colour(colour, 0.35)
        band.points = [
            point for interval in intervals for point in _fan(along * length, *interval)
        ]

    label.type = Marker.TEXT_VIEW_FACING
    label.text = result.regime.value
    label.pose.position.z = 1.3 * along * length
    label.scale.z = 0.5 * design.ball_radius
    label.color = _colour(colour, 1.0)
    return MarkerArray(markers=markers)


def no_markers(header: Header) -> MarkerArray:
    """Take all away."""
    marker = _marker(UNIT, header)
    marker.action = Marker.DELETEALL
    return MarkerArray(markers=[marker])


def _marker(kind: int, header: Header) -> Marker:
    marker = Marker(header=header, ns=NAMESPACE, id=kind, action=Marker.ADD)
    marker.pose.orientation.w = 1.0
    return marker


def _fan(radius: float, low: float, high: float) -> list[Point]:
    """Triangles of a sector, both ends of which are exact."""
    steps = max(1, math.ceil((high - low) / ARC_STEP))
    arc = [_on_arc(radius, low + (high - low) * step / steps) for step in range(steps + 1)]
    return [point for pair in pairwise(arc) for point in (Point(), *pair)]


def _on_arc(radius: float, angle: float) -> Point:
    return Point(x=radius * math.sin(angle), z=radius * math.cos(angle))


def _colour(rgb: tuple[float, float, float], alpha: float) -> ColorRGBA:
    red, green, blue = rgb
    return ColorRGBA(r=red, g=green, b=blue, a=alpha)
