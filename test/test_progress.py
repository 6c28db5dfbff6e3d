"""`with_progress`: nothing gets lost, and nothing is shown where nobody looks."""

import io
import sys

from tendon_statics.command_line import progress
from tendon_statics.command_line.progress import with_progress


class Terminal(io.StringIO):
    """Takes what is written to it."""

    def isatty(self):
        """Say that somebody looks."""
        return True


def test_on_a_terminal_a_bar_is_shown_and_every_item_passes(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr(sys, 'stderr', terminal)
    monkeypatch.setattr(progress, 'DELAY', 0.0)
    assert list(with_progress(range(5))) == [0, 1, 2, 3, 4]
    assert '/5' in terminal.getvalue()


def test_elsewhere_nothing_is_shown(monkeypatch, capsys):
    items = range(5)
    assert with_progress(items) is items
    monkeypatch.setattr(sys, 'stderr', Terminal())
    monkeypatch.setitem(sys.modules, 'tqdm', None)
    assert list(with_progress(items)) == [0, 1, 2, 3, 4]
    assert capsys.readouterr().err == ''
