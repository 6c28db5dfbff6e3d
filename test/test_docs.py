"""The documentation says what the program prints and what the node has."""

import re
from xml.etree import ElementTree

import pytest
import yaml
from make_docs import FIGURES, PAGES, ROOT, made

import tendon_statics

WRITTEN = ['README.md', 'CONTRIBUTING.md']
ALL = sorted(p.relative_to(ROOT) for p in ROOT.glob('docs/**/*.md')) + WRITTEN
REFERENCE = (ROOT / 'docs/node_reference.md').read_text(encoding='utf-8')


@pytest.mark.parametrize('page', PAGES)
def test_tables_are_what_the_program_prints(page):
    text = (ROOT / page).read_text(encoding='utf-8')
    assert '<!-- made by: ' in text
    assert made(text) == text, 'run `make docs`'


@pytest.mark.parametrize('page', ALL)
def test_links_to_files_lead_somewhere(page):
    path = ROOT / page
    for target in re.findall(r'\]\((?!http)([^)#]+)', path.read_text(encoding='utf-8')):
        assert (path.parent / target).exists(), target


@pytest.mark.parametrize('figure', FIGURES)
def test_figures_are_shown_somewhere(figure):
    name = figure.rsplit('/', 1)[-1]
    assert any(name in (ROOT / page).read_text(encoding='utf-8') for page in ALL)


@pytest.mark.parametrize('kind', ['estimator', 'arm_estimator'])
def test_the_reference_names_everything_a_node_has(kind):
    """Asked of the node itself: its topics, services and parameters."""
    import list_entities
    from list_entities import entities

    make = getattr(list_entities, kind)
    with make('estimation:=tracking', 'markers:=true', 'tip_force:=true') as node:
        found = entities(node)
        parameters = list(node._parameters)
    # What every managed node of ROS has.
    of_ros = re.compile(
        '.*parameter.*|.*type_description|/rosout|~/transition_event|~/change_state|~/get_.*'
    )
    for name in [name for names in found.values() for name in names]:
        if not of_ros.fullmatch(name):
            written = name if name == '/diagnostics' else name.removeprefix('/')
            assert f'`{written}`' in REFERENCE
    for name in parameters:
        if name.startswith('cables.'):
            name = f'cables.NAME.{name.rpartition(".")[2]}'
        if not name.startswith(('qos_overrides.', 'use_sim_time', 'start_type_description')):
            assert f'`{name}`' in REFERENCE, name


def test_every_public_name_is_on_one_page_of_the_api():
    pages = [path.read_text(encoding='utf-8') for path in ROOT.glob('docs/api/*.md')]
    shown = [name for page in pages for name in re.findall(r'\.\. auto\w+:: (\S+)', page)]
    assert sorted(shown) == sorted(tendon_statics.__all__)


def test_every_page_is_in_a_table_of_contents():
    index = (ROOT / 'docs/index.rst').read_text(encoding='utf-8')
    named = set(re.findall(r'^   ([\w/]+)$', index, re.MULTILINE))
    pages = {
        path.relative_to(ROOT / 'docs').with_suffix('').as_posix()
        for pattern in ('*.md', '*.rst')
        for path in ROOT.glob(f'docs/**/{pattern}')
    }
    assert named == pages - {'index'}


def test_rosdoc2_is_led_to_the_pages():
    (configuration,) = ElementTree.parse(ROOT / 'package.xml').iterfind('export/rosdoc2')
    kind, settings = yaml.safe_load_all((ROOT / configuration.text).read_text(encoding='utf-8'))
    assert kind == {'type': 'rosdoc2 config', 'version': 1}
    assert (ROOT / settings['settings']['python_source'] / '__init__.py').is_file()
    (builder,) = settings['builders']
    assert (ROOT / builder['sphinx']['sphinx_sourcedir'] / 'conf.py').is_file()
