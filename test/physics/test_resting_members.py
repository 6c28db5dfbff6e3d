"""`hold_all`: members that it says rest need not be followed, so that it must never be wrong."""

import math

import numpy as np
import pytest
from measure_filter.sessions import UNITS

from tendon_statics import Load, slip_margin
from tendon_statics.physics.filter.resting import hold_all
from tendon_statics.physics.loaded_joint import loaded_joint


@pytest.mark.parametrize('load', [Load(), Load.tilted(0.4, (0.1, -0.2), 0.05)])
@pytest.mark.parametrize('unit', list(UNITS))
def test_a_unit_that_is_said_to_rest_is_slipped_by_no_pair_between_the_extremes(unit, load):
    design, weak = UNITS[unit]
    stop = design.max_bend_angle
    random = np.random.default_rng(8)
    said = []
    for _ in range(200):
        angle = float(random.choice([0.0, stop, -stop, random.uniform(-stop, stop)]))
        least = weak * random.uniform(0.5, 3.0, 2)
        most = least * random.uniform(1.0, 1.2, 2)
        corners = np.array(np.meshgrid(*zip(least, most, strict=True))).reshape(2, -1)
        within = random.uniform(least, most, (8, 2)).T
        pairs = np.concatenate([corners, within], axis=1)
        margins = [slip_margin(design, *pair, angle, load) for pair in pairs.T.tolist()]
        slips = [abs(m) > 1.0 and not math.copysign(1.0, m) * angle >= stop for m in margins]
        said.append(hold_all(loaded_joint(design, load), pairs, angle, stop))
        assert not (said[-1] and any(slips)), (angle, pairs)
    assert 10 < sum(said) < 190


def test_where_a_cable_may_be_slack_nothing_is_said():
    design, weak = UNITS['hanging']
    joint = loaded_joint(design, Load())
    assert hold_all(joint, np.full((2, 3), weak), 0.0, design.max_bend_angle)
    tensions = np.array([[weak, weak, 0.0], [weak, weak, weak]])
    assert not hold_all(joint, tensions, 0.0, design.max_bend_angle)
