"""The documentation says what the program prints and what the node has."""

import re

import pytest
from make_docs import FIGURES, PAGES, ROOT, made

WRITTEN = ['README.md', 'CONTRIBUTING.md']
README = (ROOT / 'README.md').read_text(encoding='utf-8')


@pytest.mark.parametrize('page', PAGES)
def test_tables_are_what_the_program_prints(page):
    text = (ROOT / page).read_text(encoding='utf-8')
    assert '<!-- made by: ' in text
    assert made(text) == text, 'run `make docs`'


@pytest.mark.parametrize('page', [p.relative_to(ROOT) for p in ROOT.glob('docs/*.md')] + WRITTEN)
def test_links_to_files_lead_somewhere(page):
    path = ROOT / page
    for target in re.findall(r'\]\((?!http)([^)#]+)', path.read_text(encoding='utf-8')):
        assert (path.parent / target).exists(), target


@pytest.mark.parametrize('figure', FIGURES)
def test_figures_are_shown_somewhere(figure):
    name = figure.rsplit('/', 1)[-1]
    assert any(name in (ROOT / page).read_text(encoding='utf-8') for page in PAGES)


def test_the_readme_names_everything_the_node_has():
    """Asked of the node itself: its topics, services and parameters."""
    from list_entities import entities, estimator

    with estimator('estimation:=tracking', 'markers:=true', 'tip_force:=true') as node:
        found = entities(node)
        parameters = list(node._parameters)
    # What every managed node of ROS has.
    of_ros = re.compile(
        '.*parameter.*|.*type_description|/rosout|~/transition_event|~/change_state|~/get_.*'
    )
    for name in [name for names in found.values() for name in names]:
        if not of_ros.fullmatch(name):
            written = name if name == '/diagnostics' else name.removeprefix('/')
            assert f'`{written}`' in README
    for name in parameters:
        if not name.startswith(('qos_overrides.', 'use_sim_time', 'start_type_description')):
            assert f'`{name}`' in README, name
