"""What a reader of the tutorials and of the README types does what the page says."""

import re

import pytest
from ctrl_c import assert_ends_by_ctrl_c
from make_docs import ROOT, TUTORIALS
from ros_programs import Program, wait_for
from run_page import run_page

PYTHON = re.compile(r'^```python\n(.*?)^```$', re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize('page', TUTORIALS)
def test_a_tutorial_prints_what_it_shows(page):
    text = (ROOT / page).read_text(encoding='utf-8')
    assert run_page(text) == text, 'run `make docs`'


def test_every_tutorial_is_run():
    assert {str(path.relative_to(ROOT)) for path in ROOT.glob('docs/tutorials/*.md')} == {
        *TUTORIALS
    }


def test_the_page_on_python_runs():
    run_page((ROOT / 'docs/python.md').read_text(encoding='utf-8'))


def test_the_readme_shows_what_is_printed_without_ros(capsys):
    _, without = PYTHON.findall((ROOT / 'README.md').read_text(encoding='utf-8'))
    exec(without, {})
    assert capsys.readouterr().out == without.splitlines(keepends=True)[-1].removeprefix('# ')


def test_the_node_of_the_readme_asks_and_listens(listener, tmp_path):
    with_ros, _ = PYTHON.findall((ROOT / 'README.md').read_text(encoding='utf-8'))
    script = tmp_path / 'reader.py'
    script.write_text(with_ros, encoding='utf-8')
    # On a machine so busy that no answer comes within its 5 s it says so, and is begun anew.
    with listener.estimator():
        assert any(asks_and_listens(listener, script) for _ in range(10))


def asks_and_listens(listener, script):
    """Run the reader; return whether an answer came, and then hold it to all else."""
    with Program.running_command(['python', '-u', script]) as reader:
        wait_for(
            'an answer, or none',
            lambda: 'equilibrium 0.299' in reader.output() or reader.process.poll() is not None,
        )
        if reader.process.poll() is not None:
            assert reader.output().endswith('no answer within 5 s\n'), reader.output()
            return False

        def hears():
            listener.publish(1.0, 3.0)
            return 'driven_to_stop 0.5235' in reader.output()

        wait_for('an estimate', hears)
        assert_ends_by_ctrl_c(reader)
        return True


def test_the_node_of_the_readme_says_that_an_estimator_is_needed(tmp_path):
    with_ros, _ = PYTHON.findall((ROOT / 'README.md').read_text(encoding='utf-8'))
    script = tmp_path / 'reader.py'
    script.write_text(with_ros, encoding='utf-8')
    with Program.running_command(['python', '-u', script]) as reader:
        assert reader.wait() == 1
        assert reader.output().splitlines()[-1] == 'no estimator is running: start one first'
