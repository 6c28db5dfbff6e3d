"""Gravity's direction from quaternions and accelerations, against SciPy's rotations."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from tendon_statics import Load
from tendon_statics.estimation.orientation import (
    OrientationError,
    gravity_from_acceleration,
    gravity_in_frame,
    roll_and_pitch,
    turned,
)

DOWN = np.array([0.0, 0.0, -1.0])
angles = st.floats(-3.0, 3.0)


@given(angles, angles, angles)
def test_gravity_in_a_turned_frame_is_what_a_rotation_makes_of_it(roll, pitch, yaw):
    turn = Rotation.from_euler('xyz', (roll, pitch, yaw))
    assert gravity_in_frame(*turn.as_quat()) == pytest.approx(turn.inv().apply(DOWN), abs=1e-12)
    vector = (0.3, -0.5, 0.9)
    assert turned(vector, roll, pitch, yaw) == pytest.approx(turn.apply(vector), abs=1e-12)


@given(angles, angles, angles)
def test_a_base_turned_by_roll_and_pitch_has_that_gravity(roll, pitch, yaw):
    direction = Rotation.from_euler('xyz', (roll, pitch, yaw)).apply(DOWN)
    turn = Rotation.from_euler('xyz', (*roll_and_pitch(tuple(direction)), 0.0))
    assert turn.inv().apply(DOWN) == pytest.approx(direction, abs=1e-9)


def test_a_tilt_towards_s_is_one_about_y():
    half = math.radians(5.0)
    direction = gravity_in_frame(0.0, math.sin(half), 0.0, math.cos(half))
    expected = Load.tilted(math.radians(10.0)).gravity_direction
    assert direction == pytest.approx(expected, abs=1e-15)
    # An accelerometer at rest measures upwards.
    up = [-9.6 * part for part in expected]
    assert gravity_from_acceleration(*up) == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize(
    ('quaternion', 'named'),
    [
        ((0.0, 0.0, 0.0, 0.0), 'of length 0;'),
        ((0.0, 0.0, 0.0, 1.01), 'of length 1.01;'),
        ((math.nan, 0.0, 0.0, 1.0), 'not finite'),
        ((math.inf, 0.0, 0.0, 1.0), 'not finite'),
    ],
)
def test_what_is_no_unit_quaternion_is_refused(quaternion, named):
    with pytest.raises(OrientationError, match=named):
        gravity_in_frame(*quaternion)


def test_quaternions_of_few_digits_are_taken():
    turn = Rotation.from_euler('xyz', (0.3, -0.2, 1.0))
    for quaternion in (turn.as_quat().round(4), turn.as_quat().astype(np.float32)):
        found = gravity_in_frame(*map(float, quaternion))
        assert found == pytest.approx(turn.inv().apply(DOWN), abs=1e-3)
        assert math.hypot(*found) == pytest.approx(1.0)


@pytest.mark.parametrize('acceleration', [(0, 0, 0), (0, 0, 1), (0, 0, 12), (0, 0, math.nan)])
def test_an_acceleration_that_is_not_that_of_rest_is_refused(acceleration):
    with pytest.raises(OrientationError, match='of a base at rest 9'):
        gravity_from_acceleration(*acceleration)
