"""`parse_column`: titles that are meant for a quantity are read or refused, never overlooked."""

import numpy as np
import pytest
from designs import PRELIMINARY

from tendon_statics import Recording, RecordingError
from tendon_statics.recordings.reading.units import UNITS, parse_column
from tendon_statics.recordings.replay.estimates import replay


@pytest.mark.parametrize('quantity', UNITS)
def test_a_quantity_is_read_with_each_of_its_units(quantity):
    assert parse_column(f' {quantity} ') == (quantity, 1.0)
    for unit, factor in UNITS[quantity].items():
        assert parse_column(f'{quantity} [{unit}]') == (quantity, factor)


@pytest.mark.parametrize(
    ('title', 'hint'),
    [
        ('pressure (kPa)', r'pressure \[kPa\]'),
        ('tension_l(mN)', r'tension_l \[mN\]'),
        ('bend_angle_deg', r'bend_angle \[deg\]'),
        ('bend_angle_degrees', 'bend_angle or'),
        ('bend_angle °', 'bend_angle or'),
        ('pressure, psi', 'pressure or'),
        ('pressure in MPa', r'pressure \[MPa\]'),
        ('Tension_L', 'tension_l or'),
        ('TensionS [mN]', r'tension_s \[mN\]'),
        ('bend angle', 'bend_angle or'),
        ('Bend-Angle [deg] {raw}', r'bend_angle \[deg\]'),
        ('State', 'state;'),
    ],
)
def test_what_would_be_overlooked_is_refused_with_the_way_to_write_it(title, hint):
    with pytest.raises(RecordingError, match=f'overlooked: write .*{hint}'):
        parse_column(title)


@pytest.mark.parametrize(
    'title',
    ['timestamp', 'timestamp_note', 'time_of_day', 'tension_left', 'pressure_sensor', 'state'],
)
def test_what_is_something_else_is_left_alone(title):
    assert parse_column(title) == (title, 1.0)


def test_the_columns_of_a_replay_are_read_as_what_they_are():
    ones = np.ones(2)
    recording = Recording(ones, ones, ones, ones, ['held', 'held'], ones)
    for title in replay(PRELIMINARY, recording).columns():
        assert parse_column(title) == (title, 1.0)
