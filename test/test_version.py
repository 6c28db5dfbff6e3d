"""The version is one, wherever it is written."""

import re
from xml.etree import ElementTree

import pytest
import yaml
from make_docs import ROOT

VERSION = ElementTree.parse(ROOT / 'package.xml').findtext('version')


def test_it_is_a_version():
    assert re.fullmatch(r'\d+\.\d+\.\d+', VERSION)


@pytest.mark.parametrize(
    'path', ['setup.py', 'interfaces/package.xml', 'examples/cpp_client/package.xml']
)
def test_every_package_and_the_set_up_have_the_same(path):
    text = (ROOT / path).read_text(encoding='utf-8')
    assert re.search(rf"<version>{VERSION}</version>|version='{VERSION}'", text)


@pytest.mark.parametrize('tag', ['maintainer', 'license', 'url'])
def test_the_packages_say_the_same_of_themselves(tag):
    of_both = [
        [(element.attrib, element.text) for element in ElementTree.parse(ROOT / path).iter(tag)]
        for path in ('package.xml', 'interfaces/package.xml')
    ]
    assert of_both[0] == of_both[1]
    assert of_both[0] != [] or tag == 'url'  # As long as the project is not published it has none.


def test_no_address_is_invented():
    """None, or all that docs/releasing.md names, and none of a domain that is for examples."""
    urls = [*ElementTree.parse(ROOT / 'package.xml').iter('url')]
    assert {url.get('type') for url in urls} in (set(), {'website', 'repository', 'bugtracker'})
    assert not any(
        re.search(r'//[^/]*\b(example|invalid|test|localhost)\b', url.text) for url in urls
    )


def test_each_package_has_the_license_with_it():
    assert (ROOT / 'LICENSE').read_bytes() == (ROOT / 'interfaces' / 'LICENSE').read_bytes()


@pytest.mark.parametrize('path', ['CHANGELOG.rst', 'interfaces/CHANGELOG.rst'])
def test_changelogs_and_citation_name_it_with_one_date(path):
    changelog = (ROOT / path).read_text(encoding='utf-8')
    newest = re.search(r'^(\d+\.\d+\.\d+) \((\d{4}-\d{2}-\d{2})\)\n-+$', changelog, re.MULTILINE)
    citation = yaml.safe_load((ROOT / 'CITATION.cff').read_text(encoding='utf-8'))
    assert newest.groups() == (VERSION, citation['date-released'])
    assert citation['version'] == VERSION


def test_the_citation_has_the_papers_title_as_the_design_file_has_it():
    citation = yaml.safe_load((ROOT / 'CITATION.cff').read_text(encoding='utf-8'))
    (paper,) = citation['references']
    design = (ROOT / 'config/preliminary_design.yaml').read_text(encoding='utf-8')
    assert paper['title'] in ' '.join(design.replace('#', '').split())
    assert [author['family-names'] for author in paper['authors']] == [
        'Seo',
        'Kim',
        'Choi',
        'Moon',
    ]
