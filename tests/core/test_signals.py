"""Signals that tell the program to end: heard unless they are ignored, and not in the middle of an import."""

import importlib
import os
import signal
import sys
from pathlib import Path

import pytest

from handeye.core.signals import ENDING, ToldToEnd, break_in, heard

SWALLOWS = """
import signal
try:
    signal.raise_signal({number})
    lived = True
except BaseException:
    lived = False
"""
OTHERS = [number for number in ENDING if number != signal.SIGINT]


@pytest.mark.parametrize("number", ENDING)
def test_every_signal_to_end_breaks_in_and_then_is_what_it_was(number: signal.Signals) -> None:
    signal.signal(number, known := lambda *_: None)
    try:
        with pytest.raises(KeyboardInterrupt), heard(break_in):
            signal.raise_signal(number)
        assert signal.getsignal(number) is known
    finally:
        signal.signal(number, signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL)


@pytest.mark.parametrize("number", ENDING)
def test_one_that_is_ignored_stays_ignored(number: signal.Signals) -> None:
    before = signal.signal(number, signal.SIG_IGN)
    try:
        with heard(break_in):
            signal.raise_signal(number)
    finally:
        signal.signal(number, before)


@pytest.mark.parametrize("number", OTHERS)
def test_only_ctrl_c_may_be_taken_for_a_dropped_line(number: signal.Signals) -> None:
    with pytest.raises(ToldToEnd), heard(break_in):
        signal.raise_signal(number)


@pytest.mark.parametrize("number", OTHERS)
def test_a_module_that_swallows_it_while_it_is_imported_is_imported_whole_first(
    number: signal.Signals, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "outer.py").write_text("import swallows")
    (tmp_path / "swallows.py").write_text(SWALLOWS.format(number=int(number)))
    monkeypatch.syspath_prepend(tmp_path)
    for name in ("outer", "swallows"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    with pytest.raises(KeyboardInterrupt), heard(break_in):
        importlib.import_module("outer")
    assert sys.modules["swallows"].lived


@pytest.mark.skipif(not hasattr(os, "openpty"), reason="there are no terminals to close")
def test_a_terminal_that_closes_is_left_so_that_last_words_raise_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    terminal, line = os.openpty()
    kept = os.dup(2)
    os.dup2(line, 2)
    try:
        os.close(terminal)
        with pytest.raises(ToldToEnd), heard(break_in):
            signal.raise_signal(signal.SIGHUP)
        assert os.write(2, b"interrupted") == 11
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(line)
