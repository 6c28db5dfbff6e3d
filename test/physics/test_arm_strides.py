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
    suits = flow.suits_strides

    def noted(motion, leg):
        found.append(suits(motion, leg))
        return found[-1]

    monkeypatch.setattr(flow, 'suits_strides', noted)
    return found


def drawn(seed, units, cable_friction=0.0):
    """Return an arm, its tensions and its load."""
    draw = random.Random(seed)
    arm = arm_brute.random_arm(draw, units)
    load = arm_brute.random_load(draw)
    tensions = arm_brute.random_pull(draw, arm, load)
    return Arm(arm.units, arm.cables, cable_friction), tensions, load


@pytest.mark.parametrize('seed', [0, 2, 3, 4, 5, 8, 10, 11])
def test_strides_lead_where_short_legs_do(runs, monkeypatch, seed):
    arm, tensions, load = drawn(f'strides {seed}', 8)
    state = ArmTracker(arm).update(tensions, load)
    assert any(runs)
    monkeypatch.setattr(flow, 'suits_strides', lambda *_: False)
    monkeypatch.setattr(legs, 'LEG_ERROR', 1e-6)
    expected = ArmTracker(arm).update(tensions, load)
    assert state.bend_angles == pytest.approx(expected.bend_angles, abs=2e-3)
    assert state.regimes == expected.regimes
    for regime, margin in zip(state.regimes, state.slip_margins, strict=True):
        assert regime is Regime.DRIVEN_TO_STOP or abs(margin) <= 1.0 + 1e-9


def test_friction_of_the_cables_which_remembers_the_way_is_followed_leg_by_leg(runs):
    arm, tensions, load = drawn('rubs', 8, cable_friction=0.1)
    ArmTracker(arm).update(tensions, load)
    assert runs
    assert not any(runs)
