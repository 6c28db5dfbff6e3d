"""`noise_risk`: what one noisy reading can do to a unit that is followed by a tracker."""

import math
from dataclasses import replace

import numpy as np
import pytest
from designs import PRELIMINARY

from tendon_statics.physics import StickSlipTracker, solve, tensions_for
from tendon_statics.physics.noise_risk import noise_risk

SPRUNG = replace(PRELIMINARY, contact_law='friction_circle', stiffness=0.02)
"""It comes to rest at a stable angle wherever it slips to"""


def rising(design, share, noise, readings=3000):
    """The largest error of a tracker on noisy tensions at rest, `share` of the way to slip."""
    random = np.random.default_rng(2)
    at_slip = tensions_for(design, 0.05, total_tension=3.0)
    pull = share * (at_slip[1] - at_slip[0])
    rest = (0.5 * (3.0 - pull), 0.5 * (3.0 + pull))
    tracker = StickSlipTracker(design, 0.05)
    risk = noise_risk(tracker.update(*rest), noise)
    for _ in range(readings):
        tracker.update(*(tension + random.normal(0.0, noise) for tension in rest))
    return risk, abs(tracker.bend_angle - 0.05)


@pytest.mark.parametrize('design', [PRELIMINARY, SPRUNG])
@pytest.mark.parametrize(('share', 'noise'), [(0.995, 0.002), (0.9, 0.002), (0.995, 0.02)])
def test_what_is_called_unsafe_is_what_carries_a_tracked_unit_away(design, share, noise):
    risk, error = rising(design, share, noise)
    assert risk.is_unsafe == (error > math.radians(1.0)), (risk, error)


def test_a_unit_at_its_stop_or_without_an_angle_is_carried_nowhere():
    assert noise_risk(solve(PRELIMINARY, 1.0, 3.0), 0.01) is None
    assert noise_risk(solve(PRELIMINARY, 1.0, 1.5), 0.01) is None
    held = StickSlipTracker(PRELIMINARY).update(1.0, 1.5)
    assert noise_risk(held, 0.0) is None
    assert not noise_risk(held, 0.01).is_unsafe
    # Half a newton short of slip, which is many deviations.
    assert noise_risk(held, 0.01).short_of_slip > 20.0
