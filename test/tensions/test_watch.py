"""What of load cells is believed, and which cable is slack, reading by reading."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tendon_statics.tensions.cable_scale import RELEASE, CableScale
from tendon_statics.tensions.reason import ReadingError, Reason
from tendon_statics.tensions.watch import Plausibility, SlackSwitch, TensionWatch

SCALES = (CableScale(slack_threshold=0.03),) * 2


UNCHECKED = Plausibility()


def outcomes(tensions, believed=UNCHECKED, step=0.1):
    """What becomes of the tensions of cable l, one after the other: a tension or a reason."""
    watch, found = TensionWatch(), []
    for place, tension in enumerate(tensions):
        try:
            found.append(
                watch.take((tension, 1.0 + 0.01 * place), step * place, SCALES, believed)[0]
            )
        except ReadingError as error:
            found.append(error.reason)
    return found


def test_a_cable_is_slack_from_its_threshold_until_well_above_it():
    rows = [1.0, 0.04, 0.03, 0.04, 0.045, 0.046, 0.031, 0.029, -0.02, 0.0, 0.5]
    expected = [1.0, 0.04, 0.0, 0.0, 0.0, 0.046, 0.031, 0.0, 0.0, 0.0, 0.5]
    assert outcomes(rows) == expected


def test_without_noise_a_cable_is_slack_at_0_alone():
    switch = SlackSwitch()
    assert [switch.take(tension, 0.0) for tension in (1e-9, 0.0, 1e-9)] == [False, True, False]


@given(st.lists(st.floats(-0.1, 0.2), max_size=50))
def test_within_the_noise_a_cable_does_not_flicker(tensions):
    """Between two changes a tension has crossed the whole of the band."""
    switch, changes, was = SlackSwitch(), [], False
    for tension in tensions:
        now = switch.take(tension, 0.03)
        if now != was:
            changes.append(tension)
        was = now
    for place, tension in enumerate(changes):
        assert tension <= 0.03 if place % 2 == 0 else tension > RELEASE * 0.03


def test_a_spike_is_too_fast_and_what_comes_after_it_is_not():
    believed = Plausibility(max_rate=10.0)
    assert outcomes([1.0, 1.5, 4.194, 1.5, 1.5], believed) == [1.0, 1.5, Reason.TOO_FAST, 1.5, 1.5]


def test_a_true_step_is_believed_once_there_was_time_for_it():
    found = outcomes([1.0] * 2 + [4.0] * 5, Plausibility(max_rate=10.0))
    assert found == [1.0, 1.0, Reason.TOO_FAST, Reason.TOO_FAST, 4.0, 4.0, 4.0]


def test_a_rate_is_not_checked_where_no_time_is_known():
    assert outcomes([1.0, 99.0], Plausibility(max_rate=1.0), step=math.nan) == [1.0, 99.0]


def test_a_cell_at_the_end_of_its_range_is_saturated_until_it_comes_back():
    believed = Plausibility(saturation_count=3)
    found = outcomes([1.0, 5.0, 5.0, 5.0, 5.0, 4.9, 4.9, 4.9, 5.0], believed)
    assert found == [1.0, 5.0, 5.0, Reason.SATURATED, Reason.SATURATED, 4.9, 4.9, 4.9, 5.0]


def test_a_spike_that_was_too_fast_is_not_the_end_of_a_range():
    believed = Plausibility(max_rate=20.0, saturation_count=2)
    found = outcomes([1.0, 9.0, 1.1, 2.0, 2.0], believed)
    assert found == [1.0, Reason.TOO_FAST, 1.1, 2.0, Reason.SATURATED]


def test_a_cell_that_hangs_is_frozen_unless_its_cable_is_slack():
    believed = Plausibility(frozen_count=3)
    assert outcomes([1.0, 0.9, 0.9, 0.9, 0.9, 0.91], believed) == [
        *(1.0, 0.9, 0.9, Reason.FROZEN, Reason.FROZEN, 0.91),
    ]
    assert outcomes([0.001] * 5, believed) == [0.0] * 5


@pytest.mark.parametrize('cable', [0, 1])
def test_the_cable_at_fault_is_named(cable):
    watch, believed = TensionWatch(), Plausibility(max_rate=1.0)
    watch.take((1.0, 1.0), 0.0, SCALES, believed)
    pair = (9.0, 1.0) if cable == 0 else (1.0, 9.0)
    name = 'tension_s' if cable else 'tension_l'
    with pytest.raises(ReadingError, match=rf'{name} went from 1 N to 9 N in 0.1 s, believed are'):
        watch.take(pair, 0.1, SCALES, believed)


def test_a_spike_at_the_beginning_is_not_confirmed_and_gives_way_to_what_is():
    believed, watch = Plausibility(max_rate=10.0), TensionWatch()
    assert watch.take((4.2, 1.0), 0.0, SCALES, believed) == (4.2, 1.0)
    assert not watch.is_confirmed
    with pytest.raises(ReadingError, match=r'went from 4\.2 N to 1\.5 N'):
        watch.take((1.5, 1.0), 0.1, SCALES, believed)
    for time in (0.2, 0.3):
        assert watch.take((1.5, 1.0), time, SCALES, believed) == (1.5, 1.0)
        assert watch.is_confirmed


def test_after_a_pause_in_which_a_tension_may_become_anything_it_has_to_be_confirmed():
    believed, watch = Plausibility(max_rate=10.0), TensionWatch()
    scales = (CableScale(max_tension=5.0),) * 2
    confirmed = []
    for time in (0.0, 0.1, 0.7, 0.8):
        watch.take((1.0, 1.0), time, scales, believed)
        confirmed.append(watch.is_confirmed)
    assert confirmed == [False, True, False, True]


@pytest.mark.parametrize('down', [[3.0, 2.0], [3.4, 2.9, 2.4, 2.0], [4.1, 4.0, 3.0, 2.5]])
def test_the_way_down_of_a_spike_is_not_believed_until_it_has_come_back(down):
    """Readings that a driver might have reached in the time since the last that was believed."""
    found = outcomes([1.5, 1.5, 4.0, *down, 1.5, 1.5], Plausibility(max_rate=4.0))
    assert set(found[2:-2]) == {Reason.TOO_FAST}
    assert found[-2:] == [1.5, 1.5]


@pytest.mark.parametrize('seed', range(5))
def test_of_a_driver_that_keeps_to_the_rate_all_is_believed(seed):
    rng = np.random.default_rng(seed)
    tensions = 5.0 + np.cumsum(rng.uniform(-1.0, 1.0, 500)).clip(-4.0, 4.0)
    tensions = np.r_[tensions[0], tensions[0] + np.cumsum(np.diff(tensions).clip(-1.0, 1.0))]
    believed = Plausibility(max_rate=10.0 * (1.0 + 1e-9))
    assert outcomes(tensions.tolist(), believed) == tensions.tolist()


def test_a_fast_ramp_is_believed_again_after_one_reading_that_was_too_fast():
    ramp = [1.0, 1.0, 1.8, 2.9, 3.5, 4.4, 5.2]
    found = outcomes(ramp, Plausibility(max_rate=10.0))
    assert found == [1.0, 1.0, 1.8, Reason.TOO_FAST, 3.5, 4.4, 5.2]


def test_a_cell_that_dithers_at_an_end_of_its_range_is_saturated_at_either():
    step = 0.01
    believed = Plausibility(saturation_count=6)
    move = [1.0 + step * place for place in range(300)]
    dither = [step * part for part in (0, 1, 0, -1, 1, 0, -1, 0, 1)]
    at_top = [*move, *(4.0 + part for part in dither)]
    at_bottom = [*reversed(move), *(0.9 + part for part in dither)]
    for tensions in (at_top, at_bottom):
        found = outcomes(tensions, believed)
        assert found[: len(move)] == tensions[: len(move)]
        assert found[-3:] == [Reason.SATURATED] * 3
    # In the middle of what was seen it is at rest.
    assert outcomes([*move, *move[:100], *(2.0 + part for part in dither)], believed)[-1] == 2.01


def test_rounded_readings_of_a_cell_that_dithers_are_saturated_too():
    step = 0.00061035
    move = [round(1.0 + step * place, 4) for place in range(2000)]
    dither = [round(move[-1] + step * part, 4) for part in (0, 1, 0, -1, 1, 0, -1, 0, 1)]
    found = outcomes([*move, *dither], Plausibility(saturation_count=5))
    assert found[: len(move)] == move
    assert found[-4:] == [Reason.SATURATED] * 4


def test_a_cell_that_hangs_at_the_lower_end_of_its_range_is_saturated():
    found = outcomes([1.0, 3.0, 0.5, 0.5, 0.5, 0.6], Plausibility(saturation_count=3))
    assert found == [1.0, 3.0, 0.5, 0.5, Reason.SATURATED, 0.6]


def test_noise_at_a_tension_that_is_held_is_no_end_of_a_range():
    rng = np.random.default_rng(1)
    tensions = np.r_[np.linspace(1.0, 3.0, 200), np.full(300, 3.0)] + rng.normal(0.0, 0.01, 500)
    believed = Plausibility(saturation_count=10)
    assert Reason.SATURATED not in outcomes(tensions.tolist(), believed)


def test_with_another_gain_and_bias_what_was_seen_counts_on():
    believed, watch = Plausibility(max_rate=10.0, saturation_count=3), TensionWatch()
    before, now = (CableScale(),) * 2, (CableScale(gain=-2.0, bias=10.0),) * 2
    for place, tension in enumerate((1.0, 1.5, 2.0, 2.0)):
        watch.take((tension, 1.0 + 0.01 * place), 0.1 * place, before, believed)
    watch.rescale(before, now)
    with pytest.raises(ReadingError, match='been at its smallest, 6 N, for 3 readings'):
        watch.take((6.0, 7.9), 0.4, now, believed)
    assert watch.take((6.1, 7.9), 0.5, now, believed) == (6.1, 7.9)
