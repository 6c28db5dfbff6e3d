"""`StickSlipFilter.consistency`: what a measured angle says of the model, and what it does not."""

import dataclasses
import functools
import math

import numpy as np
import pytest
from measure_filter.sessions import UNITS, session

from tendon_statics import DesignUncertainty, StickSlipFilter

ALARM = 1e-9
ENCODER = math.radians(0.2)
NOISE, RATE = 0.01, 200.0
HANGING, _ = UNITS['hanging']


def least_consistency(drawn, design=None, *, bias=0.0, sign=1.0, seed=1, slips=10, **more):
    """Lowest consistency within so many slips of a session, of a filter with another design.

    Or the first that is an alarm.
    """
    design = design or drawn.design
    found = StickSlipFilter(design, tension_stddev=drawn.noise, **more)
    random = np.random.default_rng(seed)
    least, stop = 1.0, design.max_bend_angle
    for time, angle, _, tension_l, tension_s in drawn.samples:
        state = found.update(tension_l, tension_s + bias, time)
        reading = sign * angle + random.normal(0.0, ENCODER)
        found.measure(np.clip(reading, -stop, stop), ENCODER)
        if not math.isnan(found.consistency):
            least = min(least, found.consistency)
        if least < ALARM or len(found._consistency._slips) == slips:
            break
    assert state.consistency == pytest.approx(found.consistency, nan_ok=True) or least < ALARM
    return least


@functools.cache
def strokes(unit='hanging', seconds=14.0, seed=3, program='strokes', rate=RATE):
    return session(unit, program, NOISE, rate, seconds, np.random.default_rng(seed))


@pytest.mark.parametrize('unit', list(UNITS))
@pytest.mark.parametrize('program', ['strokes', 'staircases'])
def test_the_right_model_raises_no_alarm(unit, program):
    assert least_consistency(strokes(unit, 6.0, program=program)) > 1e-4


def test_a_wrong_coefficient_of_friction_is_found_within_ten_slips():
    for factor in (0.97, 1.03):
        wrong = dataclasses.replace(
            HANGING, friction_coefficient=factor * HANGING.friction_coefficient
        )
        assert least_consistency(strokes(rate=500.0), wrong) < ALARM


@pytest.mark.parametrize('bias', [0.03, -0.03])
@pytest.mark.parametrize('unit', list(UNITS))
def test_a_biased_load_cell_is_found_within_ten_slips(unit, bias):
    assert least_consistency(strokes(unit), bias=bias) < ALARM


def test_a_cable_that_has_slipped_off_its_guide_is_found_within_ten_slips():
    wrong = dataclasses.replace(HANGING, cable_offset=HANGING.cable_offset - 2e-4)
    assert least_consistency(strokes(), wrong) < ALARM


def test_a_swapped_sign_is_found_at_the_first_slip():
    assert least_consistency(strokes(), sign=-1.0, slips=1) < ALARM


def test_what_bias_and_design_may_be_is_no_alarm():
    """They move all slips alike, so that many slips do not make them less likely."""
    friction = 0.4 * 0.02
    wrong = dataclasses.replace(HANGING, friction_coefficient=0.4 + 1.5 * friction)
    known = DesignUncertainty(('friction_coefficient',), ((friction**2,),))
    drawn = strokes(rate=500.0)
    assert least_consistency(drawn, wrong) < ALARM
    assert least_consistency(drawn, wrong, design_covariance=known) > 1e-4
    assert least_consistency(strokes(), bias=0.03, tension_bias_stddev=0.02) > 1e-4


def test_a_held_unit_says_nothing():
    """A wrong model explains an angle at rest as well as the right one."""
    found = StickSlipFilter(HANGING, tension_stddev=NOISE)
    random = np.random.default_rng(5)
    assert math.isnan(found.consistency)
    for index in range(300):
        tension_l, tension_s = np.array([3.0, 4.0]) + random.normal(0.0, NOISE, 2)
        found.update(tension_l, tension_s, index / RATE)
        found.measure(0.1 + random.normal(0.0, ENCODER), ENCODER)
    assert found.consistency > 0.1
