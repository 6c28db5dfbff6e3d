"""`load_tensions`: recorded tensions, and errors that name file and line."""

import math

import pytest

from tendon_statics.installed_files import installed_config
from tendon_statics.tension_file import TensionFileError, load_tensions


def test_columns_are_found_by_name_and_comments_are_left_alone(tmp_path):
    path = tmp_path / 'run.csv'
    path.write_text('# a run\ntime, tension_s ,tension_l\n\n0.0,2.0,1.0\n# pause\n0.1,nan,-1e-3\n')
    first, second = load_tensions(path)
    assert first == (1.0, 2.0, 0.0)
    assert second[0] == -0.001
    assert math.isnan(second[1])


@pytest.mark.parametrize(
    ('text', 'named'),
    [
        ('', 'no column tension_l'),
        ('tension_l,t\n1,2\n', 'no column tension_s'),
        ('tension_l,tension_s\n', 'no row'),
        ('tension_l,tension_s\n1,2\n1,x\n', 'line 3'),
        ('tension_l,tension_s\n1,2\n1\n', 'line 3'),
        ('tension_l,tension_s\n"1,2\n3,4\n', 'line 2'),
    ],
)
def test_a_bad_file_is_named_with_the_line(tmp_path, text, named):
    path = tmp_path / 'run.csv'
    path.write_text(text)
    with pytest.raises(TensionFileError, match=f'^{path}.*{named}'):
        load_tensions(path)


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(TensionFileError, match='cannot be read'):
        load_tensions(tmp_path / 'missing.csv')
    (tmp_path / 'binary.csv').write_bytes(b'\xff\xfe')
    with pytest.raises(TensionFileError, match='not a text file'):
        load_tensions(tmp_path / 'binary.csv')


def test_the_demo_holds_the_published_case():
    assert (1.0, 2.0, None) in load_tensions(installed_config('demo_tensions.csv'))
