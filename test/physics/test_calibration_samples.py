"""What each sample is used for: rests, holds, repeated rows."""

import math

import numpy as np
import pytest
from designs import PRELIMINARY

from tendon_statics import Recording
from tendon_statics.physics.calibration.boundary_distance import Noise
from tendon_statics.physics.calibration.samples import SortedSamples

NOISE = Noise(0.01, 0.01, 8.0)
STOP = PRELIMINARY.max_bend_angle


def sorted_samples(bend_angle, state, tension_s=None):
    count = len(bend_angle)
    tension_s = np.linspace(1.1, 1.2, count) if tension_s is None else tension_s
    data = Recording([1.0] * count, tension_s, bend_angle, state=state)
    return SortedSamples(PRELIMINARY, data, NOISE)


def test_a_rest_at_the_stop_is_left_out_as_a_whole():
    """Noise puts single samples of it far from the stop, and beyond."""
    angles = [0.1, STOP, STOP - 0.05, STOP + 0.05, STOP, STOP - 0.01]
    found = sorted_samples(angles, ['slipping', 'held', 'held', 'held', 'held', 'slipping'])
    assert found.roles.tolist() == ['slipping'] + ['at the stop'] * 5


def test_a_rest_away_from_the_stop_is_used_as_a_whole():
    angles = [STOP - 0.05] * 4 + [STOP - 0.02] + [STOP - 0.05] * 2
    found = sorted_samples(angles, ['held'] * 6 + ['slipping'])
    assert found.roles.tolist() == ['held'] * 6 + ['slipping']


@pytest.mark.parametrize(
    ('angles', 'state', 'holds'),
    [
        ([0.1, 0.1, 0.12, 0.1], 'hhhs', 1),
        ([0.1, 0.1, 0.3, 0.3], 'hhhs', 2),  # it moved in between
        ([0.1, math.nan, 0.3, 0.3], 'hhhs', 2),  # likewise, unseen
        ([0.1, 0.1, 0.1, 0.1], 'hmhs', 2),
        ([0.1, 0.1, 0.1, 0.1], 'hshs', 2),
        ([0.1, 0.1, 0.1, 0.1], 'ssss', 0),
    ],
)
def test_holds_are_held_samples_in_a_row_at_one_angle(angles, state, holds):
    names = {'h': 'held', 's': 'slipping', 'm': 'moving'}
    found = sorted_samples(angles, [names[letter] for letter in state])
    assert found.counts['holds'] == holds


def test_of_a_hold_the_farthest_sample_counts_beyond_what_noise_explains():
    found = sorted_samples([0.1] * 100 + [0.3, 0.3], ['held'] * 100 + ['held', 'slipping'])
    distances = np.zeros(101)
    distances[17], distances[100] = 5.0, 5.0
    of_many, of_one = found.hold_excesses(distances, 1.0)
    assert of_one == pytest.approx(2.0, abs=0.001)  # beyond three standard deviations
    assert 0.5 < of_many < of_one
    rng = np.random.default_rng(1)
    for _ in range(100):
        assert (found.hold_excesses(2.0 * rng.normal(size=101), 2.0) == 0.0).mean() >= 0.5
    assert (found.hold_excesses(distances, 2.0) == 0.0).all()


def test_a_row_that_was_copied_counts_once():
    tensions = np.array([2.0, 2.1, 2.0, 2.0, 2.2])
    found = sorted_samples([0.1, 0.1, 0.1, 0.2, 0.1], ['slipping'] * 5, tensions)
    assert found.roles.tolist() == ['slipping', 'slipping', 'repeated', 'slipping', 'slipping']
