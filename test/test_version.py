"""The version is one, wherever it is written."""

import re
from xml.etree import ElementTree

import pytest
import yaml
from make_docs import ROOT

VERSION = ElementTree.parse(ROOT / 'package.xml').findtext('version')


def test_it_is_a_version():
    assert re.fullmatch(r'\d+\.\d+\.\d+', VERSION)


@pytest.mark.parametrize('path', ['setup.py', 'interfaces/package.xml'])
def test_both_packages_and_the_set_up_have_the_same(path):
    text = (ROOT / path).read_text(encoding='utf-8')
    assert re.search(rf"<version>{VERSION}</version>|version='{VERSION}'", text)


def test_the_changelog_and_the_citation_name_it_with_one_date():
    changelog = (ROOT / 'CHANGELOG.rst').read_text(encoding='utf-8')
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
