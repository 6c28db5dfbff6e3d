"""`load_design`: the same files as ROS takes, and errors that name file, key, value and range."""

from pathlib import Path

import pytest
from designs import PRELIMINARY, random_design
from hypothesis import given
from hypothesis import strategies as st

from tendon_statics import DesignError, default_design_path, load_design, save_design
from tendon_statics.files.output_file import OutputError
from tendon_statics.physics import paper

TEXT = default_design_path().read_text(encoding='utf-8')


def write(folder: Path, text: str | bytes) -> Path:
    path = folder / 'unit.yaml'
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def changed(key: str, value: str) -> str:
    lines = [
        f'      {key}: {value}' if line.strip().startswith(f'{key}:') else line
        for line in TEXT.splitlines()
    ]
    assert lines != TEXT.splitlines()
    return '\n'.join(lines)


def test_the_default_is_the_installed_preliminary_design():
    assert default_design_path().name == 'preliminary_design.yaml'
    identified = paper.identify_mass_and_offset(PRELIMINARY)
    assert PRELIMINARY.mass == pytest.approx(identified.mass, rel=1e-9)
    assert PRELIMINARY.cable_offset == pytest.approx(identified.cable_offset, rel=1e-9)


def test_every_value_of_the_file_has_its_unit_beside_it():
    from tendon_statics.physics import design_parameters

    for parameter in design_parameters():
        line = next(line for line in TEXT.splitlines() if f' {parameter.name}:' in line)
        assert f'# [{parameter.unit or "1"}]' in line
    assert TEXT.count('; IDENTIFIED') == 2


@pytest.mark.parametrize(
    ('value', 'number'),
    [
        ('1', 1.0),
        ('.5e1', 5.0),
        ('1.', 1.0),
        ('1.5e1', 15.0),
        ('1e-2', 0.01),
        ('2E-2', 0.02),
        ('1.5e-2', 0.015),
        ('+1e-2', 0.01),
    ],
)
def test_numbers_are_read_as_ros_reads_them(tmp_path, value, number):
    assert load_design(write(tmp_path, changed('mass', value))).mass == number


@pytest.mark.parametrize(
    'text',
    [
        TEXT.replace('/**:', '/left/estimator:'),
        TEXT.replace('/**:', 'estimator:'),
        TEXT + '      \n/other:\n  ros__parameters:\n    rate: 10\n',
        '/**:\n  ros__parameters:\n'
        + ''.join(
            f'    design.{line.strip()}\n'
            for line in TEXT.splitlines()
            if line.startswith(' ' * 6)
        ),
    ],
    ids=['node', 'relative', 'other node beside', 'dotted'],
)
def test_the_forms_that_ros_takes(tmp_path, text):
    assert load_design(write(tmp_path, text)) == PRELIMINARY


@pytest.mark.parametrize(
    ('text', 'named'),
    [
        (changed('mass', '-1.0'), ['design.mass is -1.0', '0 to 100 kg']),
        (changed('mass', '.nan'), ['design.mass is nan', '0 to 100 kg']),
        (changed('mass', 'heavy'), ["design.mass is 'heavy'", 'not a number', '0 to 100 kg']),
        (changed('mass', '"0.02"'), ["design.mass is '0.02'", 'not a number']),
        (changed('mass', 'true'), ['design.mass is True', 'not a number']),
        (changed('mass', '[1.0]'), ['design.mass is [1.0]', 'not a number']),
        (changed('mass', ''), ['mass in line', 'has no value']),
        (changed('friction_coefficient', '0.0'), ['design.friction_coefficient is 0.0', '0.001']),
        (changed('contact_end_angle', '0.1'), ['design.contact_end_angle', 'exceed the start']),
        (changed('contact_end_angle', '88.49'), ['88.49', 'radians']),
        (changed('mass', '1.0\n      masss: 2.0'), ['design.masss is 2.0', 'no such']),
        (changed('mass', '1.0\n      mass: 2.0'), ['mass is given a second time in line']),
        (TEXT + '    design.mass: 2.0\n', ['design.mass is given twice']),
        (changed('mass', '1_0.0'), ["design.mass is '1_0.0'", 'not a number']),
        (changed('mass', '1:30'), ["design.mass is '1:30'", 'not a number']),
        (changed('mass', '2024-13-45'), ["design.mass is '2024-13-45'", 'not a number']),
        (changed('mass', '!!int foo'), ['not valid YAML']),
        (changed('mass', '!!timestamp foo'), ['not valid YAML']),
        (changed('mass', '9' * 6000), ['design.mass is inf']),
        ('a: &a [*a]', ['*a in line 1', 'which ROS does not read']),
        ('a: ' + '[' * 3000 + ']' * 3000, ['not valid YAML']),
        (changed('mass', '{a: 1}'), ['design.mass.a', 'no such']),
        ('\n'.join(x for x in TEXT.splitlines() if ' mass:' not in x), ['design.mass is missing']),
        (TEXT + TEXT.replace('/**:', '/b:'), ['/**, /b', 'keep one']),
        ('', ['no design in it']),
        ('[1, 2]', ['it is no parameter file']),
        ('a: [', ['not valid YAML']),
        (b'\xff\xfe\x00', ['not a text file']),
        ('/**:\n  ros__parameters:\n    design: 3\n', ['no design in it']),
        ('? [1, 2]\n: 3\n', ['not valid YAML']),
        ('!!python/object:os.system {}', ['not valid YAML']),
    ],
)
def test_errors_name_file_key_value_and_what_is_allowed(tmp_path, text, named):
    path = write(tmp_path, text)
    with pytest.raises(DesignError) as caught:
        load_design(path)
    message = str(caught.value)
    assert message.startswith(f'{path}: ')
    assert '\n' not in message
    for part in named:
        assert part in message


@pytest.mark.parametrize('name', ['missing.yaml', '.'])
def test_a_file_that_cannot_be_read_is_named(tmp_path, name):
    with pytest.raises(DesignError, match='cannot be read'):
        load_design(tmp_path / name)


@given(st.randoms(use_true_random=False))
def test_a_saved_design_comes_back_to_the_last_digit(tmp_path_factory, source):
    path = tmp_path_factory.mktemp('saved') / 'unit.yaml'
    design = random_design(source)
    save_design(path, design, 'Fitted to: a recording\n\nwith "marks" # of YAML')
    assert load_design(path) == design


def test_a_design_that_cannot_be_saved_leaves_nothing(tmp_path):
    with pytest.raises(OutputError, match='cannot be written'):
        save_design(tmp_path / 'no' / 'unit.yaml', PRELIMINARY)
    assert list(tmp_path.iterdir()) == []
