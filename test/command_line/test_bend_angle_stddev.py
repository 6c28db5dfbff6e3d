"""How noisy a measured angle is: one option and one default, whatever the verb."""

import dataclasses
import math

import pytest
from programs import assert_refused, run

from tendon_statics import default_design_path
from tendon_statics.estimation.settings import Settings
from tendon_statics.physics.calibration.fit import calibrate
from tendon_statics.physics.deviations import BEND_ANGLE_STDDEV

SESSION = 'config/recorded_session.mcap'
FILTERED = ('{ramp}', '--estimation', 'filtering', '--tension-stddev', 0.01)
TIP = ('--tension-l', 1, '--tension-s', 1.9, '--bend-angle-deg', 5, '--direction', 1, 0)
VERBS = {
    'calibrate': (('calibrate', SESSION, '--motion-step-deg', 3), 'noise         0.01 N, {} deg'),
    'tip-force': (('tip-force', *TIP, '--distance', 0.02), 'on each tension, {} deg'),
    'replay': (('replay', *FILTERED), 'two standard deviations of the sensor, {} deg'),
}


@pytest.fixture
def ramp(tmp_path):
    """A recording that is quickly filtered."""
    path = tmp_path / 'ramp.csv'
    rows = ''.join(f'{0.01 * n},1,{1.5 + 0.001 * n},0\n' for n in range(40))
    path.write_text(f'time,tension_l,tension_s,bend_angle\n{rows}')
    return path


@pytest.mark.parametrize('verb', VERBS)
def test_option_then_file_then_one_default(tmp_path, ramp, verb):
    asked, said = VERBS[verb]
    asked = [str(word).format(ramp=ramp) for word in asked]
    path = tmp_path / 'unit.yaml'
    text = default_design_path().read_text()
    head = 'ros__parameters:\n'
    path.write_text(
        text.replace(head, f'{head}    measured_bend_angle_stddev: {math.radians(0.2)}\n')
    )
    for more, degrees in (
        ((), 0.5),
        (('--bend-angle-stddev-deg', 0.29), 0.29),
        (('--design', path), 0.2),
        (('--design', path, '--bend-angle-stddev-deg', 0.29), 0.29),
    ):
        done = run(*asked, *more)
        assert done.returncode == 0, done.stderr
        shown = f'{2.0 * degrees if verb == "replay" else degrees:.3g}'
        assert said.format(shown) in done.stdout


def test_the_report_s_share_within_the_interval_is_of_the_stated_sensor(tmp_path, ramp):
    output = tmp_path / 'out.html'
    done = run(
        *('report', ramp, '--bend-angle-stddev-deg', 0.29),
        *('--tension-stddev', 0.01, '--output', output),
    )
    assert done.returncode == 0, done.stderr
    assert 'two standard deviations of the sensor, 0.58 deg' in output.read_text()


def test_node_and_library_have_the_same_default():
    defaults = {field.name: field.default for field in dataclasses.fields(Settings)}
    assert defaults['measured_bend_angle_stddev'] == BEND_ANGLE_STDDEV
    assert calibrate.__kwdefaults__['bend_angle_stddev'] == BEND_ANGLE_STDDEV


def test_a_negative_one_is_refused():
    done = run('calibrate', SESSION, '--motion-step-deg', 3, '--bend-angle-stddev-deg', '-1')
    assert_refused(done, 'allowed is 0 or more')
