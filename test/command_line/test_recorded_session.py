"""The recording that travels with the project: read, calibrated, replayed, drawn and reported."""

import json
import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser

import numpy as np
import pytest
from programs import assert_refused, run
from record_session import (
    BEND_ANGLE_STDDEV,
    OUTPUT,
    PLAN,
    PRESSURE_STDDEV,
    RATE,
    TENSION_STDDEV,
    UNIT,
    session,
)

from tendon_statics import calibrate, default_design_path, load_design, load_recording
from tendon_statics.physics.calibration import DEFAULT_FIT
from tendon_statics.recordings.motion import mark_motion

STATES = ('--motion-step-deg', '3')


@pytest.fixture(scope='module')
def recording():
    return load_recording(OUTPUT).whole()


def test_it_holds_the_session_that_the_tool_plays(recording):
    rows = np.array(session())
    assert len(recording) == len(rows)
    measured = np.array(recording.tensions())
    taut = rows.min(axis=1) > 0.2
    assert abs(measured[taut] - rows[taut]).max() < 6.0 * TENSION_STDDEV
    assert 1.0 / np.median(np.diff(recording.time)) == pytest.approx(RATE, rel=0.05)
    assert np.isfinite(recording.bend_angle).mean() > 0.99
    assert np.isfinite(recording.pressure[taut]).mean() > 0.9


def test_its_calibration_finds_the_unit_that_was_recorded(recording):
    fitted = calibrate(
        load_design(default_design_path()),
        mark_motion(recording, 0.05),
        bend_angle_stddev=BEND_ANGLE_STDDEV,
        pressure_stddev=PRESSURE_STDDEV,
    )
    assert fitted.counts['slipping'] == len(PLAN)
    assert fitted.warnings == ()
    for name, parameter in zip(DEFAULT_FIT, fitted.parameters, strict=True):
        truth = getattr(UNIT, name)
        assert abs(parameter.value - truth) < 3.0 * parameter.standard_error
        assert parameter.standard_error < 0.15 * truth


def test_its_replay_tracks_what_was_recorded(tmp_path):
    fitted = tmp_path / 'fitted.yaml'
    run('calibrate', OUTPUT, *STATES, '--output', fitted)
    done = run('replay', OUTPUT, '--design', fitted, '--estimation', 'tracking')
    assert (done.returncode, done.stderr) == (0, '')
    error = re.search(r'median ([\d.]+) deg', done.stdout)
    assert float(error[1]) < 1.0
    assert '20.0' in done.stdout


@pytest.mark.parametrize(
    'arguments',
    [
        ('recording',),
        ('recording', '--estimation', 'tracking'),
        ('calibration', *STATES),
        ('calibration', '--fit', 'mass,gravity', *STATES),
    ],
)
def test_it_can_be_drawn(tmp_path, arguments):
    figure, *options = arguments
    output = tmp_path / 'figure.svg'
    done = run('plot', figure, OUTPUT, *options, '--output', output)
    assert done.returncode == 0
    (slack,) = done.stderr.splitlines()
    assert 'a cable counts as slack up to 0.03 N' in slack
    assert ET.parse(output).getroot().tag.endswith('svg')


class _Page(HTMLParser):
    """Collects what a page asks for from elsewhere, and its text."""

    def __init__(self) -> None:
        super().__init__()
        self.links: list[str] = []
        self.tags: list[str] = []
        self.text = ''

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        for name, value in attributes:
            if name in ('src', 'href', 'xlink:href', 'data'):
                self.links.append(value)

    def handle_data(self, data):
        self.text += data


def test_its_report_is_one_file_that_asks_for_nothing(tmp_path):
    output = tmp_path / 'report.html'
    done = run('report', OUTPUT, *STATES, '--output', output)
    assert (done.returncode, done.stdout, done.stderr) == (0, f'wrote {output}\n', '')
    page = _Page()
    page.feed(output.read_text(encoding='utf-8'))
    assert all(link.startswith(('#', 'data:')) for link in page.links)
    assert not {'script', 'link', 'img', 'iframe'} & set(page.tags)
    assert '@import' not in page.text
    assert 'url(http' not in page.text
    assert page.tags.count('svg') == 2
    values = json.loads(run('calibrate', OUTPUT, *STATES, '--format', 'json').stdout)
    for parameter in values['parameters']:
        assert f'{parameter["value"]:.6g}' in page.text
    assert 'Recorded session recorded_session.mcap' in page.text


def test_a_report_of_what_cannot_be_fitted_says_why(tmp_path):
    data, output = tmp_path / 'a<b>.csv', tmp_path / 'report.html'
    data.write_text('tension_l,tension_s\n1,2\n1,1.5\nx\n')
    done = run('report', data, '--output', output)
    assert done.returncode == 1
    assert 'line 4' in done.stderr
    page = _Page()
    page.feed(output.read_text(encoding='utf-8'))
    assert 'Nothing could be fitted: there is no measured bend angle' in page.text
    assert 'Recorded session a<b>.csv' in page.text
    assert 'Not all of it could be read: line 4' in page.text
    assert 'not all of it could be read: line 4' in run('calibrate', data).stderr


def test_a_report_in_which_nothing_is_determined_says_no_more_than_that(tmp_path):
    data = tmp_path / 'counts.csv'
    data.write_text('tension_l,tension_s\n10213,15233\n10213,15333\n')
    done = run('report', data, '--output', tmp_path / 'report.html')
    assert done.returncode == 0
    assert done.stderr.count('\n') == 1, done.stderr


@pytest.mark.parametrize(
    ('arguments', 'named'),
    [
        (['plot', 'recording', 'missing.csv', '--output', 'f.svg'], 'missing.csv'),
        (['plot', 'recording', str(OUTPUT), '--output', 'f.doc'], 'f.doc'),
        (
            ['plot', 'calibration', str(OUTPUT), *STATES, '--fit', 'x', '--output', 'f.svg'],
            "'x', which",
        ),
        (['plot', 'map', '--points', '0', '--output', 'f.svg'], '--points is 0'),
        (['plot', 'map', '--quantity', 'mass', '--output', 'f.svg'], 'mass'),
        (['report', str(OUTPUT), '--output', 'report.pdf'], 'ending in .html'),
        (['report', str(OUTPUT), '--output', '/no/such/folder/r.html'], 'cannot be written'),
        (['report', 'missing.csv', '--output', 'r.html'], 'missing.csv'),
        (['replay', str(OUTPUT), '--tensions-topic', 't'], 'there is no topic /t; there are'),
    ],
)
def test_an_error_is_one_line(arguments, named):
    assert_refused(run(*arguments), named)
