"""The live page of an arm in a real browser, fed by a real node."""

from contextlib import ExitStack

import numpy as np
import pytest
from forked_programs import ForkedProgram
from live_page import LivePage, view_url
from ros_domain import free_domain, in_domain

from tendon_statics import ArmTracker, load_arm
from tendon_statics.files.installed_files import installed_config
from tendon_statics.physics.arm.shape import joint_centres

FILE = installed_config('arm.yaml')
ARM = load_arm(FILE)
TENSIONS = {'l_mid': 1.0, 's_mid': 1.0, 'l_tip': 1.0, 's_tip': 1.6}
REACH = sum(unit.length for unit in ARM.units)


@pytest.fixture(scope='module')
def played(tmp_path_factory):
    """A file of tensions that bend the arm and hold it there."""
    path = tmp_path_factory.mktemp('arm') / 'tensions.csv'
    lines = (','.join(map(str, row)) for row in (TENSIONS, TENSIONS.values()))
    path.write_text('\n'.join(lines) + '\n')
    return path


def driving(played, namespace='/'):
    # The arm's driver takes its cables from the arm's file.
    given = ('-p', f'arm_file:={FILE}', '-p', f'file:={played}', '-p', 'rate:=20.0')
    return ForkedProgram.running('pulley_driver', '--ros-args', '-r', f'__ns:={namespace}', *given)


@pytest.fixture(scope='module')
def url(played):
    """Of a page of an arm's estimator, and of a unit's beside it."""
    with free_domain() as domain, in_domain(domain), ExitStack() as stack:
        of_arm = ('--ros-args', '-p', f'arm_file:={FILE}', '-p', 'tension_stddev:=0.01')
        for program in (
            ForkedProgram.running('arm_estimator', *of_arm),
            driving(played),
            ForkedProgram.running('estimator', '--ros-args', '-r', '__ns:=/unit'),
            ForkedProgram.running('pulley_driver', '--ros-args', '-r', '__ns:=/unit'),
        ):
            stack.enter_context(program)
        view = stack.enter_context(ForkedProgram.running('view', '--ros-args', '-p', 'port:=0'))
        yield view_url(view)
        said = view.output()
        assert not any(word in said for word in ('WARN', 'ERROR', 'Traceback')), said


@pytest.fixture(scope='module')
def page(url, browser):
    with LivePage(browser, url) as page:
        yield page


def look_at(page, name):
    page.wait(f'model("estimator").options.includes("{name}")')
    page.choose(name)


@pytest.fixture
def arm_page(page):
    look_at(page, '/arm_estimator')
    page.wait('model("arm_history")?.data.time.length > 3')
    page.wait('model("drawn_units").data.x0.length > 0')
    return page


def test_the_arm_is_drawn_where_it_is(arm_page):
    state = ArmTracker(ARM).update(TENSIONS)
    centres = np.array(joint_centres(ARM, state.bend_angles)) / REACH
    units = arm_page.data('drawn_units')
    starts = np.column_stack([units['x0'], units['z0']])
    ends = np.column_stack([units['x1'], units['z1']])
    assert starts == pytest.approx(centres[:-1])
    assert ends == pytest.approx(centres[1:])
    assert centres[-1, 0] > 0.05  # or it would prove little


def test_where_friction_can_hold_each_joint_is_drawn_and_said(arm_page):
    state = ArmTracker(ARM).update(TENSIONS)
    bands = [of.admissible_angles for of in state.joints]
    assert all(bands)
    arm_page.wait('model("drawn_bands").data.start.length > 0')
    drawn, tilt, expected = arm_page.data('drawn_bands'), 0.0, []
    for of_joint, angle in zip(bands, state.bend_angles, strict=True):
        expected += [0.5 * np.pi - tilt - low for low, _ in of_joint]
        tilt += angle
    assert drawn['end'] == pytest.approx(expected)
    for low, high in np.degrees(np.concatenate(bands)):
        arm_page.wait_for_words(f'{low:.1f} to {high:.1f}°')


def test_joints_and_tip_are_said_in_words(arm_page):
    state = ArmTracker(ARM).update(TENSIONS)
    arm_page.wait_for_words('arm_joint_1', 'arm_joint_5', f'{1e3 * state.tip.x:.2f} mm')
    for angle in np.degrees(state.bend_angles):
        arm_page.wait_for_words(f'{angle:.2f}°')
    arm_page.wait_for_words('tension s_tip', 'rate [Hz]')


def test_each_joint_has_its_last_minute(arm_page):
    state, history = ArmTracker(ARM).update(TENSIONS), arm_page.data('arm_history')
    newest = [history[f'angle_{place}'][-1] for place in range(len(ARM.units))]
    assert newest == pytest.approx(np.degrees(state.bend_angles))
    margins = [history[f'slip_margin_{place}'][-1] for place in range(len(ARM.units))]
    assert margins == pytest.approx(state.slip_margins)
    assert history['tip_z'][-1] == pytest.approx(1e3 * state.tip.z)
    assert arm_page.get('arm_angle', 'renderers.length') == 2 * len(ARM.units)


def test_a_page_shows_what_is_of_an_arm_or_of_a_unit(arm_page):
    page = arm_page
    of_arm, of_unit = (
        page.tab.get_by_role('heading', name=name) for name in ('The arm', 'The unit')
    )
    of_arm.wait_for()
    assert not of_unit.is_visible()
    look_at(page, '/unit/estimator')
    of_unit.wait_for()
    assert not of_arm.is_visible()
    page.wait('model("history").data.time.length > 3')
    page.wait('model("arm_angle").renderers.length === 0')
    assert page.errors == []


def test_an_arm_fits_a_phone(url, browser):
    with LivePage(browser, url, viewport={'width': 390, 'height': 800}) as page:
        # It is the first in the list, so that nobody has to choose it.
        page.tab.get_by_role('heading', name='The arm').wait_for()
        page.wait_for_words('arm_joint_5')
        assert page.tab.evaluate('document.documentElement.scrollWidth') <= 390


def test_an_arm_without_tensions_is_stale_also_for_who_comes_later(url, browser, played):
    named = ('-r', '__ns:=/other', '-p', f'arm_file:={FILE}')
    with ForkedProgram.running('arm_estimator', '--ros-args', *named):
        with driving(played, '/other'), LivePage(browser, url) as page:
            look_at(page, '/other/arm_estimator')
            page.wait_for_words('arm_joint_5')
        for _ in range(2):
            with LivePage(browser, url) as page:
                look_at(page, '/other/arm_estimator')
                page.wait_for_words('No valid tensions come any more')
