"""What looks as if it were in another unit is said, in every verb that reads a recording."""

import dataclasses

import numpy as np
import pytest
from designs import PRELIMINARY
from programs import run
from slips import recording, session, slipping_samples

from tendon_statics import Recording, RecordingError, default_design_path, load_recording
from tendon_statics.estimation.settings import Settings
from tendon_statics.files.installed_files import installed_config
from tendon_statics.recordings.hints import hints
from tendon_statics.tensions.cable_scale import CableScale
from tendon_statics.tensions.watch import Plausibility

SETTINGS = Settings(PRELIMINARY)
SESSION = installed_config('recorded_session.mcap')
ONES = np.ones(5)
TIMES = np.arange(5.0)


@pytest.mark.parametrize(
    ('more', 'named'),
    [
        ({'bend_angle': [12.0, 15.0, 17.0, 0.0, 1.0]}, 'bend_angle [deg]'),
        ({'bend_angle': [0.1, 0.0, 0.0, 0.0, -20.0]}, 'bend_angle [deg]'),
        ({'bend_angle': [210.0, -300.0, 150.0, 0.0, 1.0]}, 'if they are mrad,'),
        ({'bend_angle': [210.0, 300.0, 150.0, 0.4, 0.3]}, '--units bend_angle=mrad'),
        ({'base_tilt': [0.0, 10.0, 10.0, 10.0, 10.0]}, '--units base_tilt=deg (mrad likewise)'),
        ({'base_tilt': [0.0, 900.0, 900.0, 900.0, 900.0]}, '--units base_tilt=mrad'),
        ({'bend_angle': [0.7, 0.7, 0.1, 0.1, np.nan]}, 'too small a max_bend_angle'),
        ({'tension_l': 1000.0 * ONES, 'tension_s': 1500.0 * ONES}, '--units tension=mN'),
        ({'tension_l': 102.0 * ONES, 'tension_s': 153.0 * ONES}, 'gf'),
        ({'tension_l': 1e4 * ONES, 'tension_s': 1.5e4 * ONES}, 'cable_l.gain'),
        ({'tension_l': 0.001 * ONES, 'tension_s': 0.0015 * ONES}, '[kgf]'),
        ({'time': 10.0 * TIMES}, 'time [ms]'),
        ({'time': 2e4 * TIMES}, 'time [us]'),
        ({'time': 1e7 * TIMES}, 'time [ns]'),
        ({'time': 1e-8 * TIMES}, 'may be a larger one'),
        ({'time': 1e-5 * TIMES}, 'may be a larger one'),
        ({'time': 46353.0 + 1e-7 * TIMES}, '--units time=d'),
        ({'time': 739948.0 + 1e-7 * TIMES}, '--units time=d'),
        ({'tension_l': 10.0 * ONES, 'tension_s': 15.0 * ONES}, '--units tension=gf'),
    ],
)
def test_a_quantity_that_no_unit_has_is_doubted(more, named):
    values = {'tension_l': ONES, 'tension_s': 1.5 * ONES, **more}
    (hint,) = hints(Recording(**values), SETTINGS)
    assert named in hint
    assert '\n' not in hint


@pytest.mark.parametrize(
    'more',
    [
        {},
        {'bend_angle': [0.53, -0.53, 0.0, 0.52, np.nan]},
        {'bend_angle': [np.nan] * 5},
        {'bend_angle': [0.1] * 4 + [3.0], 'tension_l': [0.0] * 5},
        {'time': TIMES},
        {'time': 0.001 * TIMES},
        {'time': [np.nan] * 5},
        {'tension_l': [np.nan] * 5, 'tension_s': [np.nan] * 5},
        {'tension_l': 20.0 * ONES},
    ],
)
def test_a_sound_recording_is_not_doubted(more):
    values = {'tension_l': ONES, 'tension_s': 1.5 * ONES, **more}
    if 'bend_angle' in more and 3.0 in more['bend_angle']:
        values['bend_angle'] = np.r_[np.full(50, 0.1), 3.0]
        values |= {'tension_l': np.ones(51), 'tension_s': np.ones(51)}
    assert hints(Recording(**values), SETTINGS) == []


@pytest.mark.parametrize(
    ('titles', 'row', 'said'),
    [
        ('tension_l,tension_s,bend_angle [mrad]', '1,1.5,12000', 'of the measured angles lie'),
        ('tension_l [N],tension_s [N]', '1000,1500', 'times the weight of the unit'),
        ('tension_l [N],tension_s [N]', '11,12', 'even the least of the two tensions'),
        ('tension_l [mN],tension_s [mN]', '1,1.5', 'are far below the weight of the unit'),
    ],
)
def test_of_a_unit_that_is_said_no_hint_asks_to_say_it(tmp_path, titles, row, said):
    path = tmp_path / 'run.csv'
    path.write_text(f'{titles}\n' + f'{row}\n' * 3)
    (hint,) = hints(load_recording(path), SETTINGS)
    assert said in hint
    assert 'the unit that is said of them may be wrong' in hint
    assert '--units' not in hint
    assert 'deg' not in hint


@pytest.mark.parametrize(
    ('title', 'meant'),
    [
        ('bend_angle_mrad', '[mrad]'),
        ('bend angle (milliradians)', '[mrad]'),
        ('bend_angle (degrees)', '[deg]'),
        ('bend_angle °', '[°]'),
    ],
)
def test_a_title_that_would_be_overlooked_is_refused_with_its_unit(tmp_path, title, meant):
    path = tmp_path / 'run.csv'
    path.write_text(f'tension_l,tension_s,{title}\n1,1.5,12\n')
    with pytest.raises(RecordingError) as error:
        load_recording(path)
    assert f'bend_angle {meant} (there are' in str(error.value)


def test_what_is_heavy_for_one_unit_is_light_for_another():
    recording = Recording(100.0 * ONES, 150.0 * ONES)
    assert hints(recording, SETTINGS)
    assert hints(recording, Settings(dataclasses.replace(PRELIMINARY, mass=2.0))) == []


@pytest.mark.parametrize('verb', ['replay', 'track', 'calibrate', 'report', 'plot recording'])
def test_every_verb_gives_the_hint_on_degrees_whatever_the_regime(tmp_path, verb):
    path = tmp_path / 'run.csv'
    path.write_text('time,tension_l,tension_s,bend_angle\n0,1,1.5,12\n1,1,1.5,15\n2,1,1.6,17\n')
    output = tmp_path / ('out.svg' if verb.startswith('plot') else 'out.html')
    more = ('--output', output) if verb.split()[0] in ('report', 'plot') else ()
    done = run(*verb.split(), path, *more)
    said = done.stdout + done.stderr + (output.read_text() if verb == 'report' else '')
    assert 'of the measured angles lie beyond the stop' in said
    assert 'bend_angle [deg]' in said


SPIKE = {'tension_l': [1.0] * 4, 'tension_s': [1.5, 4.194, 1.5, 1.5]}


@pytest.mark.parametrize(
    ('values', 'said'),
    [
        ({20: 0.06}, 'tension_s goes from 1.5 N to 0.06 N and back within one sample, 1 times'),
        ({20: 4.2, 40: 0.06}, 'tension_s goes from 1.5 N to 4.2 N and back within one sample, 2'),
        ({0: 0.06}, 'tension_s goes from 1.5 N to 0.06 N and back within one sample, 1 times'),
        ({20: 0.02}, ''),
    ],
    ids=['downwards', 'both', 'at the beginning', 'slack, which casts doubt'],
)
def test_a_spike_is_said_whichever_way_it_goes(values, said):
    tension_s = np.full(60, 1.5)
    tension_s[[*values]] = [*values.values()]
    found = hints(Recording(np.ones(60), tension_s, time=0.01 * np.arange(60)), SETTINGS)
    assert len(found) == bool(said)
    assert all(said in hint for hint in found)


def test_a_spike_is_said_with_or_without_times_unless_rates_are_checked():
    for time in (None, [0.0, 0.1, 0.2, 0.3]):
        spiked = Recording(**SPIKE, time=time)
        (hint,) = hints(spiked, SETTINGS)
        assert 'tension_s goes from 1.5 N to 4.194 N and back within one sample, 1 times' in hint
        checked = hints(
            spiked, dataclasses.replace(SETTINGS, plausibility=Plausibility(max_rate=10.0))
        )
        assert checked == ([hint] if time is None else [])
    known = Recording(**SPIKE, faults=['', 'implausible', '', ''])
    assert hints(known, SETTINGS) == []


@pytest.mark.parametrize('seed', range(10))
def test_slips_sessions_and_noise_have_no_spikes(seed):
    rng = np.random.default_rng(seed)
    slips = slipping_samples(40, rng)
    for sound in (recording(slips), session(slips[:6], rng), load_recording(SESSION)):
        assert not any('within one sample' in hint for hint in hints(sound, SETTINGS))


def test_one_spike_among_many_samples_is_found():
    rng = np.random.default_rng(1)
    sound = session(slipping_samples(6, rng), rng)
    spiked = sound.tension_l.copy()
    spiked[100] += 12.0
    (hint,) = hints(dataclasses.replace(sound, tension_l=spiked), SETTINGS)
    assert 'tension_l goes from' in hint


def test_milliseconds_at_1_khz_that_are_taken_for_seconds_are_said():
    values = {'tension_l': np.ones(50), 'tension_s': np.full(50, 1.5)}
    (hint,) = hints(Recording(**values, time=np.arange(50.0)), SETTINGS)
    assert hint.startswith('there are 1 s from one sample to the next, longer than input_timeout')
    assert '--units time=ms' in hint
    patient = dataclasses.replace(SETTINGS, input_timeout=2.0)
    assert hints(Recording(**values, time=np.arange(50.0)), patient) == []


def test_cables_that_are_said_to_be_strong_may_pull_hard():
    strong = CableScale(max_tension=30.0)
    settings = dataclasses.replace(SETTINGS, cable_l=strong, cable_s=strong)
    assert hints(Recording(10.0 * ONES, 15.0 * ONES), settings) == []


@pytest.mark.parametrize('width', [2, 3, 8])
def test_a_spike_of_several_samples_is_found_if_it_is_brief(width):
    tension = np.full(100, 1.5)
    tension[40 : 40 + width] = 4.0 + 0.1 * np.arange(width) % 0.3
    for time, is_spike in (
        (None, width <= 3),
        (0.01 * np.arange(100.0), True),
        (0.1 * np.arange(100.0), False),  # a pull that may be meant
    ):
        found = hints(Recording(np.ones(100), tension, time=time), SETTINGS)
        assert len(found) == is_spike
        if is_spike:
            assert f'tension_s goes from 1.5 N to 4 N and back within {width} samples' in found[0]


@pytest.mark.parametrize('width', [1, 3])
def test_a_spike_at_the_very_beginning_is_found(width):
    tension = np.full(100, 1.5)
    tension[:width] = 4.194
    (hint,) = hints(Recording(np.ones(100), tension), SETTINGS)
    assert 'tension_s goes from 1.5 N to 4.194 N and back' in hint


@pytest.mark.parametrize('stddev', [0.001, 0.005, 0.02, 0.05])
def test_noise_that_is_said_to_be_far_too_small_is_doubted(stddev):
    rng = np.random.default_rng(4)
    time = 0.01 * np.arange(400.0)
    ramp = 1.5 + 0.5 * np.sin(time)
    noisy = [values + rng.normal(0.0, 0.02, 400) for values in (ramp, np.ones(400))]
    found = hints(
        Recording(*noisy, time=time), dataclasses.replace(SETTINGS, tension_stddev=stddev)
    )
    assert len(found) == (stddev < 0.02 / 3.0)
    if found:
        assert 'the tensions scatter by about 0.02' in found[0]
        assert f'tension_stddev is {stddev:g} N' in found[0]


@pytest.mark.parametrize('seed', range(5))
def test_of_slips_and_sessions_no_noise_is_doubted(seed):
    rng = np.random.default_rng(seed)
    slips = slipping_samples(40, rng)
    for sound in (recording(slips), session(slips[:6], rng), load_recording(SESSION)):
        assert not any('scatter' in hint for hint in hints(sound, SETTINGS))


def test_the_noise_that_an_option_says_counts(tmp_path):
    rng, path = np.random.default_rng(5), tmp_path / 'run.csv'
    rows = ''.join(f'{0.01 * i},{1 + rng.normal(0, 0.02)},1.5\n' for i in range(50))
    path.write_text(f'time,tension_l,tension_s\n{rows}')
    asked = ('replay', path, '--estimation', 'filtering', '--tension-stddev')
    assert 'tension_stddev is 0.001 N' in run(*asked, 0.001).stdout
    assert 'scatter' not in run(*asked, 0.02).stdout


@pytest.mark.parametrize('verb', ['replay', 'track', 'report'])
def test_a_largest_tension_that_does_not_fit_the_unit_is_said_once_as_the_node_does(
    tmp_path, verb
):
    path, output = tmp_path / 'run.csv', tmp_path / 'out.html'
    path.write_text('time,tension_l,tension_s,bend_angle\n0,1,1.5,0.1\n0.1,1,1.5,0.1\n')
    unit = tmp_path / 'unit.yaml'
    text = default_design_path().read_text(encoding='utf-8')
    asked = (verb, path, *(('--output', output) if verb == 'report' else ()))
    for limit, warned, told in (('', 0, 1), ('cable_l.max_tension: 500.0', 1, 0)):
        unit.write_text(text.replace('    design:', f'    {limit}\n    design:'))
        done = run(*asked, '--design', unit)
        said = done.stdout + done.stderr + (output.read_text() if verb == 'report' else '')
        assert said.count('times the weight of the unit: a wrong reading') == warned
        assert said.count('tensions up to 1000 N are believed, as no max_tension is') == told
