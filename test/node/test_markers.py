"""What RViz is told to draw."""

import math

import numpy as np
import pytest
from designs import PRELIMINARY, cases
from estimates import estimate_of
from hypothesis import given
from std_msgs.msg import Header
from visualization_msgs.msg import Marker

from tendon_statics import Load, Regime, solve
from tendon_statics.estimation.regimes import REGIME_COLOURS, red_green_blue
from tendon_statics.node.outputs.markers import no_markers, unit_markers
from tendon_statics.physics import admissible_angles

HEADER = Header(frame_id='joint')
HELD, SLIPPING, STOP, SLACK = (1.0, 1.5), (1.0, 2.0), (1.0, 3.0), (0.0, 2.0)


def drawn(design, tensions) -> tuple[Marker, Marker, Marker]:
    estimate = estimate_of(solve(design, *tensions))
    unit, band, label, *_ = unit_markers(estimate, HEADER).markers
    return unit, band, label


@pytest.mark.parametrize('tensions', [SLIPPING, STOP, SLIPPING[::-1]])
def test_the_unit_points_to_its_angle(tensions):
    unit, _, label = drawn(PRELIMINARY, tensions)
    tip = unit.points[1]
    assert math.atan2(tip.x, tip.z) == pytest.approx(solve(PRELIMINARY, *tensions).bend_angle)
    assert unit.action == label.action == Marker.ADD
    assert unit.header.frame_id == 'joint'


def test_gravity_and_the_force_on_the_tip_are_arrows():
    load = Load((0.6, 0.0, -0.8), tip_force=(0.03, -0.04), tip_distance=0.02)
    result = solve(PRELIMINARY, *STOP, load)
    *_, gravity, tip_force = unit_markers(estimate_of(result), HEADER).markers
    start, end = gravity.points
    arrow = np.array([end.x - start.x, end.y - start.y, end.z - start.z])
    assert arrow / np.linalg.norm(arrow) == pytest.approx(load.gravity_direction)
    start, end = tip_force.points
    angle = result.bend_angle
    assert (end.x, end.z) == pytest.approx((0.02 * math.sin(angle), 0.02 * math.cos(angle)))
    assert (end.x - start.x) / (end.z - start.z) == pytest.approx(0.03 / -0.04)
    *_, gravity, tip_force = unit_markers(estimate_of(solve(PRELIMINARY, *STOP)), HEADER).markers
    assert (gravity.action, tip_force.action) == (Marker.ADD, Marker.DELETE)


def test_what_is_not_determined_is_taken_away():
    unit, band, label = drawn(PRELIMINARY, HELD)
    assert (unit.action, band.action, label.text) == (Marker.DELETE, Marker.ADD, 'held')
    unit, band, label = drawn(PRELIMINARY, SLACK)
    assert (unit.action, band.action, label.text) == (Marker.DELETE, Marker.DELETE, 'slack')
    assert no_markers(HEADER).markers[0].action == Marker.DELETEALL


def test_regimes_differ_in_colour():
    assert set(REGIME_COLOURS) == set(Regime)
    assert len(set(map(red_green_blue, REGIME_COLOURS.values()))) == len(REGIME_COLOURS)


@given(cases())
def test_the_band_is_the_admissible_angles(case):
    """Its triangles cover the intervals, no more and no less."""
    design, tension_l, tension_s = case
    intervals = admissible_angles(design, tension_l, tension_s)
    _, band, _ = drawn(design, (tension_l, tension_s))
    assert len(band.points) % 3 == 0
    side = math.copysign(1.0, design.com_distance)
    angles = [math.atan2(side * point.x, side * point.z) for point in band.points]
    covered = sum(angles[2::3]) - sum(angles[1::3])
    assert covered == pytest.approx(sum(high - low for low, high in intervals), abs=1e-9)
    for angle in angles[1::3] + angles[2::3]:
        assert any(low - 1e-9 <= angle <= high + 1e-9 for low, high in intervals)
