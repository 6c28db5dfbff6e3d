"""What a newcomer sees of `make demo`."""

import re
import subprocess
import sys

from make_docs import ROOT
from ros_programs import TIME_LIMIT, Program  # noqa: F401  which marks it as one of the node

from tendon_statics import load_arm
from tendon_statics.recordings.reading.load import load_arm_recording

ARM = load_arm(ROOT / 'config/arm.yaml')


def test_the_demo_shows_a_sound_session_every_regime_and_what_to_do_next():
    done = subprocess.run(
        [sys.executable, ROOT / 'tools' / 'demo.py'],
        capture_output=True,
        text=True,
        timeout=5.0 * TIME_LIMIT,
    )
    assert done.returncode == 0, done.stderr
    printed = done.stdout
    assert printed.startswith('\n== starting the estimator')
    sound, rest = printed.split('/diagnostics: ')
    for regime in ('held', 'slack', 'invalid'):
        assert regime not in sound
        assert regime in rest
    assert rest.startswith('OK, ')
    assert 'equilibrium, 17.14 deg ± 7.04, 405.6 Pa' in rest
    assert 'SIGINT' not in printed
    assert '2 publishers' not in printed
    named = re.findall(r'(?:tools|docs)/\S+', printed[printed.index('What next') :])
    assert named
    assert all((ROOT / name).is_file() for name in named)


def test_the_demo_of_an_arm_shows_its_joints_and_tip_through_the_drive_cycle():
    done = subprocess.run(
        [sys.executable, ROOT / 'tools' / 'demo_arm.py'],
        capture_output=True,
        text=True,
        timeout=5.0 * TIME_LIMIT,
    )
    assert done.returncode == 0, done.stderr
    rows = [line.split('|') for line in done.stdout.splitlines() if line.startswith('|')][2:]
    tips = [float(row[-4]) for row in rows]
    assert len(rows) > 10
    assert max(tips) > 60.0
    assert min(tips) < -60.0
    played = len(load_arm_recording(ROOT / 'config/arm_tensions.csv', ARM).tensions())
    assert f'Each of the {played} answers is what ArmTracker says of the same' in done.stdout
    named = re.findall(r'(?:tools|docs)/\S+', done.stdout[done.stdout.index('What next') :])
    assert named
    assert all((ROOT / name).is_file() for name in named)
