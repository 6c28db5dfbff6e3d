"""Values of parameter files change where the node takes them, and nothing else does."""

import pytest

from tendon_statics.files.output_file import OutputError
from tendon_statics.files.parameter_edit import edit_parameters

OWN = '/estimator:\n  ros__parameters:\n    a:\n'
EVERY = '/**:\n  ros__parameters: '


@pytest.mark.parametrize(
    ('before', 'after'),
    [
        (f'{EVERY}\n    a.b: 1 # x\n', f'{EVERY}\n    a.b: 2.5 # x\n'),
        (
            '/**: {ros__parameters: {a: {b: 1, c: 3}}}',
            '/**: {ros__parameters: {a: {b: 2.5, c: 3}}}',
        ),
        ('/**: {ros__parameters: {a: {c: 3}}}', '/**: {ros__parameters: {a.b: 2.5, a: {c: 3}}}'),
        (
            f'{EVERY}\r\n    # ü\r\n    c: 3\r\n',
            f'{EVERY}\r\n    # ü\r\n    a.b: 2.5\n    c: 3\r\n',
        ),
        (f'{EVERY}{{a.b: 1}}\n{OWN}      b: 1\n', f'{EVERY}{{a.b: 1}}\n{OWN}      b: 2.5\n'),
        (f'{EVERY}{{a.b: 1}}\n/x: {{}}\n', f'{EVERY}{{a.b: 2.5}}\n/x: {{}}\n'),
    ],
    ids=['block', 'nested', 'not there', 'by lines', 'the last one', 'of every node'],
)
def test_only_the_value_that_the_node_takes_changes(tmp_path, before, after):
    path, output = tmp_path / 'before.yaml', tmp_path / 'after.yaml'
    path.write_bytes(before.encode())
    edit_parameters(path, output, {'a.b': 2.5})
    assert output.read_bytes().decode() == after
    edit_parameters(output, output, {'a.b': 2.5}, comment='Values of today')
    edit_parameters(output, output, {'a.b': 2.5}, comment='Values of tomorrow')
    assert output.read_bytes().decode() == f'# Values of tomorrow\n{after}'


def test_a_file_that_cannot_be_changed_stays(tmp_path):
    path = tmp_path / 'unit.yaml'
    path.write_text('/**:\n  ros__parameters:\n    ? c\n    : 3\n')
    with pytest.raises(OutputError, match=r'write a\.b: 2\.5 there'):
        edit_parameters(path, path, {'a.b': 2.5})
    assert path.read_text().startswith('/**:')
