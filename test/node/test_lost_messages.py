"""Losses by the numbers of messages: all of one publisher, none that may be another's doing."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tendon_statics.node.inputs.lost_messages import LostMessages

ONE, OTHER = 'one', 'other'


@pytest.fixture
def lost():
    return LostMessages()


def noted(lost, *numbers):
    for number in numbers:
        lost.note(number)


def test_what_is_missing_between_two_numbers_of_one_publisher_is_lost(lost):
    """It counts at the second report after it."""
    noted(lost, 7, 8, 12)
    assert lost.settle([ONE]) == 0
    noted(lost, 13, 15)
    assert lost.settle([ONE]) == 3
    assert lost.settle([ONE]) == 1
    assert lost.settle([ONE]) == 0


def test_what_a_publisher_lost_before_it_left_is_lost(lost):
    noted(lost, 1, 4)
    assert [lost.settle(known) for known in ([ONE], [], [OTHER], [OTHER])] == [0, 2, 0, 0]


def test_the_first_message_of_a_second_publisher_is_no_loss_though_it_is_not_known_yet(lost):
    noted(lost, 100, 101)
    lost.settle([ONE])
    noted(lost, 102, 5000)  # the other's
    assert [lost.settle(known) for known in ([ONE], [ONE, OTHER], [ONE, OTHER])] == [0, 0, 0]


def test_a_second_publisher_that_is_never_known_is_seen_by_numbers_that_fall(lost):
    lost.settle([ONE])
    noted(lost, 102, 5000)
    lost.settle([ONE])
    noted(lost, 103, 5001, 104)
    assert [lost.settle([ONE]) for _ in range(3)] == [0, 0, 0]


@pytest.mark.parametrize('between', [([],), ([], []), (), ([ONE, OTHER],)])
def test_a_publisher_in_place_of_another_has_lost_nothing(lost, between):
    """Whether it begins to number anew or is heard in the middle."""
    noted(lost, 50, 51)
    lost.settle([ONE])
    for known in between:
        assert lost.settle(known) == 0
    noted(lost, 900, 901)
    assert [lost.settle([OTHER]) for _ in range(3)] == [0, 0, 0]
    noted(lost, 1, 2)
    assert [lost.settle([ONE]) for _ in range(3)] == [0, 0, 0]


def test_one_that_is_heard_before_a_report_that_knows_of_none_has_lost_nothing(lost):
    noted(lost, 50, 51)
    lost.settle([ONE])
    noted(lost, 900, 901)
    assert [lost.settle(known) for known in ([], [OTHER], [OTHER], [OTHER])] == [0, 0, 0, 0]


def test_two_publishers_that_take_turns_lose_nothing(lost):
    for number in range(1, 100):
        noted(lost, number, 2000 + number)
        assert lost.settle([ONE, OTHER]) == 0
    noted(lost, 2100)
    assert [lost.settle([OTHER]) for _ in range(3)] == [0, 0, 0]


def test_what_waited_of_a_publisher_that_has_left_is_no_gap_in_the_other(lost):
    """A busy node hears that it left before it takes its last messages."""
    for number in range(1, 60):
        noted(lost, 4000 + number, number)
    lost.settle([ONE, OTHER])
    noted(lost, 4060, 60)
    lost.settle([ONE])
    noted(lost, 4061, 61, 62, 4062, 4063)
    assert [lost.settle([ONE]) for _ in range(3)] == [0, 0, 0]
    noted(lost, 4066)
    assert [lost.settle([ONE]) for _ in range(3)] == [0, 2, 0]


def test_what_was_forgotten_is_not_lost(lost):
    noted(lost, 1, 5)
    lost.forget()
    noted(lost, 9)
    assert [lost.settle([ONE]) for _ in range(3)] == [0, 0, 0]


def test_without_numbers_nothing_is_counted_and_nothing_fails(lost):
    assert lost.are_counted
    noted(lost, None, None, 5, None)
    assert not lost.are_counted
    assert [lost.settle([ONE]) for _ in range(3)] == [0, 0, 0]


@given(
    st.lists(
        st.lists(st.tuples(st.booleans(), st.just(1) | st.integers(1, 50)), max_size=8),
        min_size=1,
        max_size=8,
    ),
    st.integers(-10, 10) | st.integers(-1000, 1000),
    st.integers(0, 4),
    st.integers(2, 4),
)
def test_of_a_publisher_alone_every_loss_counts_and_of_two_none_that_was_not(
    periods, start, joins, stays
):
    """Messages come or are lost, in periods between reports; a second publisher may join.

    It may leave, too, and then its last messages are taken after that is known.
    """
    leaves = joins + stays
    lost = LostMessages()
    newest = {ONE: 1000, OTHER: 1000 + start}
    lasts = dict.fromkeys(newest, None)
    really_lost = claimed = 0
    was_known = False
    for index, messages in enumerate(periods):
        for is_others, step in messages:
            speaks = joins <= index < leaves or (was_known and index <= leaves + 1)
            who = OTHER if is_others and speaks else ONE
            newest[who] += step
            if lasts[who] is not None:
                really_lost += newest[who] - lasts[who] - 1
            lasts[who] = newest[who]
            lost.note(newest[who])
        both_heard = lasts[OTHER] is not None
        # A new publisher is known with the next report at the latest.
        is_there = both_heard and index < leaves
        is_known = is_there and index > joins
        was_known = was_known or is_known
        claimed += lost.settle([ONE, OTHER] if is_known else [ONE])
    for _ in range(2):
        claimed += lost.settle([ONE, OTHER] if is_there else [ONE])
    if both_heard:
        assert claimed <= really_lost
    else:
        assert claimed == really_lost
