"""`Windows`: rests and ramps are averaged, and corners are not cut."""

import numpy as np
import pytest

from tendon_statics.physics.filter.local_fits import REACH
from tendon_statics.physics.filter.smoothing import Windows

NOISE = 0.01


def estimate(signal, age, seed=0):
    """Estimates at one age along a noisy signal, and their standard errors, by window."""
    random = np.random.default_rng(seed)
    samples = signal + random.normal(0.0, NOISE, len(signal))
    count = REACH + age
    # Each a signal of its own, that begins one sample later.
    seen = np.lib.stride_tricks.sliding_window_view(samples, count)[1:]
    found = Windows(count, np.array([age]), len(seen)).estimate(seen, NOISE)
    return signal[REACH : len(signal) - age], found.value[:, 0], found.error[:, 0]


def test_the_noise_of_a_rest_shrinks_by_the_root_of_the_samples():
    truth, value, error = estimate(np.full(1500, 2.0), 75)
    assert np.std(value - truth) < 0.2 * NOISE
    assert np.median(error) == pytest.approx(NOISE / np.sqrt(65), rel=0.1)


@pytest.mark.parametrize('age', [0, 10, 75])
def test_a_ramp_is_followed_without_lag(age):
    truth, value, _ = estimate(np.linspace(0.0, 3.0, 1500), age)
    assert abs(np.mean(value - truth)) < 0.3 * NOISE
    assert np.sqrt(np.mean((value - truth) ** 2)) < 0.9 * NOISE


def test_a_rest_right_after_a_step_is_as_sure_as_in_its_midst():
    """What keeps a fast step from being seen as higher than it is."""
    signal = np.concatenate([np.zeros(300), np.linspace(0.0, 1.0, 11)[1:], np.ones(400)])
    truth, value, error = estimate(signal, 75)
    at_rest = np.flatnonzero(truth == 1.0)
    beginning = at_rest[:20]
    assert np.median(error[beginning]) < 0.25 * NOISE
    assert (value[at_rest] - 1.0).max() < NOISE


def test_errors_are_of_the_size_that_they_say():
    truth, value, error = estimate(np.full(3000, 1.0), 40, seed=3)
    assert np.std((value - truth) / error) == pytest.approx(1.0, abs=0.35)


def test_the_first_sample_is_its_own_estimate():
    found = Windows(1, np.array([0]), 2).estimate(np.array([[2.5], [1.5]]), NOISE)
    assert found.value[:, 0].tolist() == [2.5, 1.5]
    assert found.error[:, 0].tolist() == [NOISE, NOISE]


@pytest.mark.parametrize('slope', [0.3, 1.0, 3.0])
def test_the_end_of_a_ramp_is_not_seen_beyond_where_it_ends(slope):
    """What would carry a unit along that a ramp pushes: the highest of many estimates counts."""
    age, beyond = 30, []
    ramp = NOISE * slope * np.arange(-200.0, 1.0)
    for seed in range(12):
        signal = np.concatenate([ramp, np.zeros(120)])
        _, value, error = estimate(signal, age, seed)
        beyond.append((value - 2.8 * error).max())
    assert np.mean(np.array(beyond) > 0.0) < 0.3


def test_a_parabola_is_itself():
    time = np.arange(300.0)
    signal = 1.0 + 0.3 * time - 0.002 * time**2
    for age in (75, 10):
        found = Windows(300, np.array([age]), 1).estimate(signal[None], 1e-9)
        assert found.value[0, 0] == pytest.approx(signal[299 - age], abs=1e-9)


def test_crests_are_not_seen_higher_than_they_are():
    """Where the mean of a window after a place that rises and falls by as much misleads."""
    time = np.arange(0.0, 60.0, 0.002)
    height = 113.0 * NOISE
    truth, value, error = estimate(height * np.sin(2.0 * np.pi * time / 2.34), 75)
    near = (truth > 0.9 * height) & (truth < 0.99 * height)
    assert np.mean(np.abs(value - truth)[near] > 2.0 * error[near]) < 0.05
