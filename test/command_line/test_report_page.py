"""Pages of HTML in print and on a phone."""

import pytest
from programs import run

SESSION = 'config/recorded_session.mcap'


@pytest.fixture(scope='module')
def report(tmp_path_factory):
    output = tmp_path_factory.mktemp('report') / 'report.html'
    done = run('report', SESSION, '--motion-step-deg', 3, '--output', output)
    assert done.returncode == 0, done.stderr
    return output


def test_a_report_on_a_phone_is_as_wide_as_the_phone_and_its_figures_are_legible(report, browser):
    page = browser.new_page(viewport={'width': 390, 'height': 800})
    page.goto(report.as_uri())
    assert page.evaluate('document.documentElement.scrollWidth') <= 390
    widths = page.evaluate('[...document.querySelectorAll("svg")].map(one => one.clientWidth)')
    assert len(widths) == 2
    assert min(widths) > 500


def test_a_printed_report_has_one_size_of_text_and_keeps_headings_with_what_follows(
    report, browser
):
    page = browser.new_page()
    page.goto(report.as_uri())
    page.emulate_media(media='print')
    size = 'parseFloat(getComputedStyle(document.querySelector(name)).fontSize)'
    sizes = page.evaluate(f'["p", "td"].map(name => {size})')
    assert max(sizes) <= 1.2 * min(sizes)
    assert page.evaluate('getComputedStyle(document.querySelector("h2")).breakAfter') == 'avoid'
    assert page.evaluate('getComputedStyle(document.querySelector("svg")).breakInside') == 'avoid'


def test_a_report_lists_options_and_nothing_else(report):
    assert 'version = not given' not in report.read_text()
