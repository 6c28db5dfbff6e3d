"""The live page in a real browser, fed by real nodes."""

import math
import signal
import time
from contextlib import ExitStack

import numpy as np
import pytest
from forked_programs import ForkedProgram
from live_page import LivePage, forwarded, view_url
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from ros_domain import free_domain, in_domain
from ros_programs import spinning, wait_for
from std_msgs.msg import String

from tendon_statics import default_design_path, load_design, solve
from tendon_statics.files.installed_files import installed_config
from tendon_statics.physics import paper
from tendon_statics.physics.batch import REGIME_CODES
from tendon_statics.view.history import LONGEST_BAND

DESIGN = load_design(default_design_path())
PUBLISHED = (paper.TENSION_L, paper.TENSION_S)
HELD = (1.0, 1.5)
FILES = {'left': PUBLISHED, 'right': HELD}


class Rig:
    """Two estimators, `/left` at the published tensions and `/right` at such as hold the unit."""

    def __init__(self, folder, stack):
        self.folder = folder
        self.node = stack.enter_context(spinning(lambda context: Node('looker', context=context)))
        design = str(installed_config('preliminary_design.yaml'))
        for joint in FILES:
            stack.enter_context(self.running(joint, 'estimator', '--params-file', design))
            stack.enter_context(self.driving(joint))
        self.view = stack.enter_context(self.running('', 'view', '-p', 'port:=0'))
        self.url = view_url(self.view)
        self._page = None

    def page(self, browser):
        """One page for all tests that need no more, opened where there is none."""
        self._page = self._page or LivePage(browser, self.url)
        return self._page

    def close_page(self):
        if self._page is not None:
            self._page.close()
            self._page = None

    def running(self, namespace, name, *arguments):
        moved = ('-r', f'__ns:=/{namespace}') if namespace else ()
        return ForkedProgram.running(name, '--ros-args', *moved, *arguments)

    def driving(self, joint, rate=50.0, tensions=None):
        path = self.folder / f'{joint}.csv'
        pair = tensions or FILES[joint]
        path.write_text(f'tension_l,tension_s\n{pair[0]},{pair[1]}\n')
        return self.running(joint, 'pulley_driver', '-p', f'file:={path}', '-p', f'rate:={rate}')

    def listeners(self, joint='left'):
        """How many listen to the estimates of a joint."""
        return self.node.count_subscribers(f'/{joint}/estimator/estimate')


@pytest.fixture(scope='module')
def running_rig(tmp_path_factory):
    with free_domain() as domain, in_domain(domain), ExitStack() as stack:
        rig = Rig(tmp_path_factory.mktemp('rig'), stack)
        yield rig
        said = rig.view.output()
        assert not any(word in said for word in ('WARN', 'ERROR', 'Traceback')), said


@pytest.fixture
def rig(running_rig):
    """The rig, and nobody who looks at it any more."""
    running_rig.close_page()
    wait_for('the pages before to be gone', lambda: running_rig.listeners() == 0)
    return running_rig


@pytest.fixture
def page(running_rig, browser):
    """A page that others may have had before."""
    return running_rig.page(browser)


def look_at(page, joint):
    """Choose an estimator and wait until it is drawn."""
    page.choose(f'/{joint}/estimator')
    page.wait(f'model("present").data.tension_s[0] == {FILES[joint][1]}')


def test_the_page_shows_the_unit_at_its_angle_with_what_friction_allows(page):
    look_at(page, 'left')
    page.wait('model("body").data.angle.length == 1')
    answer = solve(DESIGN, *PUBLISHED)
    assert page.data('body')['angle'] == pytest.approx([-answer.bend_angle])
    arcs = page.data('arcs')
    quarter = 0.5 * math.pi
    band = [
        (quarter - end, quarter - start)
        for start, end in zip(arcs['start'], arcs['end'], strict=True)
    ]
    assert np.array(band[:-1]) == pytest.approx(np.array(answer.admissible_angles))
    low, high = band[-1]
    assert low < answer.bend_angle < high
    page.wait_for_words('equilibrium', '17.14°', '405.6 Pa', 'slides on to the stop')


def test_what_is_not_determined_is_not_drawn(page):
    look_at(page, 'right')
    page.wait_for_words('held', 'the tensions alone do not tell')
    page.wait('model("arcs").data.start.length > 0')
    assert page.data('body')['angle'] == []
    assert len(page.data('arcs')['start']) == len(solve(DESIGN, *HELD).admissible_angles)


def test_the_map_is_that_of_the_solver_with_the_present_pair_on_it(page):
    look_at(page, 'left')
    page.wait('model("regimes").data.end.length == 1')
    assert page.data('present') == {'tension_l': [PUBLISHED[0]], 'tension_s': [PUBLISHED[1]]}
    (end,) = page.data('regimes')['end']
    assert end > max(PUBLISHED)
    codes = page.tab.evaluate('[...Bokeh.documents[0].get_model_by_name("regimes").data.codes[0]]')
    codes = np.array(codes).reshape(100, 100)
    for row, column in ((5, 60), (60, 5), (50, 60), (99, 40), (20, 90)):
        pair = [(place + 0.5) * end / 100 for place in (column, row)]
        assert codes[row, column] == REGIME_CODES[solve(DESIGN, *pair).regime]


def test_the_last_minute_moves_on(page):
    look_at(page, 'left')
    page.wait('model("history").data.time.length > 5')
    before = page.get('angle', 'x_range.end')
    page.wait(f'model("angle").x_range.end > {before}')
    history = page.data('history')
    assert all(np.diff(history['time']) > 0.0)
    time = np.array(history['time'])
    before = np.maximum(time[:-1], time[1:] - 1e3 * LONGEST_BAND)
    assert history['before'][1:] == pytest.approx(before, abs=1.0)
    answer = solve(DESIGN, *PUBLISHED)
    assert history['angle'][-1] == pytest.approx(math.degrees(answer.bend_angle))
    assert history['pressure'][-1] == pytest.approx(answer.pressure)
    assert history['slip_margin'][-1] == pytest.approx(answer.slip_margin)
    low, high = answer.admissible_angles[0]
    assert history['admissible_low_0'][-1] == pytest.approx(math.degrees(low))
    assert history['admissible_high_0'][-1] == pytest.approx(math.degrees(high))


def test_another_estimator_is_chosen_in_the_drop_down(page, running_rig):
    look_at(page, 'left')
    page.wait_for_words('17.14°')
    look_at(page, 'right')
    page.wait_for_words('the tensions alone do not tell')
    assert set(page.data('history')['tension_s']) == {1.5}
    wait_for('the first to be left', lambda: running_rig.listeners('left') == 0)


def test_diagnostics_are_said_in_words(page):
    look_at(page, 'right')
    page.wait_for_words('WARN', 'held, so that tensions do not determine the angle')
    page.wait_for_words('rate [Hz]')


def test_nothing_comes_from_elsewhere(page):
    page.wait('model("estimator").options.length == 2')
    assert page.requests
    assert all(address.startswith('http://127.0.0.1:') for address in page.requests)
    assert page.errors == []


def test_a_page_is_paused_and_goes_on_with_what_came_meanwhile(rig, browser):
    with LivePage(browser, rig.url) as page:
        page.choose('/left/estimator')
        page.wait('model("history").data.time.length > 5')
        page.press('Pause')
        page.tab.get_by_role('button', name='Resume').wait_for()
        page.wait('model("pause").label == "Resume"')
        paused = page.data('history')['time']
        # As many messages as a second page takes to draw that much.
        with LivePage(browser, rig.url) as other:
            other.choose('/left/estimator')
            other.wait('model("history").data.time.length > 20')
        assert page.data('history')['time'] == paused
        page.press('Resume')
        page.wait(f'model("history").data.time.length > {len(paused) + 20}')
        assert page.data('history')['time'][: len(paused)] == paused


def test_the_page_works_at_a_forwarded_port_of_another_number(rig, browser):
    with forwarded(rig.url) as url:
        assert url.split(':')[-1] != rig.url.split(':')[-1]
        with LivePage(browser, url) as page:
            page.wait('model("history").data.time.length > 5')


def test_a_filtering_estimator_is_shown_with_the_probability_of_each_regime(rig, browser):
    with (
        rig.running('fourth', 'estimator', '-p', 'estimation:=filtering'),
        rig.driving('fourth', tensions=HELD),
        LivePage(browser, rig.url) as page,
    ):
        page.wait('model("estimator").options.includes("/fourth/estimator")')
        page.choose('/fourth/estimator')
        # Not what it drew at first, of another estimator.
        page.wait(f'model("present").data.tension_s[0] == {HELD[1]}')
        page.wait('model("probabilities").visible && model("bars").data.probability.length == 5')
        assert page.get('probabilities', 'visible')
        assert sum(page.data('bars')['probability']) == pytest.approx(1.0, abs=0.01)
        page.wait_for_words('held', 'may revise it')
        page.wait('model("body").data.angle.length == 1')


def test_the_page_fits_a_phone(rig, browser):
    with LivePage(browser, rig.url, viewport={'width': 390, 'height': 800}) as page:
        page.wait('model("history").data.time.length > 5')
        assert page.tab.evaluate('document.documentElement.scrollWidth') <= 390


def test_no_more_than_twenty_drawings_come_in_a_second_at_500_hz(rig, browser):
    begin = time.monotonic()
    with rig.driving('left', rate=450.0), LivePage(browser, rig.url) as page:
        look_at(page, 'left')
        # None came before it began, so that they are no more than were drawn, however late they
        # are; and so many that without a limit they would have come in a second.
        page.wait_for_drawings(100)
        assert page.drawings.streamed <= 20.0 * (time.monotonic() - begin) + 1


def test_a_closed_tab_leaves_nobody_who_listens(rig, browser):
    with LivePage(browser, rig.url) as page:
        page.choose('/left/estimator')
        wait_for('the page to listen', lambda: rig.listeners() == 1)
    wait_for('nobody to listen', lambda: rig.listeners() == 0)
    wait_for(
        'no subscription to be left',
        lambda: rig.node.get_subscriber_names_and_types_by_node('view', '/') == [],
    )


def test_two_pages_at_one_estimator_listen_once(rig, browser):
    with LivePage(browser, rig.url) as page:
        with LivePage(browser, rig.url) as other:
            for one in (page, other):
                one.choose('/left/estimator')
                one.wait_for_words('17.14°')
            wait_for('the view to listen', lambda: rig.listeners() == 1)
            for one in (page, other):
                wait_for_more(one)
            assert rig.listeners() == 1
        wait_for_more(page)
        assert rig.listeners() == 1


def wait_for_more(page):
    """Wait until a page has drawn some more, by which time what has gone is known to be gone."""
    page.wait_for_drawings(page.drawings.streamed + 20)


def test_invalid_and_stale_input_is_said(rig, browser):
    with rig.running('third', 'estimator'), LivePage(browser, rig.url) as page:
        page.wait('model("estimator").options.includes("/third/estimator")')
        page.choose('/third/estimator')
        page.wait_for_words('has sent no estimate yet')
        with rig.driving('third', tensions=PUBLISHED):
            page.wait_for_words('17.14°')
        page.wait_for_words('No valid tensions come any more', 'STALE')


def test_a_page_that_is_opened_later_hears_what_holds(rig, browser):
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    said = []
    with rig.running('fifth', 'estimator'):
        rig.node.create_subscription(
            String, '/fifth/estimator/regime', lambda message: said.append(message.data), latched
        )
        with rig.driving('fifth', tensions=PUBLISHED):
            wait_for('the estimator to have tensions', lambda: 'equilibrium' in said)
        wait_for('the estimator to miss them', lambda: said[-1] == 'stale')
        with LivePage(browser, rig.url) as page:
            page.wait('model("estimator").options.includes("/fifth/estimator")')
            page.choose('/fifth/estimator')
            page.wait_for_words('No valid tensions come any more', 'No estimate has come')


def test_a_regime_that_nobody_keeps_is_heard_too(rig, browser):
    volatile = ('-p', 'qos_overrides./sixth/estimator/regime.publisher.durability:=volatile')
    with rig.running('sixth', 'estimator', *volatile), LivePage(browser, rig.url) as page:
        page.wait('model("estimator").options.includes("/sixth/estimator")')
        page.choose('/sixth/estimator')
        page.wait_for_words('has sent no estimate yet')
        with rig.driving('sixth', tensions=PUBLISHED):
            page.wait_for_words('17.14°')
        page.wait_for_words('No valid tensions come any more')


def test_the_view_ends_by_a_signal_and_the_page_says_so(rig, browser):
    with rig.running('', 'view', '-p', 'port:=0', '-r', '__node:=other_view') as view:
        with LivePage(browser, view_url(view)) as page:
            page.wait('model("history").data.time.length > 5')
            assert not page.tab.get_by_role('alert').is_visible()
            assert view.end(signal.SIGTERM) == 0
            page.tab.get_by_role('alert').wait_for()
            assert 'Traceback' not in view.output()
        wait_for('nobody to listen', lambda: rig.listeners() == 0)
