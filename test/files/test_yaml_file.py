"""`read_yaml`: whole numbers stay whole, as ROS's integer parameters need them."""

import pytest

from tendon_statics.files.yaml_file import YamlFileError, read_yaml


@pytest.mark.parametrize(
    ('text', 'value'),
    [
        ('3', 3),
        ('-3', -3),
        ('+3', 3),
        ('3.', 3.0),
        ('3e0', 3.0),
        ('1000000000000000001', 10**18 + 1),
        ('9' * 400, float('inf')),
        ('true', True),
        ('"3"', '3'),
        ('1:30', '1:30'),
    ],
)
def test_a_scalar_has_the_type_that_ros_gives_it(tmp_path, text, value):
    path = tmp_path / 'file.yaml'
    path.write_text(f'key: {text}\n')
    (read,) = read_yaml(path).values()
    assert read == value
    assert type(read) is type(value)


@pytest.mark.parametrize('text', ['010', '-010', '00', '08', '0x10', '+0X1f'])
def test_a_number_in_which_readers_of_yaml_differ_is_refused(tmp_path, text):
    path = tmp_path / 'file.yaml'
    path.write_text(f'key:\n  mass: {text}\n')
    with pytest.raises(YamlFileError, match=r'in line 2 is another number to ROS, '):
        read_yaml(path)


@pytest.mark.parametrize(('text', 'value'), [('0', 0), ('-0', 0), ('0.5', 0.5), ('0e3', 0.0)])
def test_a_zero_is_no_octal_number(tmp_path, text, value):
    path = tmp_path / 'file.yaml'
    path.write_text(f'key: {text}\n')
    assert read_yaml(path) == {'key': value}


def test_an_alias_is_refused_where_ros_does_not_read_it(tmp_path):
    path = tmp_path / 'file.yaml'
    path.write_text('a: &one 1\nb: *one\n')
    assert read_yaml(path) == {'a': 1, 'b': 1}
    with pytest.raises(YamlFileError, match=r'^\*one in line 2 stands for another part'):
        read_yaml(path, aliases=False)


@pytest.mark.parametrize(
    ('text', 'line'),
    [
        ('a: 1\nb: @x\nc: 2\n', 2),
        ('a: 1\n\tb: 2\nc: 2\n', 2),
        ('a:\n  b: 1\n c: 2\nd: 3\n', 3),
        ('a: 1\nb: 1\n  c: 2\nd: 3\n', 3),
        # Noticed later than it stands there.
        ('a: 1\nb 2\nc: 3\n', 2),
        ('a: 1\nb: [\n', 2),
        ('a: 1\nb: [1,\n\n\n', 2),
        ('a: 1\nb: {c: 1,\n\n', 2),
        ('a: "x\nb: 2\nc: 3\n', 1),
    ],
)
def test_an_error_is_one_line_and_names_the_line_to_mend(tmp_path, text, line):
    path = tmp_path / 'file.yaml'
    path.write_text(text)
    with pytest.raises(YamlFileError, match=rf'^it is not valid YAML in line {line}: .*$'):
        read_yaml(path)
