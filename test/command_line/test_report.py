"""What a report says of a recording: how it was estimated, and what the numbers mean."""

import re
from html import unescape

import numpy as np
import pytest
from designs import PRELIMINARY
from programs import run

from tendon_statics import save_design
from tendon_statics.command_line.report_text import default_estimation
from tendon_statics.files.installed_files import installed_config
from tendon_statics.recordings.recording import Recording

SESSION = installed_config('recorded_session.mcap')
SLIPS = ('--motion-step-deg', 3)
TIMED = 'time,tension_l,tension_s,bend_angle\n0,1,1.5,0\n1,1,1.5,0\n2,1,1.6,0\n'
UNTIMED = 'tension_l,tension_s,bend_angle\n1,2,0.29\n1,1.5,0\n1,1.6,0\n'
SLIPPED = 'time,tension_l,tension_s,bend_angle\n0,1,2,0.29\n1,1,2,0.3\n2,1,2.1,0.3\n'
BACK = 'time,tension_l,tension_s,bend_angle\n2,1,1.5,0\n1,1,1.5,0\n3,1,1.6,0\n'


def reported(tmp_path, data, *options):
    """The text of a page, and its facts by their keywords."""
    path, page = tmp_path / 'run.csv', tmp_path / 'page.html'
    if isinstance(data, str):
        path.write_text(data, encoding='utf-8')
        data = path
    done = run('report', data, *options, '--output', page)
    assert done.returncode == 0, done.stderr
    text = unescape(page.read_text(encoding='utf-8'))
    return text, dict(re.findall(r'<tr><th>(.*?)</th><td>(.*?)</td></tr>', text))


@pytest.mark.parametrize(
    ('data', 'options', 'expected', 'why'),
    [
        (TIMED, (), 'tracking', 'since samples have times; filtering also needs the noise'),
        (TIMED, ('--tension-stddev', 0.01), 'filtering', 'since samples have times and the noise'),
        (UNTIMED, ('--tension-stddev', 0.01), 'equilibrium', 'since samples have no times'),
        (BACK, ('--tension-stddev', 0.01), 'equilibrium', 'since times go back'),
    ],
)
def test_it_remembers_and_filters_where_the_recording_allows(
    tmp_path, data, options, expected, why
):
    text, facts = reported(tmp_path, data, *options)
    assert facts['estimation'] == expected
    assert f'Estimation is {expected}, {why}' in text


@pytest.mark.parametrize('said_by', ['option', 'file'])
def test_it_does_as_it_is_told(tmp_path, said_by):
    design = tmp_path / 'unit.yaml'
    of_file = {'estimation': 'equilibrium'} if said_by == 'file' else {}
    save_design(design, PRELIMINARY, parameters={'tension_stddev': 0.01, **of_file})
    options = ('--estimation', 'equilibrium') if said_by == 'option' else ()
    text, facts = reported(tmp_path, TIMED, '--design', design, *options)
    assert facts['estimation'] == 'equilibrium'
    assert 'Estimation is' not in text


def test_the_noise_of_the_design_file_makes_it_filter(tmp_path):
    design = tmp_path / 'unit.yaml'
    save_design(design, PRELIMINARY, parameters={'tension_stddev': 0.02})
    text, facts = reported(tmp_path, TIMED, '--design', design)
    assert facts['estimation'] == 'filtering'
    assert 'to have noise of 0.02 N' in text


def test_samples_without_a_time_among_others_do_not_hinder_it():
    timed = Recording([1.0] * 3, [1.5] * 3, time=np.array([0.0, np.nan, 2.0]))
    assert default_estimation(timed, None)[0] == 'tracking'
    assert default_estimation(timed, 0.01)[0] == 'filtering'


@pytest.mark.parametrize(
    ('estimation', 'meaning'),
    [
        ('equilibrium', 'The unit is there only while it slips'),
        ('tracking', 'followed from 0 deg (--initial-bend-angle)'),
        ('filtering', 'measured angles outside of it say that the model'),
    ],
)
def test_it_says_what_the_error_means_and_what_it_was_fitted_to(tmp_path, estimation, meaning):
    options = ('--estimation', estimation, '--tension-stddev', 0.01)
    text, facts = reported(tmp_path, SESSION, *SLIPS, *options)
    assert 'root mean square' in facts['error']
    assert meaning in text
    assert 'no test on other data' in text
    assert 'A distance is how far a slipping sample' in text
    assert 'Freedom is how many equations' in text
    unfitted, facts = reported(tmp_path, SLIPPED, *options)
    assert 'root mean square' in facts['error']
    assert meaning in unfitted
    assert 'no test on other data' not in unfitted


def test_where_no_angle_was_measured_there_is_no_error_to_explain(tmp_path):
    text, facts = reported(tmp_path, 'time,tension_l,tension_s\n0,1,1.5\n1,1,1.5\n')
    assert facts['estimation'] == 'tracking'
    assert 'The error is' not in text
