"""`FaultMaker`: what each fault does to a reading, how often, and the same for the same seed."""

import dataclasses
import itertools
import math
from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tendon_statics.driver.faults import LAG, FaultMaker
from tendon_statics.files.fault_settings import (
    IMPLAUSIBLE_TENSION,
    STAMP_FAULTS,
    Fault,
    FaultSettings,
    fault_parameters,
)
from tendon_statics.files.parameter_kinds import SettingError

TENSIONS = (1.0, 2.0)
PERIOD = 2_000_000
"""ns"""

EPISODES = (Fault.NAN_BURST, Fault.SLACK)
FAULTS = tuple(fault for fault in Fault if fault is not Fault.NONE)


def readings(settings: FaultSettings, count: int, start: int = 10**18, period: int = PERIOD):
    maker = FaultMaker(settings)
    return [maker.reading(TENSIONS, start + index * period) for index in range(count)]


def only(fault: Fault, probability: float, **more) -> FaultSettings:
    return FaultSettings(**{f'{fault.value}_probability': probability}, **more)


some_faults = st.builds(
    FaultSettings,
    seed=st.integers(0, 2**31 - 1),
    nan_burst_length=st.integers(1, 5),
    slack_length=st.integers(1, 5),
    **{f'{fault.value}_probability': st.floats(0.0, 0.14) for fault in FAULTS},
)


def test_without_faults_every_reading_is_the_true_one():
    for index, reading in enumerate(readings(FaultSettings(), 100, start=5)):
        assert reading.tensions == TENSIONS
        assert reading.stamp == 5 + index * PERIOD
        assert reading.fault is Fault.NONE


@given(some_faults)
def test_every_reading_is_as_its_fault_says(settings):
    newest_sound = None
    for index, reading in enumerate(readings(settings, 200, start=0)):
        sound = reading.fault in (Fault.NONE, Fault.SLACK)
        other = 1 - reading.cable
        assert reading.tensions[other] == TENSIONS[other]
        value = reading.tensions[reading.cable]
        if reading.fault is Fault.NAN_BURST:
            assert math.isnan(value)
        elif reading.fault is Fault.SLACK:
            assert value == 0.0
        elif reading.fault is Fault.IMPLAUSIBLE:
            assert value == IMPLAUSIBLE_TENSION
        else:
            assert value == TENSIONS[reading.cable]
        if reading.fault is Fault.OUT_OF_ORDER:
            assert reading.stamp == newest_sound - LAG
        elif reading.fault is Fault.REPEATED_STAMP:
            assert reading.stamp == newest_sound
        else:
            assert reading.stamp == index * PERIOD
        if sound:
            newest_sound = reading.stamp


@given(some_faults)
def test_the_same_seed_makes_the_same_faults_at_any_pace_and_noise(settings):
    faults = [(reading.fault, reading.cable) for reading in readings(settings, 200)]
    again = readings(settings, 200, start=0, period=0)
    assert [(reading.fault, reading.cable) for reading in again] == faults
    noisy = dataclasses.replace(settings, noise_stddev=0.1)
    assert [(reading.fault, reading.cable) for reading in readings(noisy, 200)] == faults
    assert str(readings(noisy, 200)) == str(readings(noisy, 200))  # NaN is not equal to itself


def test_another_seed_makes_other_faults_and_other_noise():
    settings = only(Fault.DROPOUT, 0.5, noise_stddev=0.1)
    other = dataclasses.replace(settings, seed=1)
    ours, others = readings(settings, 200), readings(other, 200)
    assert [r.fault for r in ours] != [r.fault for r in others]
    assert not {r.tensions for r in ours} & {r.tensions for r in others}


@pytest.mark.parametrize('fault', [fault for fault in FAULTS if fault not in EPISODES])
def test_a_fault_comes_as_often_as_its_probability_says(fault):
    """Within five standard deviations of the binomial distribution."""
    count, probability = 20_000, 0.1
    found = Counter(reading.fault for reading in readings(only(fault, probability), count))
    expected = count * probability
    assert abs(found[fault] - expected) < 5.0 * math.sqrt(expected * (1.0 - probability))
    assert found[fault] + found[Fault.NONE] == count


@pytest.mark.parametrize('fault', EPISODES)
def test_an_episode_has_its_length_and_one_cable(fault):
    settings = only(fault, 0.02, **{f'{fault.value}_length': 7})
    episodes = [
        list(group)
        for is_in, group in itertools.groupby(
            readings(settings, 5000), key=lambda reading: reading.fault is fault
        )
        if is_in
    ]
    assert len(episodes) > 50
    # The last may be cut off, and two may follow each other without a gap.
    assert {len(episode) % 7 for episode in episodes[:-1]} == {0}
    assert {len({r.cable for r in episode}) for episode in episodes if len(episode) == 7} == {1}
    assert {episode[0].cable for episode in episodes} == {0, 1}


def test_noise_has_its_standard_deviation_on_each_cable_by_itself():
    """Moments of 20,000 values within five of their standard deviations."""
    count, stddev = 20_000, 0.25
    rows = readings(FaultSettings(noise_stddev=stddev), count)
    noise = [[row.tensions[cable] - TENSIONS[cable] for row in rows] for cable in (0, 1)]
    for values in noise:
        assert abs(sum(values)) / count < 5.0 * stddev / math.sqrt(count)
        variance = sum(value * value for value in values) / count
        assert variance == pytest.approx(stddev**2, rel=5.0 * math.sqrt(2.0 / count))
    covariance = sum(a * b for a, b in zip(*noise, strict=True)) / count
    assert abs(covariance) < 5.0 * stddev**2 / math.sqrt(count)


def test_a_spoilt_value_has_no_noise():
    for reading in readings(only(Fault.SLACK, 1.0, noise_stddev=0.1), 100):
        assert reading.tensions[reading.cable] == 0.0


@pytest.mark.parametrize('fault', STAMP_FAULTS)
def test_no_stamp_is_wrong_before_there_was_a_right_one(fault):
    first, second, *_ = readings(only(fault, 1.0), 3)
    assert first.fault is Fault.NONE
    assert second.fault is fault


def test_stamps_grow_while_a_simulated_clock_stands_still_and_follow_it_back():
    maker = FaultMaker(FaultSettings())
    times = [100, 100, 100, 200, 50, 50]
    stamps = [maker.reading(TENSIONS, time).stamp for time in times]
    assert stamps == [100, 101, 102, 200, 50, 51]


@pytest.mark.parametrize('parameter', fault_parameters(), ids=lambda parameter: parameter.name)
def test_a_setting_out_of_range_or_not_a_number_is_refused_by_name(parameter):
    bad = [math.nan, math.inf, parameter.minimum - 1, parameter.maximum + 1, 'much', True, None]
    for value in bad:
        with pytest.raises(SettingError, match=f'{parameter.name} is .*allowed is') as raised:
            FaultSettings(**{parameter.name: value})
        assert repr(value) in str(raised.value)
    for value in (parameter.minimum, parameter.maximum, parameter.default):
        FaultSettings(**{parameter.name: value})


def test_more_than_one_fault_per_message_is_refused():
    FaultSettings(dropout_probability=0.5, slack_probability=0.5)
    with pytest.raises(SettingError, match=r'1\.1 together, allowed is at most 1'):
        FaultSettings(dropout_probability=0.5, slack_probability=0.6)
