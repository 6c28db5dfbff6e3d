"""An arm that lingers where it can only just not rest, beside the same way in short legs."""

import dataclasses

import pytest
from designs import PRELIMINARY

from tendon_statics import Arm, ArmTracker, ArmUnit, Cable, Regime
from tendon_statics.physics.arm import flow, legs

DESIGN = dataclasses.replace(PRELIMINARY, friction_coefficient=0.3, stiffness=0.05)


def arm_of(count):
    """Return units around a sheath, with a pair of cables for each."""
    cables = [Cable(f'{side}{unit}', side, unit) for unit in range(1, count + 1) for side in 'ls']
    return Arm([ArmUnit(DESIGN, 0.02)] * count, cables)


def pulled(arm, to_s):
    """Return tensions that differ by a pull to one side."""
    return {
        cable.name: 1.0 + cable.sign * to_s * (1.0 if cable.last_unit % 2 else 0.5)
        for cable in arm.cables
    }


def just_before_it_runs(arm):
    """Return a tracker, and the pulls between which the arm just rests and just runs."""

    def runs(tracker, to_s):
        before = tracker.bend_angles
        after = tracker.update(pulled(arm, to_s)).bend_angles
        return max(abs(a - b) for a, b in zip(after, before, strict=True)) > 0.5

    tracker = ArmTracker(arm)
    tracker.update(pulled(arm, 0.8))
    rests = 0.8
    while not runs(tracker.copy(), rests - 0.02):
        rests -= 0.02
        tracker.update(pulled(arm, rests))
    moves = rests - 0.02
    for _ in range(25):
        middle = 0.5 * (rests + moves)
        if runs(tracker.copy(), middle):
            moves = middle
        else:
            rests = middle
    return tracker, rests, moves


@pytest.mark.parametrize('count', [5, 6, 8, 10])
def test_an_arm_that_just_runs_ends_where_short_legs_lead(monkeypatch, count):
    arm = arm_of(count)
    tracker, rests, moves = just_before_it_runs(arm)
    crept, creep = [], flow.creep

    def noted(*at):
        crept.append(creep(*at))
        return crept[-1]

    monkeypatch.setattr(flow, 'creep', noted)
    still = tracker.copy().update(pulled(arm, rests))
    state = tracker.copy().update(pulled(arm, moves))
    assert any(crept)
    assert max(abs(margin) for margin in still.slip_margins) == pytest.approx(1.0, abs=1e-9)
    for regime, margin in zip(state.regimes, state.slip_margins, strict=True):
        assert regime is Regime.DRIVEN_TO_STOP or abs(margin) <= 1.0 + 1e-9
    monkeypatch.setattr(flow, 'creep', lambda *_: False)
    monkeypatch.setattr(flow, 'first_stride', lambda *_: None)
    for module in (flow, legs):
        monkeypatch.setattr(module, 'FAR', 0.03)
    # A little beyond, so that legs are sure to run too: what lets it run is exact to 1e-4 N or so.
    expected = tracker.update(pulled(arm, moves - 3e-4))
    assert state.bend_angles == pytest.approx(expected.bend_angles, abs=3e-3)
    assert state.regimes == expected.regimes
