"""Recordings whose samples cannot vouch for a tracked unit: replay says what the node would."""

import dataclasses
import math

import numpy as np
import pytest
from designs import PRELIMINARY
from programs import run

from tendon_statics import Recording, default_design_path
from tendon_statics.estimation.methods import METHODS
from tendon_statics.estimation.settings import Settings
from tendon_statics.estimation.unit_estimator import KnownLoad, UnitEstimator
from tendon_statics.physics import UPRIGHT, Load
from tendon_statics.recordings.replay.estimates import replay
from tendon_statics.tensions.cable_scale import CableScale
from tendon_statics.tensions.reason import ReadingError
from tendon_statics.tensions.watch import Plausibility

SETTINGS = Settings(PRELIMINARY)
NAN = math.nan
CASES = {
    'slack but for noise': ([0.0, 0.1, 0.2, 0.3], [1, 0.01, 0.01, 1], [1, 0.01, 0.01, 1]),
    'a little below 0': ([0.0, 0.1, 0.2, 0.3], [1, -0.01, 0.5, 1], [1, 1, -0.02, 1]),
    'drive off': ([0.0, 0.1, 0.2, 0.3], [1, NAN, NAN, 1], [1, NAN, NAN, 1]),
    'an hour without': ([0.0, 3600.0], [1, 1], [1, 1]),
}


def tracked(time, tension_l, tension_s, settings=SETTINGS, estimation='tracking', **options):
    recording = Recording(tension_l=tension_l, tension_s=tension_s, time=time)
    return replay(PRELIMINARY, recording, estimation, settings=settings, **options)


REMEMBERING = [name for name, method in METHODS.items() if method.remembers]


@pytest.mark.parametrize('estimation', REMEMBERING)
@pytest.mark.parametrize('case', CASES)
def test_its_angle_is_not_assured_any_more(case, estimation):
    found = tracked(*CASES[case], estimation=estimation)
    assert found.angle_assured[0]
    assert not found.angle_assured[1:].any()
    assert found.bend_angle[-1] == 0.0


@pytest.mark.parametrize('estimation', REMEMBERING)
@pytest.mark.parametrize('case', CASES)
def test_node_and_replay_say_the_same(case, estimation):
    """The node's estimator, fed with the same samples at the same times."""
    unit, expected = UnitEstimator(SETTINGS, estimation), []
    for time, *tensions in zip(*CASES[case], strict=True):
        try:
            result = unit.take(*tensions, KnownLoad(UPRIGHT), time, time)
        except ReadingError as error:
            expected.append(('invalid', error.reason.value, False))
        else:
            expected.append((result.regime.value, 'valid', result.angle_assured))
    found = tracked(*CASES[case], estimation=estimation)
    columns = (found.regime.tolist(), found.validity.tolist(), found.angle_assured.tolist())
    assert list(zip(*columns, strict=True)) == expected


def test_one_spike_puts_a_unit_at_its_stop_unless_it_is_known_to_be_wrong():
    time, tension_l, tension_s = [0.0, 0.1, 0.2, 0.3], [1.0] * 4, [1.5, 4.194, 1.5, 1.5]
    believed = tracked(time, tension_l, tension_s)
    assert believed.bend_angle[-1] == PRELIMINARY.max_bend_angle
    cable = CableScale(max_tension=3.0)
    for settings, reason in (
        (dataclasses.replace(SETTINGS, plausibility=Plausibility(max_rate=10.0)), 'too fast'),
        (dataclasses.replace(SETTINGS, cable_l=cable, cable_s=cable), 'implausible'),
    ):
        found = tracked(time, tension_l, tension_s, settings)
        if reason == 'too fast':
            assert found.validity.tolist() == ['valid', reason, 'valid', 'valid']
            assert found.bend_angle[-1] == 0.0
            # The first has none before it that would tell it from a spike.
            assert found.angle_assured.tolist() == [False, False, False, False]
        alone = replay(
            PRELIMINARY,
            Recording(tension_l=tension_l, tension_s=tension_s, time=time),
            settings=settings,
        )
        if reason == 'too fast':
            assert alone.regime.tolist() == ['held', 'invalid', 'held', 'held']


def test_a_unit_s_file_says_what_is_believed(tmp_path):
    data, unit = tmp_path / 'spike.csv', tmp_path / 'unit.yaml'
    data.write_text('time,tension_l,tension_s\n0,1,1.5\n0.1,1,4.194\n0.2,1,1.5\n')
    design = dataclasses.asdict(PRELIMINARY)
    lines = ''.join(f'      {name}: {value}\n' for name, value in design.items())
    for line, reason in (
        ('max_tension_rate: 10.0', 'too fast'),
        ('cable_s.max_tension: 3.0', 'implausible'),
    ):
        unit.write_text(f'/**:\n  ros__parameters:\n    {line}\n    design:\n{lines}')
        done = run('replay', data, '--design', unit, '--estimation', 'tracking')
        assert done.returncode == 0, done.stderr
        assert f'invalid       {reason} 1\n' in done.stdout
        assert ('what is too fast is not believed' in done.stdout) == (reason == 'too fast')
        followed = run('track', data, '--design', unit).stdout.splitlines()
        assert followed[-1].split(',')[3] == '0.0'
        assert followed[-1].endswith(',False')


def test_a_rate_that_cannot_be_checked_is_said(tmp_path):
    data, unit = tmp_path / 'spike.csv', tmp_path / 'unit.yaml'
    data.write_text('tension_l,tension_s\n1.0,1.5\n1.0,4.194\n1.0,1.5\n1.0,1.5\n')
    lines = ''.join(f'      {name}: {v}\n' for name, v in dataclasses.asdict(PRELIMINARY).items())
    unit.write_text(f'/**:\n  ros__parameters:\n    max_tension_rate: 1.0\n    design:\n{lines}')
    asked = ('replay', data, '--design', unit, '--estimation', 'tracking')
    said = run(*asked).stdout
    assert 'max_tension_rate of the design file is not checked: there are no times (--rate' in said
    assert 'warning       tension_s goes from 1.5 N to 4.194 N and back within one sample' in said
    timed = run(
        'replay', data, '--design', unit, '--estimation', 'tracking', '--rate', '10'
    ).stdout
    assert 'invalid       too fast 1' in timed
    assert 'time: 10 rows per second, as was said' in timed
    assert 'within one sample' not in timed
    followed = run('track', data, '--design', unit, '--rate', '10').stdout.splitlines()
    assert followed[-1].split(',')[3] == '0.0'
    assert run('track', data, '--rate', '0').returncode == 2
    data.write_text('time,tension_l,tension_s\n0,1.0,1.5\n')
    assert 'a rate (--rate) is for tables without' in run('track', data, '--rate', '1').stderr


def test_the_load_of_the_unit_is_that_of_its_settings_unless_another_is_given():
    tilt = math.radians(10.0)
    settings = dataclasses.replace(SETTINGS, gravity_direction=Load.tilted(tilt).gravity_direction)
    recording = Recording(tension_l=[1.0], tension_s=[2.0])
    for load, degrees in ((None, 7.140), (UPRIGHT, 17.140)):
        found = replay(PRELIMINARY, recording, settings=settings, load=load)
        assert np.degrees(found.bend_angle[0]) == pytest.approx(degrees, abs=5e-4)


@pytest.mark.parametrize(
    ('settings', 'tension_s', 'assured'),
    [
        (dataclasses.replace(SETTINGS, tension_stddev=0.05), [1.1, 1.85, 1.1, 3.0], [1, 1, 1, 1]),
        (
            dataclasses.replace(SETTINGS, plausibility=Plausibility(max_rate=10.0)),
            [3.0, 1.1, 1.1, 1.2],
            [0, 0, 0, 0],  # one was refused, but none has moved the unit
        ),
        (
            dataclasses.replace(SETTINGS, plausibility=Plausibility(max_rate=10.0)),
            [1.1, 1.1, 3.0, 1.1],
            [0, 1, 0, 0],
        ),
    ],
)
def test_of_noise_and_spikes_node_and_replay_say_the_same(settings, tension_s, assured):
    unit, of_node = UnitEstimator(settings, 'tracking'), []
    times = [0.1 * place for place in range(4)]
    for time, tension in zip(times, tension_s, strict=True):
        try:
            result = unit.take(1.0, tension, KnownLoad(UPRIGHT), time, time)
        except ReadingError as error:
            of_node.append((error.reason.value, False))
        else:
            of_node.append(('valid', result.angle_assured))
    found = tracked(times, [1.0] * 4, tension_s, settings)
    of_replay = (found.validity.tolist(), found.angle_assured.tolist())
    assert list(zip(*of_replay, strict=True)) == of_node
    assert [is_assured for _, is_assured in of_node] == [bool(one) for one in assured]
    if settings.plausibility.is_checked:
        assert found.bend_angle[-1] == 0.0


@pytest.mark.parametrize(
    ('lines', 'options', 'said'),
    [
        ('', (), 'a cable counts as slack up to 0.03 N, 3 times the tension_stddev of 0.01 N'),
        ('', ('--tension-stddev', 0.02), 'a cable counts as slack up to 0.06 N, 3 times the'),
        ('tension_stddev: 0.1', (), 'up to 0.3 N, 3 times the tension_stddev of 0.1 N'),
        (
            'cable_l.slack_threshold: 0.2',
            (),
            'cable_l counts as slack up to 0.2 N, its slack_threshold; cable_s counts as slack up '
            'to 0.03 N, 3 times the tension_stddev of 0.01 N',
        ),
    ],
)
@pytest.mark.parametrize('verb', ['replay', 'track', 'report'])
def test_every_verb_says_up_to_which_tension_a_cable_is_slack(
    tmp_path, verb, lines, options, said
):
    data, unit, page = (tmp_path / name for name in ('run.csv', 'unit.yaml', 'report.html'))
    data.write_text('time,tension_l,tension_s\n0,1,1.5\n0.1,1,1.5\n')
    design = default_design_path().read_text()
    unit.write_text(design.replace('    design:', f'    {lines}\n    design:'))
    more = ('--output', page) if verb == 'report' else ()
    done = run(verb, data, '--design', unit, *options, *more)
    assert done.returncode == 0, done.stderr
    assert said in (page.read_text() if verb == 'report' else done.stdout + done.stderr)
