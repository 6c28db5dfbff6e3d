"""The last minute, and the map, without a browser."""

import math

import numpy as np
import pytest
from list_entities import alone
from tendon_statics_interfaces.msg import Estimate

from tendon_statics import Load, default_design_path, load_design, solve
from tendon_statics.physics import TensionError
from tendon_statics.physics.batch import INVALID, REGIME_CODES
from tendon_statics.view.estimators_in_sight import Sighting
from tendon_statics.view.history import LONGEST_BAND, SPAN, TIMES, History
from tendon_statics.view.kinds import UNIT
from tendon_statics.view.regime_map import (
    POINTS,
    gives_same_map,
    map_end,
    regimes_over_tensions,
)
from tendon_statics.view.unit_sample import UNIT_NAMES, unit_sample
from tendon_statics.view.view import View

DESIGN = load_design(default_design_path())


def test_a_page_is_given_what_it_has_not_drawn_yet():
    history = History(20.0, ['angle'])
    for number in range(5):
        history.add(0.05 * number, {'angle': float(number)})
    assert list(history.since(0)['angle']) == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert list(history.since(3)['angle']) == [3.0, 4.0]
    columns = history.since(history.count)
    assert set(columns) == {*TIMES, 'angle'}
    assert all(len(column) == 0 for column in columns.values())


def test_no_more_than_a_minute_is_kept():
    history = History(20.0, ['angle'])
    for number in range(3000):
        history.add(0.05 * number, {'angle': float(number)})
    kept = history.since(0)
    assert len(kept['time']) == history.length == SPAN * 20.0
    assert kept['angle'][-1] == 2999.0
    assert list(history.since(2998)['angle']) == [2998.0, 2999.0]


def test_a_band_reaches_from_the_sample_before_but_not_over_a_gap():
    history = History(20.0, ['angle'])
    for time in (10.0, 10.05, 15.0):
        history.add(time, {})
    columns = history.since(0)
    assert list(columns['before']) == pytest.approx([1e4 - 1e3 * LONGEST_BAND, 1e4, 1.4e4])


def test_before_the_first_estimate_there_is_nothing_to_draw():
    with alone(View) as view:
        watch = view.watches.look(Sighting('/estimator', '/estimator/estimate', UNIT))
        watch.poll()
        assert watch.history.count == 0


def test_what_a_sample_does_not_have_is_not_drawn():
    history = History(20.0, ['angle', 'pressure'])
    history.add(1.0, {'pressure': 2.0})
    columns = history.since(0)
    assert list(columns['pressure']) == [2.0]
    assert math.isnan(columns['angle'][0])


def test_intervals_are_drawn_as_far_as_there_is_room():
    history = History(1.0, UNIT_NAMES)
    for number, ends in enumerate([[], [-0.1, 0.2], [-0.3, -0.2, 0.1, 0.2, 0.5, 0.6]]):
        history.add(number, unit_sample(Estimate(admissible_angles=ends)))
    columns = {name: np.radians(column) for name, column in history.since(0).items()}
    assert list(columns['admissible_low_0'])[1:] == pytest.approx([-0.1, -0.3])
    assert list(columns['admissible_high_1'])[2:] == pytest.approx([0.2])
    assert math.isnan(columns['admissible_low_0'][0])
    assert math.isnan(columns['admissible_low_1'][1])


@pytest.mark.parametrize(
    'load', [Load(), Load.tilted(0.3), Load(tip_force=(0.02, 0.05), tip_distance=0.02)]
)
def test_the_map_says_what_the_solver_says(load):
    end = 3.0
    codes = regimes_over_tensions(DESIGN, load, end)
    assert codes.shape == (POINTS, POINTS)
    for row in range(0, POINTS, 9):
        for column in range(0, POINTS, 9):
            pair = [(place + 0.5) * end / POINTS for place in (column, row)]
            try:
                expected = REGIME_CODES[solve(DESIGN, *pair, load).regime]
            except TensionError:
                expected = INVALID
            assert codes[row, column] == expected


@pytest.mark.parametrize('largest', [0.0, 1e-4, 0.03, 0.8, 1.0, 3.9, 4.0, 4.1, 99.0, 1000.0])
def test_a_map_has_room_for_the_largest_tension(largest):
    end = map_end(largest)
    assert end >= 1.25 * largest
    assert end <= 4.0 * max(largest, 1e-3)
    assert map_end(0.999 * largest) <= end


def test_a_map_is_made_anew_for_another_load_and_not_for_noise():
    load = Load.tilted(0.2)
    assert gives_same_map(DESIGN, load, load)
    assert gives_same_map(DESIGN, load, Load.tilted(0.2 + math.radians(0.3)))
    assert not gives_same_map(DESIGN, load, Load.tilted(0.2 + math.radians(1.0)))
    assert not gives_same_map(DESIGN, Load(), Load(tip_force=(0.05, 0.0), tip_distance=0.02))
