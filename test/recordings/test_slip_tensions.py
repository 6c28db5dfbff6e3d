"""The tension at which a unit is to slip where it was measured to be."""

import numpy as np
import pytest
from designs import PRELIMINARY
from hypothesis import assume, given
from hypothesis import strategies as st

from tendon_statics import Load, Recording, UnreachableError, tensions_for
from tendon_statics.recordings.replay.estimates import replay
from tendon_statics.recordings.replay.slip_tensions import slip_tensions

STOP = PRELIMINARY.max_bend_angle


def predicted(tension_l, tension_s, bend_angle, load):
    recording = Recording(*(np.array([value]) for value in (tension_l, tension_s, bend_angle)))
    found = slip_tensions(PRELIMINARY, replay(PRELIMINARY, recording, load=load))
    return float(found.tension_l[0]), float(found.tension_s[0])


@given(
    angle=st.floats(-0.9 * STOP, 0.9 * STOP),
    total=st.floats(1.0, 8.0),
    share=st.floats(0.55, 0.95),
    tilt=st.floats(-0.4, 0.4),
)
def test_it_is_that_of_the_inverse_at_the_same_sum(angle, total, share, tilt):
    load = Load.tilted(tilt)
    try:
        weak, strong = sorted(
            tensions_for(PRELIMINARY, abs(angle), total_tension=total, load=load)
        )
    except UnreachableError:
        assume(False)
    assume(weak < strong)
    tensions = (total - share * total, share * total)
    of_l, of_s = predicted(*tensions, abs(angle), load)
    assume(not np.isnan(of_s))  # driven to cable l by gravity
    assert of_s == pytest.approx(strong, rel=1e-9)
    assert np.isnan(of_l)


def test_it_is_of_the_cable_that_drives_and_none_at_a_stop():
    of_l, of_s = predicted(2.0, 1.0, -0.1, Load())
    assert of_l == pytest.approx(max(tensions_for(PRELIMINARY, -0.1, total_tension=3.0)))
    assert np.isnan(of_s)
    assert np.isnan(predicted(2.0, 1.0, -STOP, Load())).all()


def test_without_measured_angles_there_is_none():
    recording = Recording(np.ones(2), np.ones(2))
    assert slip_tensions(PRELIMINARY, replay(PRELIMINARY, recording)) is None
