"""Progress: nothing gets lost, all long work has it, and nothing is shown where nobody looks."""

import io
import sys

import bags
from designs import PRELIMINARY

from tendon_statics import load_recording
from tendon_statics.command_line import progress
from tendon_statics.command_line.main import main
from tendon_statics.command_line.progress import with_progress
from tendon_statics.recordings.replay.bag_output import write_bag
from tendon_statics.recordings.replay.estimates import replay
from tendon_statics.recordings.replay.table_output import write_table


class Terminal(io.StringIO):
    """Takes what is written to it."""

    def isatty(self):
        """Say that somebody looks."""
        return True


def look(monkeypatch):
    """Make stderr a terminal on which a bar is shown at once."""
    terminal = Terminal()
    monkeypatch.setattr(sys, 'stderr', terminal)
    monkeypatch.setattr(progress, 'DELAY', 0.0)
    return terminal


def test_on_a_terminal_a_bar_is_shown_and_every_item_passes(monkeypatch):
    terminal = look(monkeypatch)
    assert list(with_progress(range(5), 'solving')) == [0, 1, 2, 3, 4]
    assert 'solving' in terminal.getvalue()
    assert '/5' in terminal.getvalue()


def test_items_that_do_not_tell_how_many_they_are_are_counted(monkeypatch):
    terminal = look(monkeypatch)
    assert list(with_progress(iter('abc'), 'reading')) == ['a', 'b', 'c']
    assert 'reading' in terminal.getvalue()


def test_elsewhere_nothing_is_shown(monkeypatch, capsys):
    items = range(5)
    assert with_progress(items, 'solving') is items
    monkeypatch.setattr(sys, 'stderr', Terminal())
    monkeypatch.setitem(sys.modules, 'tqdm', None)
    assert list(with_progress(items, 'solving')) == [0, 1, 2, 3, 4]
    assert capsys.readouterr().err == ''


def test_reading_solving_and_writing_tell_how_far_they_are(tmp_path):
    seen = []

    def watch(items, doing):
        items = list(items)
        seen.append((doing, len(items)))
        return items

    source = tmp_path / 'run.csv'
    source.write_text('time,tension_l,tension_s\n0,1,2\n1,1,2\n2,1,2\n')
    replayed = replay(PRELIMINARY, load_recording(source, progress=watch), progress=watch)
    write_table(tmp_path / 'out.csv', replayed.columns(), watch)
    write_table(tmp_path / 'out.parquet', replayed.columns(), watch)
    load_recording(tmp_path / 'out.parquet', progress=watch)
    write_bag(tmp_path / 'out.mcap', replayed, watch)
    bag = bags.write_bag(tmp_path / 'bag', [('/tensions', 0.0, bags.array(1.0, 2.0))] * 2)
    load_recording(bag, progress=watch)
    assert seen == [
        ('reading', 3),
        ('solving', 1),
        ('writing', 1),
        ('reading', 1),
        ('writing', 3),
        ('reading', 2),
    ]


def test_the_verb_shows_them_one_after_the_other(tmp_path, monkeypatch, capsys):
    terminal = look(monkeypatch)
    source = tmp_path / 'run.csv'
    source.write_text('tension_l,tension_s\n1,2\n1,2\n')
    assert main(['replay', str(source), '--output', str(tmp_path / 'out.csv')]) == 0
    shown = terminal.getvalue()
    assert -1 < shown.find('reading') < shown.find('solving') < shown.find('writing')
    assert 'samples' in capsys.readouterr().out
