"""`read_yaml`: whole numbers stay whole, as ROS's integer parameters need them."""

import pytest

from tendon_statics.files.yaml_file import YamlFileError, read_yaml


@pytest.mark.parametrize(
    ('text', 'value'),
    [
        ('3', 3),
        ('-3', -3),
        ('+3', 3),
        ('010', 10),
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


def test_an_error_is_one_line_and_says_where(tmp_path):
    path = tmp_path / 'file.yaml'
    path.write_text('a: 1\nb: [\n')
    with pytest.raises(YamlFileError, match=r'^it is not valid YAML in line 3: .*$'):
        read_yaml(path)
