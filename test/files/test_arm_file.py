"""`load_arm`: one YAML file, and errors that name the place, the value and what is allowed."""

import pytest
from designs import PRELIMINARY
from make_docs import ROOT

from tendon_statics import ArmError, DesignUncertainty, load_arm, save_design
from tendon_statics.files.arm_file import load_arm_uncertainties

DESIGN = (
    '{ball_radius: 0.0078, cable_offset: 0.0045, com_distance: 0.008, mass: 0.02, '
    'friction_coefficient: 1.05, contact_start_angle: 1.0, contact_end_angle: 1.5, '
    'max_bend_angle: 0.5, gravity: 9.81}'
)
CABLES = """
cables:
  - {name: l, side: l, last_unit: 2}
  - {name: s, side: s, last_unit: 2, offset: 1e-3}
"""
TEXT = f"""
units:
  - {{design: {DESIGN}, length: 0.02}}
  - {{design_file: unit.yaml, length: 0.03}}
{CABLES}
cable_friction_coefficient: 1e-1
"""


@pytest.fixture
def write(tmp_path):
    save_design(tmp_path / 'unit.yaml', PRELIMINARY)

    def write(text=TEXT, **replacements):
        for old, new in replacements.items():
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / 'arm.yaml'
        path.write_text(text, encoding='utf-8')
        return path

    return write


def test_an_arm_is_read_with_its_designs_from_beside_it_or_from_within(write):
    arm = load_arm(write())
    assert [unit.length for unit in arm.units] == [0.02, 0.03]
    assert arm.designs[0].mass == 0.02
    assert arm.designs[1] == PRELIMINARY
    assert [(c.name, c.side, c.last_unit, c.offset) for c in arm.cables] == [
        ('l', 'l', 2, None),
        ('s', 's', 2, 0.001),
    ]
    assert arm.cable_friction_coefficient == 0.1


def test_how_well_designs_are_known_is_read_from_their_files(write, tmp_path):
    assert load_arm_uncertainties(write()) == (None, None)
    uncertainty = DesignUncertainty(('mass', 'friction_coefficient'), ((1e-6, 0.0), (0.0, 0.01)))
    save_design(tmp_path / 'unit.yaml', PRELIMINARY, uncertainty=uncertainty)
    assert load_arm_uncertainties(write()) == (None, uncertainty)
    text = (tmp_path / 'unit.yaml').read_text(encoding='utf-8')
    (tmp_path / 'unit.yaml').write_text(text.replace('"mass"', '"weight"'), encoding='utf-8')
    with pytest.raises(ArmError, match=r"parameters has 'weight', which is no design") as raised:
        load_arm_uncertainties(write())
    assert 'arm.yaml' in str(raised.value)
    assert '\n' not in str(raised.value)


def test_without_it_the_cables_have_no_friction(write):
    assert load_arm(write(TEXT.split('cable_friction')[0])).cable_friction_coefficient == 0.0


def test_the_example_is_an_arm_with_its_unit_beside_every_number():
    path = ROOT / 'config/arm.yaml'
    assert len(load_arm(path).units) == 5
    for line in path.read_text(encoding='utf-8').splitlines():
        key, colon, value = line.split('#')[0].strip(' -').partition(': ')
        if colon and value.strip().replace('.', '').isdigit():
            assert '[' in line.partition('#')[2], key


CHANGES = {
    'a_key_that_there_is_not': ('units:', 'friction: 1\nunits:', 'friction is 1, but there is no'),
    'a_key_twice': ('units:', 'units: []\nunits:', 'units is given a second time'),
    'no_cables': (CABLES, '', 'cables is missing'),
    'a_unit_with_another_key': ('length: 0.02', 'length: 0.02, mass: 1', 'units[1]: mass is 1'),
    'no_length': (', length: 0.02', '', 'units[1]: length is missing'),
    'a_length_that_is_text': ('length: 0.02', 'length: long', "units[1]: length is 'long'"),
    'both_designs': ('{design_file:', '{design: {}, design_file:', 'units[2]: one of design_file'),
    'neither_design': ('design_file: unit.yaml, ', '', 'units[2]: one of design_file and design'),
    'a_design_that_is_text': (DESIGN, 'unit.yaml', "units[1]: design is 'unit.yaml'"),
    'a_design_that_is_none': ('mass: 0.02', 'mass: -1', 'units[1]: design.mass is -1.0, allowed'),
    'no_such_file': ('unit.yaml', 'other.yaml', 'it cannot be read'),
    'a_side_that_there_is_not': ('side: l', 'side: left', "cables[1]: side is 'left'"),
    'a_unit_that_there_is_not': ('last_unit: 2}', 'last_unit: 3}', 'ends at unit 3'),
    'a_cable_that_is_none': ('{name: l, side: l, last_unit: 2}', 'l', "cables[1] is 'l', but a"),
    'units_that_are_no_list': ('units:\n', 'units: 5\nmore:\n', 'there is no such key'),
    'a_number_that_readers_differ_in': ('length: 0.02', 'length: 010', '010 in line 3'),
    'a_cable_twice': ('name: s', 'name: l', "two cables are called 'l'"),
}


@pytest.mark.parametrize('change', CHANGES)
def test_what_cannot_be_meant_is_refused_in_one_line(write, change):
    old, new, named = CHANGES[change]
    path = write(TEXT.replace(old, new))
    with pytest.raises(ArmError) as caught:
        load_arm(path)
    assert str(caught.value).startswith(f'{path}: ')
    assert named in str(caught.value)
    assert '\n' not in str(caught.value)


@pytest.mark.parametrize('text', ['', '[]', 'units: 3\ncables: []', 'units: [1]\ncables: []'])
def test_what_is_no_arm_at_all_is_refused(write, text):
    with pytest.raises(ArmError):
        load_arm(write(text))


def test_a_file_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(ArmError, match='cannot be read'):
        load_arm(tmp_path / 'none.yaml')
