"""`StickSlipFilter.consistency`: what a measured angle says of the model, and what it does not."""

import dataclasses
import functools
import math

import numpy as np
import pytest
from measure_consistency import moved
from measure_filter.readings import readings
from measure_filter.sessions import UNITS, session

from tendon_statics import DesignUncertainty, StickSlipFilter
from tendon_statics.physics.filter.consistency import Consistency
from tendon_statics.physics.filter.scores import Boundary

ALARM = 1e-9
ENCODER = math.radians(0.2)
NOISE, RATE = 0.01, 200.0
HANGING, _ = UNITS['hanging']


def measured(drawn, *, sign=1.0, seed=1):
    """What an encoder says of a session's angles."""
    noise = np.random.default_rng(seed).normal(0.0, ENCODER, len(drawn.time))
    stop = drawn.design.max_bend_angle
    return np.clip(sign * drawn.bend_angle + noise, -stop, stop)


def least_consistency(
    drawn, design=None, *, bias=0.0, sign=1.0, slips=10, angles=None, tolerance=None, unknown=0.0
):
    """Lowest consistency within so many slips of a session, for another design.

    Or the first that is an alarm. `unknown` is the deviation of the bias, `tolerance` that of the
    design.
    """
    angles = measured(drawn, sign=sign) if angles is None else angles
    tensions = np.array([drawn.tension_l, drawn.tension_s + bias])
    judge = Consistency(Boundary(design or drawn.design, unknown, tolerance))
    least, seen, last = 1.0, 0, None
    for reading in readings(drawn.time, tensions, angles, drawn.noise, ENCODER):
        if not judge.has_place and math.isnan(reading.bend_angle):
            continue
        judge.take(reading)
        if judge._slips and judge._slips[-1] is not last:
            last, seen = judge._slips[-1], seen + 1
        if seen > slips or least < ALARM:
            break
        if not math.isnan(judge.probability):
            least = min(least, judge.probability)
    return least


@functools.cache
def strokes(unit='hanging', seconds=14.0, seed=3, program='strokes', rate=RATE, noise=NOISE):
    return session(unit, program, noise, rate, seconds, np.random.default_rng(seed))


def with_friction(design, factor):
    return dataclasses.replace(design, friction_coefficient=factor * design.friction_coefficient)


def test_the_filter_says_what_its_judge_says():
    drawn = strokes(seconds=3.0)
    wrong = with_friction(drawn.design, 1.01)
    found = StickSlipFilter(wrong, tension_stddev=drawn.noise)
    angles = measured(drawn)
    for (time, *_, tension_l, tension_s), angle in zip(
        drawn.samples, angles.tolist(), strict=True
    ):
        state = found.update(tension_l, tension_s, time)
        found.measure(angle, ENCODER)
    tensions = np.array([drawn.tension_l, drawn.tension_s])
    judge = Consistency(Boundary(wrong, 0.0, None))
    for reading in readings(drawn.time, tensions, angles, drawn.noise, ENCODER):
        judge.take(reading)
    assert state.consistency == found.consistency == pytest.approx(judge.probability, rel=1e-6)
    assert found.consistency < 1.0


@pytest.mark.parametrize('unit', list(UNITS))
@pytest.mark.parametrize('program', ['strokes', 'staircases', 'ramps', 'cycles'])
def test_the_right_model_raises_no_alarm(unit, program):
    assert least_consistency(strokes(unit, 10.0, program=program), slips=99) > 1e-4


@pytest.mark.parametrize(
    ('unit', 'program', 'seed'),
    [
        ('backbone, friction circle', 'cycles', 13),
        ('backbone, elastic seat', 'cycles', 8),
        ('hanging', 'staircases', 7),
    ],
)
def test_neither_slides_that_fade_out_nor_fast_steps_raise_an_alarm(unit, program, seed):
    """Where the drive recedes before the unit is seen to have moved, or within five readings."""
    drawn = strokes(unit, 8.0, seed, program, rate=500.0, noise=0.005)
    assert least_consistency(drawn, slips=99) > 1e-5


@pytest.mark.parametrize('unit', list(UNITS))
@pytest.mark.parametrize('factor', [0.97, 1.03])
def test_a_wrong_coefficient_of_friction_is_found_within_ten_slips(unit, factor):
    drawn = strokes(unit, rate=500.0)
    assert least_consistency(drawn, with_friction(drawn.design, factor)) < ALARM


@pytest.mark.parametrize('seed', range(2, 5))
@pytest.mark.parametrize('shift', [0.0135, -0.0135])
def test_a_boundary_three_deviations_off_is_found_within_ten_slips_of_a_unit_that_jumps(
    shift, seed
):
    design, weak = UNITS['preliminary']
    wrong = moved(design, weak, shift, lambda factor: with_friction(design, factor))
    assert least_consistency(strokes('preliminary', 16.0, seed, rate=500.0), wrong) < ALARM


def test_cycles_that_slip_alike_next_to_their_crest_raise_no_alarm():
    drawn = strokes('preliminary', 14.0, 0, 'cycles', rate=500.0)
    assert least_consistency(drawn, slips=99) > 1e-4


@pytest.mark.parametrize('factor', [0.97, 1.03])
def test_a_wrong_coefficient_of_friction_is_found_at_low_rates_where_the_unit_slides(factor):
    assert least_consistency(strokes(), with_friction(HANGING, factor)) < ALARM


@pytest.mark.parametrize('bias', [0.03, -0.03])
@pytest.mark.parametrize('unit', list(UNITS))
def test_a_biased_load_cell_is_found_within_ten_slips(unit, bias):
    assert least_consistency(strokes(unit), bias=bias) < ALARM


@pytest.mark.parametrize('shift', [-2e-4, 2e-4])
def test_a_cable_that_has_slipped_off_its_guide_is_found_within_ten_slips(shift):
    wrong = dataclasses.replace(HANGING, cable_offset=HANGING.cable_offset + shift)
    assert least_consistency(strokes(), wrong) < ALARM


def test_a_swapped_sign_is_found_within_three_slips():
    assert least_consistency(strokes(), sign=-1.0, slips=3) < ALARM


def test_a_single_slip_refutes_nothing():
    """Somebody may have touched the unit."""
    random = np.random.default_rng(5)

    def consistency(pushes):
        found = StickSlipFilter(HANGING, tension_stddev=NOISE)
        for index in range(100 * (pushes + 1)):
            found.update(*(np.array([3.0, 4.0]) + random.normal(0.0, NOISE, 2)), index / RATE)
            found.measure(0.1 * (index // 100 % 2) + random.normal(0.0, ENCODER), ENCODER)
        return found.consistency

    assert ALARM < consistency(1) < 1e-3
    assert consistency(4) < ALARM


def test_a_camera_that_misses_the_peaks_of_the_drive_raises_no_alarm():
    drawn = strokes('hanging', 20.0, 5, 'staircases', rate=500.0)
    angles = measured(drawn)
    angles[np.arange(len(angles)) % 25 != 0] = math.nan
    assert least_consistency(drawn, angles=angles, slips=99) > 1e-4
    angles = measured(drawn, sign=-1.0)
    angles[np.arange(len(angles)) % 25 != 0] = math.nan
    assert least_consistency(drawn, angles=angles) < ALARM


@pytest.mark.parametrize('unit', ['backbone, friction circle', 'backbone, elastic seat'])
def test_a_camera_too_slow_to_see_a_slide_end_raises_no_alarm(unit):
    """Five of its readings span the end of the slide; their mean is no place of rest."""
    drawn = strokes(unit, 16.0, 6, 'cycles', noise=0.005)
    angles = measured(drawn)
    angles[np.arange(len(angles)) % 20 != 0] = math.nan
    assert least_consistency(drawn, angles=angles, slips=99) > 1e-4


@pytest.mark.parametrize('cables', ['slack', 'lost'])
def test_what_moves_a_unit_unseen_raises_no_alarm(cables):
    """While a cable is slack, or no tensions come, a hand may have moved it."""
    found = StickSlipFilter(HANGING, tension_stddev=NOISE)
    random = np.random.default_rng(5)
    index = 0
    for stroke in range(6):
        for _ in range(80):
            angle = math.radians(10.0) * (-1.0) ** stroke + random.normal(0.0, ENCODER)
            found.update(*(np.array([3.0, 3.1]) + random.normal(0.0, NOISE, 2)), index / RATE)
            found.measure(angle, ENCODER)
            index += 1
        if cables == 'slack':
            found.update(3.0, 0.0, index / RATE)
            index += 1
        else:
            index += 100
    assert found.consistency > 0.1


def test_what_bias_and_design_may_be_is_no_alarm():
    """They move all slips alike, so that many slips do not make them less likely."""
    friction = 0.4 * 0.02
    wrong = dataclasses.replace(HANGING, friction_coefficient=0.4 + 1.5 * friction)
    known = DesignUncertainty(('friction_coefficient',), ((friction**2,),))
    drawn = strokes(rate=500.0)
    assert least_consistency(drawn, wrong) < ALARM
    assert least_consistency(drawn, wrong, tolerance=known) > 1e-4
    assert least_consistency(strokes(), bias=0.03, unknown=0.02) > 1e-4


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
