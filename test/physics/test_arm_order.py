"""`arm_slip_order` and `arm_tensions_for`: which joint slips when, and what makes one slip."""

import dataclasses
import random

import arm_brute
import pytest
from arms import arm_of
from designs import PRELIMINARY
from make_docs import ROOT

from tendon_statics import (
    Arm,
    ArmError,
    ArmTracker,
    ArmUnit,
    Cable,
    UnreachableError,
    arm_margins,
    arm_slip_order,
    arm_tensions_for,
    load_arm,
)

ARM = load_arm(ROOT / 'config/arm.yaml')
EVEN = dict.fromkeys(ARM.cable_names, 1.0)
UNIT = ArmUnit(PRELIMINARY, 0.02)
ONE_PAIR = arm_of([UNIT] * 4)
TWO_PAIRS = Arm([UNIT] * 4, [*ONE_PAIR.cables, Cable('l2', 'l', 2), Cable('s2', 's', 2)])


@pytest.fixture(scope='module')
def order_of_the_example():
    return arm_slip_order(ARM, EVEN, {**EVEN, 's_tip': 2.4})


def test_the_joints_of_the_example_slip_from_the_tip_to_the_base(order_of_the_example):
    order = order_of_the_example
    assert [slip.joint for slip in order] == [5, 4, 3, 2, 1]
    assert [slip.share for slip in order] == sorted(slip.share for slip in order)
    assert {slip.side for slip in order} == {'s'}
    for slip in order:
        assert slip.tensions['s_tip'] == pytest.approx(1.0 + 1.4 * slip.share)


def test_just_before_its_share_nothing_slips_and_just_after_the_joint_does(order_of_the_example):
    first = order_of_the_example[0]
    for share, slips in ((first.share - 1e-6, False), (first.share + 1e-6, True)):
        margins = arm_margins(ARM, [0.0] * 5, {**EVEN, 's_tip': 1.0 + 1.4 * share})
        assert (abs(margins[first.joint - 1]) > 1.0) is slips
        assert all(abs(margin) < 1.0 for margin in margins[: first.joint - 1])


def test_every_joint_that_ends_elsewhere_is_in_the_order():
    draw = random.Random(8)
    for _ in range(5):
        arm = arm_brute.random_arm(draw)
        load = arm_brute.random_load(draw)
        start, end = (arm_brute.random_pull(draw, arm, load) for _ in range(2))
        tracker = ArmTracker(arm)
        tracker.update(start, load)
        for step in range(1, 501):
            tensions = {k: start[k] + (end[k] - start[k]) * step / 500 for k in start}
            tracker.update(tensions, load)
        moved = {n for n, angle in enumerate(tracker.bend_angles, start=1) if angle}
        order = arm_slip_order(arm, start, end, load)
        assert moved <= {slip.joint for slip in order}
        assert len({slip.joint for slip in order}) == len(order)


def test_a_joint_that_frees_the_others_comes_before_them():
    order = arm_slip_order(ONE_PAIR, {'l': 1.0, 's': 1.0}, {'l': 1.0, 's': 3.0})
    assert [slip.joint for slip in order] == [4, 3, 2, 1]
    assert len({slip.share for slip in order}) == 1


def test_where_friction_holds_all_the_way_no_joint_slips():
    assert arm_slip_order(ARM, EVEN, {**EVEN, 's_tip': 1.2}) == []


def test_what_slips_at_once_is_at_the_start_of_the_ramp():
    order = arm_slip_order(ARM, {**EVEN, 's_tip': 2.4}, {**EVEN, 's_tip': 2.5})
    assert {slip.share for slip in order} == {0.0}
    assert len(order) == 5


@pytest.mark.parametrize(
    ('arm', 'joint', 'side'),
    [
        (ONE_PAIR, 4, 's'),
        (ONE_PAIR, 4, 'l'),
        (TWO_PAIRS, 4, 's'),
        (TWO_PAIRS, 2, 's'),
        (ARM, 5, 'l'),
    ],
)
def test_with_these_tensions_the_joint_is_at_its_limit_and_all_others_are_not(arm, joint, side):
    tensions = arm_tensions_for(arm, joint, side, tension_range=(1.0, 8.0))
    assert all(1.0 - 1e-9 <= tension <= 8.0 + 1e-9 for tension in tensions.values())
    margins = arm_margins(arm, [0.0] * len(arm.units), tensions)
    assert margins[joint - 1] == pytest.approx(1.0 if side == 's' else -1.0, abs=1e-9)
    others = [abs(margin) for index, margin in enumerate(margins) if index != joint - 1]
    assert max(others) < 1.0


def test_no_tensions_that_are_tried_leave_the_others_more():
    best = arm_tensions_for(TWO_PAIRS, 2, 's', tension_range=(1.0, 8.0))

    def level(tensions):
        """Largest margin of the others, the tension s2 being such that joint 2 is at its limit."""
        low, high = 0.1, 60.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            margins = arm_margins(TWO_PAIRS, [0.0] * 4, {**tensions, 's2': middle})
            low, high = (middle, high) if margins[1] < 1.0 else (low, middle)
        if not 1.0 <= high <= 8.0:
            return None
        return max(abs(margin) for index, margin in enumerate(margins) if index != 1)

    at_best = level(best)
    draw = random.Random(2)
    tried = [
        level({name: draw.uniform(1.0, 8.0) for name in TWO_PAIRS.cable_names}) for _ in range(300)
    ]
    found = [value for value in tried if value is not None]
    assert len(found) > 20
    assert min(found) > at_best - 1e-6


@pytest.mark.parametrize(
    ('joint', 'tension_range', 'reason'),
    [
        (1, (1.0, 8.0), 'joint 4 slips before joint 1 does'),
        (4, (1.0, 1.5), 'joint 4 does not come to its limit towards s'),
        (4, (0.01, 0.02), 'pull'),
    ],
)
def test_where_none_do_the_reason_is_said(joint, tension_range, reason):
    with pytest.raises(UnreachableError, match=reason) as caught:
        arm_tensions_for(ONE_PAIR, joint, 's', tension_range=tension_range)
    assert '\n' not in str(caught.value)


@pytest.mark.parametrize(
    'more', [{'joint': 5}, {'side': 'x'}, {'tension_range': (2.0, 1.0)}, {'tension_range': 3.0}]
)
def test_what_cannot_be_asked_is_refused(more):
    asked = {'joint': 1, 'side': 's', 'tension_range': (1.0, 2.0), **more}
    with pytest.raises(ArmError):
        arm_tensions_for(ONE_PAIR, asked.pop('joint'), asked.pop('side'), **asked)


def test_a_lone_unit_is_brought_to_its_limit_as_the_single_inverse_does():
    from tendon_statics import tensions_for

    design = dataclasses.replace(
        PRELIMINARY, contact_law='friction_circle', friction_coefficient=0.3
    )
    arm = arm_of([ArmUnit(design, 0.02)])
    found = arm_tensions_for(arm, 1, 's', tension_range=(1.0, 5.0), bend_angles=[0.2])
    single = tensions_for(design, 0.2, total_tension=sum(found.values()))
    assert tuple(found.values()) == pytest.approx(tuple(single), rel=1e-9)
