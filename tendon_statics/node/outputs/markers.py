"""The unit as RViz draws it."""

from __future__ import annotations

import math
from itertools import pairwise

from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from ...estimation.estimate import Estimate
from ...estimation.regimes import REGIME_COLOURS, red_green_blue

NAMESPACE = 'tendon_statics'
UNIT, BAND, LABEL, GRAVITY, TIP_FORCE = range(5)
"""Identifiers of the markers"""

ARC_STEP = math.radians(2.0)

GRAVITY_COLOUR, FORCE_COLOUR = (0.3, 0.3, 0.3), (0.8, 0.1, 0.1)


def unit_markers(estimate: Estimate, header: Header) -> MarkerArray:
    """Draw the unit at its angle, the angles at which friction can hold it, regime and load.

    What is not determined is not drawn, and taken away if it was. Lengths in m, in the joint
    frame: Z along the unit at zero bend, X towards cable s. So all is drawn tilted where the base
    is, if its frame is known to be; the arrow of gravity shows which direction was taken.
    """
    design, load, intervals = estimate.design, estimate.load, estimate.admissible_angles
    length = 2.0 * max(abs(design.com_distance), design.ball_radius)
    along = math.copysign(1.0, design.com_distance)
    colour = red_green_blue(REGIME_COLOURS[estimate.regime])
    kinds = (UNIT, BAND, LABEL, GRAVITY, TIP_FORCE)
    markers = [new_marker(kind, header) for kind in kinds]
    unit, band, label, gravity, tip_force = markers

    if estimate.bend_angle is None:
        unit.action = Marker.DELETE
    else:
        end = _on_arc(along * length, estimate.bend_angle)
        make_arrow(unit, Point(), end, 0.5 * design.ball_radius, colour)

    points = [point for interval in intervals for point in fan(along * length, *interval)]
    make_band(band, points, colour)
    place = Point(z=1.3 * along * length)
    make_label(label, estimate.regime.value, place, 0.5 * design.ball_radius, colour)

    x, y, z = (0.7 * length * part for part in load.gravity_direction)
    beside = -2.0 * design.ball_radius
    make_arrow(
        gravity,
        Point(y=beside),
        Point(x=x, y=beside + y, z=z),
        0.2 * design.ball_radius,
        GRAVITY_COLOUR,
    )
    force = math.hypot(*load.tip_force)
    if estimate.bend_angle is None or not force > 0.0:
        tip_force.action = Marker.DELETE
    else:
        x, z = (0.7 * length * part / force for part in load.tip_force)
        tip = _on_arc(load.tip_distance, estimate.bend_angle)
        start = Point(x=tip.x - x, z=tip.z - z)
        make_arrow(tip_force, start, tip, 0.2 * design.ball_radius, FORCE_COLOUR)
    return MarkerArray(markers=markers)


def no_markers(header: Header) -> MarkerArray:
    """Take all away."""
    marker = new_marker(UNIT, header)
    marker.action = Marker.DELETEALL
    return MarkerArray(markers=[marker])


def new_marker(kind: int, header: Header, namespace: str = NAMESPACE) -> Marker:
    """Return a marker that is to be drawn."""
    marker = Marker(header=header, ns=namespace, id=kind, action=Marker.ADD)
    marker.pose.orientation.w = 1.0
    return marker


def make_arrow(
    marker: Marker, start: Point, end: Point, width: float, rgb: tuple[float, float, float]
) -> None:
    """Make a marker an arrow, of a width in m."""
    marker.type = Marker.ARROW
    marker.points = [start, end]
    marker.scale.x, marker.scale.y = width, 2.0 * width
    marker.color = _colour(rgb, 1.0)


def make_band(marker: Marker, points: list[Point], rgb: tuple[float, float, float]) -> None:
    """Make a marker the band of some triangles, which lets through; of none it is taken away."""
    if not points:
        marker.action = Marker.DELETE
        return
    marker.type = Marker.TRIANGLE_LIST
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0
    marker.color = _colour(rgb, 0.35)
    marker.points = points


def make_label(
    marker: Marker, text: str, place: Point, height: float, rgb: tuple[float, float, float]
) -> None:
    """Make a marker a text that is so many m high."""
    marker.type = Marker.TEXT_VIEW_FACING
    marker.text = text
    marker.pose.position = place
    marker.scale.z = height
    marker.color = _colour(rgb, 1.0)


def fan(radius: float, low: float, high: float) -> list[Point]:
    """Triangles of a sector about the origin, both ends of which are exact; angles in rad."""
    steps = max(1, math.ceil((high - low) / ARC_STEP))
    arc = [_on_arc(radius, low + (high - low) * step / steps) for step in range(steps + 1)]
    return [point for pair in pairwise(arc) for point in (Point(), *pair)]


def _on_arc(radius: float, angle: float) -> Point:
    return Point(x=radius * math.sin(angle), z=radius * math.cos(angle))


def _colour(rgb: tuple[float, float, float], alpha: float) -> ColorRGBA:
    red, green, blue = rgb
    return ColorRGBA(r=red, g=green, b=blue, a=alpha)
