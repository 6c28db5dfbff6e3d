"""What of load cells is believed, and which cable is slack, reading by reading."""

import math

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
    found = outcomes([1.0] + [4.0] * 5, Plausibility(max_rate=10.0))
    assert found == [1.0, Reason.TOO_FAST, Reason.TOO_FAST, 4.0, 4.0, 4.0]


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
