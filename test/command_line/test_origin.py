"""A report says what it was made from, so that it can be made again."""

import hashlib
import re
import shutil
from html import unescape
from importlib.metadata import version

import numpy as np
import pytest
from programs import run

from tendon_statics import default_design_path
from tendon_statics.command_line.origin import files_of, recorded_on, sha256
from tendon_statics.files.installed_files import installed_config
from tendon_statics.recordings.recording import Recording

SESSION = installed_config('recorded_session.mcap')


def origin(page):
    section = page[page.index('How to make it again') :]
    rows = re.findall(r'<tr><th[^>]*>(.*?)</th><td[^>]*>(.*?)</td></tr>', section, re.DOTALL)
    return {unescape(name): unescape(value) for name, value in rows}


def test_a_report_names_command_version_checksums_and_options(tmp_path):
    design, output = tmp_path / 'my unit.yaml', tmp_path / 'page.html'
    shutil.copy(default_design_path(), design)
    done = run('report', SESSION, '--design', design, '--motion-step-deg', 3, '--output', output)
    assert done.returncode == 0, done.stderr
    facts = origin(output.read_text(encoding='utf-8'))
    assert facts['command'] == (
        f"tendon-statics report {SESSION} --design '{design}' --motion-step-deg 3 "
        f'--output {output}'
    )
    assert version('tendon_statics') in facts['version']
    for path in (SESSION, design):
        expected = hashlib.sha256(path.read_bytes()).hexdigest()
        assert facts[f'SHA-256 of {path.name}'] == expected
    options = facts['options'].split(', ')
    assert 'motion_step_deg = 3.0' in options
    assert 'all_slipping = False' in options  # one that was not given
    assert 'no seed' in facts['random numbers']


@pytest.mark.parametrize('origin_and_time', [(1_700_000_000_123_456_789, 2.0), (0, 1_000.0)])
def test_a_recording_is_dated_by_its_first_sample_if_it_has_a_date(origin_and_time):
    nanoseconds, first = origin_and_time
    recording = Recording(
        np.array([1.0, 1.0]),
        np.array([2.0, 2.0]),
        time=np.array([first, first + 1.0]),
        time_origin=nanoseconds,
    )
    expected = '2023-11-14 22:13:22 UTC' if nanoseconds else 'not known'
    assert recorded_on(recording).startswith(expected)


def test_every_file_of_a_folder_has_a_checksum(tmp_path):
    (tmp_path / 'bag').mkdir()
    for name in ('metadata.yaml', 'bag_0.mcap', 'bag_1.mcap'):
        (tmp_path / 'bag' / name).write_text(name)
    files = files_of(tmp_path / 'bag')
    assert [file.name for file in files] == ['bag_0.mcap', 'bag_1.mcap', 'metadata.yaml']
    assert sha256(files[0]) == hashlib.sha256(b'bag_0.mcap').hexdigest()
