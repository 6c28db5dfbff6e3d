"""What RViz is told to draw of an arm."""

import math
import random

import pytest
from arm_brute import random_arm, random_load, random_pull
from make_docs import ROOT
from std_msgs.msg import Header
from visualization_msgs.msg import Marker

from tendon_statics import ArmTracker, Load, Regime, arm_margins, load_arm
from tendon_statics.estimation.arm_estimate import ArmEstimate
from tendon_statics.estimation.arm_settings import ArmSettings
from tendon_statics.estimation.estimate import KnownLoad
from tendon_statics.estimation.regimes import REGIME_COLOURS, red_green_blue
from tendon_statics.node.outputs.arm_markers import BAND, UNIT, WHOLE, arm_markers
from tendon_statics.physics.arm.shape import joint_centres

HEADER = Header(frame_id='base')
ARM = load_arm(ROOT / 'config/arm.yaml')
EVEN = dict.fromkeys(ARM.cable_names, 1.0)


def drawn(arm, tensions, load=None):
    load = load or Load()
    names = tuple(f'arm_joint_{number}' for number in range(1, len(arm.units) + 1))
    state = ArmTracker(arm).update(tensions, load)
    estimate = ArmEstimate(state, KnownLoad(load), ArmSettings(arm, names))
    markers = arm_markers(estimate, HEADER).markers
    assert len({(marker.ns, marker.id) for marker in markers}) == len(markers)
    return state, {(marker.ns, marker.id): marker for marker in markers}


@pytest.mark.parametrize('seed', range(4))
def test_every_unit_reaches_from_its_joint_to_the_next_in_the_colour_of_its_regime(seed):
    draw = random.Random(seed)
    arm, load = random_arm(draw), random_load(draw)
    state, markers = drawn(arm, random_pull(draw, arm, load), load)
    centres = joint_centres(arm, state.bend_angles)
    for number, regime in enumerate(state.regimes):
        unit = markers[UNIT, number]
        assert (unit.type, unit.action) == (Marker.ARROW, Marker.ADD)
        for point, centre in zip(unit.points, centres[number : number + 2], strict=True):
            assert (point.x, point.z) == pytest.approx(centre)
        colour = (unit.color.r, unit.color.g, unit.color.b)
        assert colour == pytest.approx(red_green_blue(REGIME_COLOURS[regime]))


@pytest.mark.parametrize('seed', [1, 2, 3, 4, 5, 7])
def test_a_band_ends_where_its_joint_would_slip_with_the_others_frozen(seed):
    """Against the margins of the arm, at the ends of the band."""
    draw = random.Random(seed)
    arm, load = random_arm(draw, friction=False), random_load(draw)
    tensions = random_pull(draw, arm, load)
    state, markers = drawn(arm, tensions, load)
    centres, tilt, seen = joint_centres(arm, state.bend_angles), 0.0, 0
    for number, angle in enumerate(state.bend_angles):
        band, (x, z) = markers[BAND, number], centres[number]
        stop = arm.stops[number]
        edges = [point for place, point in enumerate(band.points) if place % 3]  # no apex
        ends = [
            math.remainder(math.atan2(point.x - x, point.z - z) - tilt, math.tau)
            for point in edges
        ]
        for end in (min(ends), max(ends)) if ends else ():
            angles = list(state.bend_angles)
            angles[number] = max(-stop, min(end, stop))
            margin = abs(arm_margins(arm, angles, tensions, load)[number])
            assert abs(end) <= stop + 1e-9
            assert margin == pytest.approx(1.0, abs=1e-5) or (
                margin < 1.0 and abs(end) > stop - 1e-9
            )
            seen += 1
        tilt += angle
    assert seen


def test_the_label_names_the_joint_that_asks_for_attention_and_load_is_drawn():
    load = Load((0.0, 0.0, -1.0), tip_force=(0.03, -0.04))
    _, markers = drawn(ARM, EVEN | {'s_tip': 2.0}, load)
    assert markers[WHOLE, 0].text.startswith('worst is arm_joint_')
    start, end = markers[WHOLE, 1].points
    assert end.z < start.z
    start, end = markers[WHOLE, 2].points
    assert (end.x - start.x) / (end.z - start.z) == pytest.approx(0.03 / -0.04)
    _, markers = drawn(ARM, EVEN)
    assert markers[WHOLE, 2].action == Marker.DELETE


def test_a_slack_arm_is_taken_away():
    state, markers = drawn(ARM, EVEN | {'s_tip': 0.0})
    assert state.regimes[0] is Regime.SLACK
    for kind in (UNIT, BAND):
        assert all(markers[kind, number].action == Marker.DELETE for number in range(5))
    assert markers[WHOLE, 0].text.endswith('slack')
