"""Long ways of an arm in strides, beside the same ways in short legs alone."""

import random

import arm_brute
import pytest

from tendon_statics import Arm, ArmTracker, Regime
from tendon_statics.physics.arm import flow, legs


@pytest.fixture
def runs(monkeypatch):
    """Whether each way was begun in strides."""
    found = []
    first = flow.first_stride

    def noted(*asked):
        found.append(first(*asked))
        return found[-1]

    monkeypatch.setattr(flow, 'first_stride', noted)
    return found


def drawn(seed, units, cable_friction=0.0):
    """Return an arm, its tensions and its load."""
    draw = random.Random(seed)
    arm = arm_brute.random_arm(draw, units)
    load = arm_brute.random_load(draw)
    tensions = arm_brute.random_pull(draw, arm, load)
    return Arm(arm.units, arm.cables, cable_friction), tensions, load


def led_in_legs(monkeypatch, tracker, *pull):
    """Return the state after short legs alone."""
    with monkeypatch.context() as changed:
        changed.setattr(flow, 'first_stride', lambda *_: None)
        changed.setattr(flow, 'FAR', 0.03)
        changed.setattr(legs, 'FAR', 0.03)
        return tracker.update(*pull)


@pytest.mark.parametrize('seed', [0, 2, 3, 4, 5, 8, 10, 11])
@pytest.mark.parametrize('cable_friction', [0.0, 0.1])
def test_strides_lead_where_short_legs_do(runs, monkeypatch, seed, cable_friction):
    arm, tensions, load = drawn(f'strides {seed}', 8, cable_friction)
    expected = led_in_legs(monkeypatch, ArmTracker(arm), tensions, load)
    state = ArmTracker(arm).update(tensions, load)
    assert any(runs)
    assert state.bend_angles == pytest.approx(expected.bend_angles, abs=2e-3)
    assert state.regimes == expected.regimes
    for regime, margin in zip(state.regimes, state.slip_margins, strict=True):
        assert regime is Regime.DRIVEN_TO_STOP or abs(margin) <= 1.0 + 1e-9


@pytest.mark.parametrize('seed', [4, 8, 9, 12, 21, 23])
def test_what_cables_with_friction_remember_is_that_of_short_legs(runs, monkeypatch, seed):
    arm, tensions, load = drawn(f'back and forth {seed}', 6, cable_friction=0.2)
    tracker = ArmTracker(arm)
    tracker.update(tensions, load)
    before = tracker.bend_angles
    swapped = {
        ('s' if name[0] == 'l' else 'l') + name[1:]: tension for name, tension in tensions.items()
    }
    other = tracker.copy()
    runs.clear()
    state = tracker.update(swapped, load)
    assert any(runs)
    # Some joints come through the straight, where the cables forget.
    assert any(old * new < 0.0 for old, new in zip(before, state.bend_angles, strict=True))
    expected = led_in_legs(monkeypatch, other, swapped, load)
    for name, at_joints in state.cable_tensions.items():
        assert at_joints == pytest.approx(expected.cable_tensions[name], rel=3e-4)
