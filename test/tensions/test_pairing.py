"""Parts of any number of cables, joined to wholes of one time."""

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tendon_statics.tensions.pairing import Pairing, Part

MILLISECOND = 1_000_000


class Joined:
    """What a pairing delivers and drops."""

    def __init__(self, count, skew):
        self.wholes, self.dropped = [], []
        self.pairing = Pairing(count, lambda: skew, self.deliver, self.dropped.append)

    def deliver(self, parts):
        self.wholes.append({cable: of for part in parts for cable, of in part.values.items()})

    def take(self, time, *cables):
        self.pairing.take(Part(round(time * MILLISECOND), dict.fromkeys(cables, time)))


def test_parts_of_several_cables_make_a_whole_in_the_order_of_the_cables():
    joined = Joined(5, 0.001)
    for time in (1.0, 2.0):
        joined.take(time, 3)
        joined.take(time + 0.4, 1, 4)
        joined.take(time + 0.2, 0, 2)
    assert [sorted(whole) for whole in joined.wholes] == [[0, 1, 2, 3, 4]] * 2
    assert joined.wholes[1][4] == 2.4
    assert not joined.dropped


def test_other_parts_than_before_end_the_streams_that_they_share_a_cable_with():
    joined = Joined(3, 0.001)
    joined.take(1.0, 0, 1)
    joined.take(1.2, 1, 2)
    joined.take(1.3, 0)
    assert joined.wholes == [{0: 1.3, 1: 1.2, 2: 1.2}]
    assert [part.values for part in joined.dropped] == [{0: 1.0, 1: 1.0}]


@pytest.mark.parametrize('lost', [0, 1, 2])
@pytest.mark.parametrize('jitter', [0.0, 0.05])
def test_a_lost_part_does_not_shift_the_wholes_after_it(lost, jitter):
    """Though max_skew is five periods."""
    generator, joined = random.Random(1), Joined(3, 0.005)
    for number in range(1, 60):
        for cable in range(3):
            if (number, cable) != (20, lost):
                joined.take(number + jitter * generator.random(), cable)
    mixed = [whole for whole in joined.wholes if max(whole.values()) - min(whole.values()) > 0.5]
    assert len(mixed) <= 1
    assert len(joined.dropped) == 2
    assert min(joined.wholes[-1].values()) >= 59.0


@pytest.mark.parametrize('count', [2, 3, 4, 8])
def test_streams_that_run_freely_lose_nothing(count):
    """At phases that are as far apart as can be, with jitter, though max_skew is five periods."""
    generator, joined = random.Random(2), Joined(count, 0.005)
    sent = [
        (number + cable / count + generator.uniform(-0.02, 0.02), cable)
        for number in range(1, 500)
        for cable in range(count)
    ]
    for time, cable in sorted(sent):
        joined.take(time, cable)
    assert len(joined.wholes) >= 498
    assert not joined.dropped


@given(
    st.lists(st.tuples(st.sampled_from([(0,), (1,), (2, 3), (2,)]), st.integers(0, 40))),
    st.integers(0, 5),
)
def test_every_part_is_in_one_whole_dropped_or_waiting(sent, skew):
    joined, parts = Joined(4, skew * 1e-3), []
    joined.pairing._deliver = parts.extend
    for cables, time in sent:
        joined.take(time, *cables)
    joined.pairing.forget()
    assert len(parts) + len(joined.dropped) == len(sent)
