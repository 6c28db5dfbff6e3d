"""What a reader of the tutorials and of the README types does what the page says."""

import re

import pytest
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
    with listener.estimator(), Program.running_command(['python', '-u', script]) as reader:
        wait_for('the answer', lambda: 'equilibrium 0.299' in reader.output())

        def hears():
            listener.publish(1.0, 3.0)
            return 'driven_to_stop 0.5235' in reader.output()

        wait_for('an estimate', hears)
        assert reader.end() == 0
        assert 'Traceback' not in reader.output()


def test_the_node_of_the_readme_says_that_an_estimator_is_needed(tmp_path):
    with_ros, _ = PYTHON.findall((ROOT / 'README.md').read_text(encoding='utf-8'))
    script = tmp_path / 'reader.py'
    script.write_text(with_ros, encoding='utf-8')
    with Program.running_command(['python', '-u', script]) as reader:
        assert reader.wait() == 1
        assert reader.output().splitlines()[-1] == 'no estimator is running: start one first'
