"""The documentation says what the program prints and what the node has."""

import re

import pytest
from make_docs import FIGURES, PAGES, ROOT, made

README = (ROOT / 'README.md').read_text(encoding='utf-8')


@pytest.mark.parametrize('page', PAGES)
def test_tables_are_what_the_program_prints(page):
    text = (ROOT / page).read_text(encoding='utf-8')
    assert '<!-- made by: tendon-statics ' in text
    assert made(text) == text, 'run `make docs`'


@pytest.mark.parametrize('page', PAGES)
def test_links_to_files_lead_somewhere(page):
    path = ROOT / page
    for target in re.findall(r'\]\((?!http)([^)#]+)', path.read_text(encoding='utf-8')):
        assert (path.parent / target).exists(), target


@pytest.mark.parametrize('figure', FIGURES)
def test_figures_are_shown_somewhere(figure):
    name = figure.rsplit('/', 1)[-1]
    assert any(name in (ROOT / page).read_text(encoding='utf-8') for page in PAGES)


def test_the_readme_names_everything_the_node_has():
    """Asked of the running node: its topics, services and parameters."""
    from ros_programs import Listener, spinning

    with spinning(Listener) as listener, listener.estimator('-p', 'estimation:=tracking'):
        own = '/estimator/'
        listener.wait_for_node('estimator')
        published = listener.get_publisher_names_and_types_by_node('estimator', '/')
        served = listener.get_service_names_and_types_by_node('estimator', '/')
    parameter_services = ('parameter', 'type_description')
    names = [name for name, _ in published + served if name.startswith(own)]
    for name in names:
        if not any(part in name for part in parameter_services):
            assert f'`~/{name.removeprefix(own)}`' in README, name
    assert '`measured_bend_angle`' in README
    for parameter in (
        *('tension_stddev', 'frame_id', 'qos_overrides', 'estimation', 'initial_bend_angle'),
    ):
        assert f'`{parameter}' in README
