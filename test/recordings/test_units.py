"""`Quantities`: titles meant for a quantity are read or refused, never overlooked."""

import numpy as np
import pytest
from designs import PRELIMINARY

from tendon_statics import Arm, ArmUnit, Cable, Recording, RecordingError
from tendon_statics.recordings.reading.units import OF_UNIT, of_arm, split_title
from tendon_statics.recordings.replay.estimates import replay


@pytest.mark.parametrize('quantity', [*filter(OF_UNIT.has_units, OF_UNIT.kinds)])
def test_a_quantity_is_read_with_each_of_its_units(quantity):
    OF_UNIT.check_title(f' {quantity} ')
    for unit, factor in OF_UNIT.kinds[quantity].units.items():
        OF_UNIT.check_title(f'{quantity} [{unit}]')
        assert split_title(f'{quantity} [{unit}]') == (quantity, unit)
        assert OF_UNIT.factor(quantity, unit) == factor


@pytest.mark.parametrize(
    ('title', 'hint'),
    [
        ('pressure (kPa)', r'pressure \[kPa\]'),
        ('tension_l(mN)', r'tension_l \[mN\]'),
        ('bend_angle_deg', r'bend_angle \[deg\]'),
        ('bend_angle_deg', '--columns bend_angle="bend_angle_deg" --units bend_angle=UNIT;'),
        ('bend_angle_degrees', 'bend_angle or'),
        ('bend_angle °', 'bend_angle or'),
        ('pressure, psi', 'pressure or'),
        ('pressure in MPa', r'pressure \[MPa\]'),
        ('Tension_L', 'tension_l or'),
        ('TensionS [mN]', r'tension_s \[mN\]'),
        ('bend angle', 'bend_angle or'),
        ('Bend-Angle [deg] {raw}', r'bend_angle \[deg\]'),
        ('State', 'state, or say --columns state="State"'),
    ],
)
def test_what_would_be_overlooked_is_refused_with_the_way_to_write_it(title, hint):
    with pytest.raises(RecordingError, match=f'overlooked: write .*{hint}'):
        OF_UNIT.check_title(title)


@pytest.mark.parametrize(
    'title',
    ['timestamp', 'timestamp_note', 'time_of_day', 'tension_left', 'pressure_sensor', 'state'],
)
def test_what_is_something_else_is_left_alone(title):
    OF_UNIT.check_title(title)


def test_the_columns_of_a_replay_are_read_as_what_they_are():
    ones = np.ones(2)
    recording = Recording(ones, ones, ones, ones, ['held', 'held'], time=ones)
    for title in replay(PRELIMINARY, recording).columns():
        OF_UNIT.check_title(title)


def arm_of(*cables):
    """An arm of two units with cables of these names, to l and to s in turn."""
    pulls = [Cable(name, 'ls'[number % 2], 2) for number, name in enumerate(cables)]
    return Arm([ArmUnit(PRELIMINARY, 0.02)] * 2, pulls)


def test_cables_of_an_arm_are_read_by_their_names_and_not_overlooked():
    arm = of_arm(arm_of('l_mid', 's_mid', 'l1', 's1'))
    assert arm.factor('l_mid', 'mN') == 1e-3
    assert arm.factor('bend_angle_2', 'mrad') == 1e-3
    for title in ('l_mid [mN]', 'l1 raw', 'pressure [bar]'):
        arm.check_title(title)
    for title, hint in (('L Mid (mN)', r'l_mid \[mN\]'), ('l1 in N', 'l1 or'), ('L1', 'l1 or')):
        with pytest.raises(RecordingError, match=f'overlooked: write .*{hint}'):
            arm.check_title(title)
    with pytest.raises(RecordingError, match='a cable of the arm is called time'):
        of_arm(arm_of('time', 's'))


@pytest.mark.parametrize(
    ('title', 'factor'),
    [
        *(('tension_l [Newton]', 1.0), ('tension_l [millinewtons]', 1e-3)),
        *(('bend_angle [degrees]', np.radians(1.0)), ('bend_angle [Radians]', 1.0)),
        *(('pressure [kilopascals]', 1e3), ('time [seconds]', 1.0)),
    ],
)
def test_a_unit_may_be_written_out(title, factor):
    name, unit = split_title(title)
    assert OF_UNIT.factor(name, unit) == pytest.approx(factor)
