"""The terminal of 1975: stored and typed lines, TRY, TRACE, the joystick, files of the host, and the panic button."""

from collections.abc import Iterator
from itertools import chain, repeat
from pathlib import Path

import pytest

from handeye.core.errors import InvalidInput
from handeye.core.source import Source
from handeye.systems.ml.cli.console import Console

COUNT = "10 LOAD 1 3\n20 ADD 1 1\n30 PRINT &1\n40 STOP"


class Typed:
    """A terminal, what it has printed, the prompts that it has shown, and the answers that it will get."""

    def __init__(self, halts: Iterator[bool] | None = None) -> None:
        self.printed: list[str] = []
        self.prompts: list[str] = []
        self.answers: list[str] = []
        self.console = Console(
            self.printed.append,
            self._answer,
            (lambda: next(halts, False)) if halts is not None else (lambda: False),
        )

    def _answer(self, prompt: str) -> str | None:
        self.prompts.append(prompt)
        return self.answers.pop(0) if self.answers else None

    def __call__(self, text: str) -> list[str]:
        """What the terminal prints for some lines."""
        self.printed.clear()
        for line in text.splitlines():
            try:
                self.console.hear(line)
            except InvalidInput as error:
                self.printed.append(str(error))
        return [*self.printed]


@pytest.mark.ml_row(1)
def test_lines_with_a_number_are_stored_and_others_are_executed() -> None:
    typed = Typed()
    assert typed(f"{COUNT}\nLIST 10 20") == ["10 LOAD 1 3", "20 ADD 1 1"]
    assert typed("RUN") == ["4"]
    assert typed("BRANCH 30\nERASE 10 30\nLIST") == ["4", "40 STOP"]


def test_motions_need_the_pump() -> None:
    typed = Typed()
    assert typed("MOTOR 3 100")[0].startswith("M15: ")
    assert typed("ENABLE\nMOTOR 3 100\nGETPOS 1 3\nPRINT &1") == ["100"]


@pytest.mark.ml_row(41)
def test_try_shows_each_statement_before_it_runs() -> None:
    typed = Typed()
    typed(COUNT)
    typed.answers = ["", "n", "?", "A"]
    assert typed("TRY") == [
        "type N to execute the statement, R to run on without asking, or A to abandon the program"
    ]
    assert typed.prompts == ["10 LOAD 1 3 ? ", "20 ADD 1 1 ? ", "30 PRINT &1 ? ", "30 PRINT &1 ? "]
    typed.answers = ["R"]
    assert typed("TRY 20") == ["5"]


@pytest.mark.ml_row(41)
def test_trace_prints_the_values() -> None:
    typed = Typed()
    assert typed(f"{COUNT}\nTRACE\nRUN") == ["10 LOAD 1 3", "20 ADD 1 1", "30 PRINT 4", "4", "40 STOP"]
    assert typed("TRACE 0\nRUN") == ["4"]


@pytest.mark.ml_row(52)
def test_the_joystick_fills_a_sequence_of_points_that_the_arm_retraces() -> None:
    typed = Typed()
    typed("ENABLE\n5 POINT\n10 POINT\n15 POINT\n50 JOY 5\n60 JOY 10\n70 JOY 15")
    typed.answers = ["3 500", "2 -200", "RECORD", "4 300", "what", "RECORD", "3 20000", "3 -900", "RECORD"]
    printed = typed("RUN 50")
    assert printed[:3] == ["motor 3 is at 500", "motor 2 is at -200", "motor 4 is at 300"]
    assert any(line.startswith("M10: ") for line in printed)
    for point, places in ((5, [-200, 500, 0]), (10, [-200, 500, 300]), (15, [-200, -400, 300])):
        typed(f"GOPOINT {point}")
        assert [int(typed(f"QUERY MT {motor} 1")[0]) for motor in (2, 3, 4)] == pytest.approx(places, abs=15)


def test_cancel_leaves_a_point_as_it_was() -> None:
    typed = Typed()
    typed("ENABLE\n5 POINT")
    typed.answers = ["3 500", "CANCEL"]
    typed("JOY 5")
    assert typed("LIST\nGOPOINT 5")[0] == "5 POINT"


@pytest.mark.ml_row(25)
def test_control_c_is_the_panic_button() -> None:
    typed = Typed(chain([False] * 5, [True], repeat(False)))
    printed = typed("ENABLE\nMOTOR 3 2000")
    assert len(printed) == 1
    assert "panic" in printed[0]
    assert 0 < int(typed("QUERY MT 3 1")[0]) < 1000
    assert typed("MOTOR 3 10")[0].startswith("M15: ")
    assert typed("ENABLE\nMOTOR 3 10\nMT 3 1") == ["10"]


def test_an_error_stops_a_program_and_says_where() -> None:
    printed = Typed()("ENABLE\n10 MOTOR 6 5\nRUN")
    assert printed[-1] == "M09: the right arm has no motor 6 (statement 10)"


@pytest.mark.ml_row(39)
def test_programs_are_files_of_the_host(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    typed = Typed()
    typed(f"{COUNT}\n5 POINT * 1 2 3 4 0 0 0 8 9 10 11 12\nCMSDUMP COUNT")
    listed = typed("LIST")
    assert (tmp_path / "COUNT.ml").read_text(encoding="utf-8").splitlines() == listed
    assert typed("ERASE 1 5000\nCMSLOAD COUNT\nLIST") == listed
    assert "already exists" in typed("CMSDUMP COUNT")[0]
    assert "NONE.ml" in typed("CMSLOAD NONE")[0]


def test_query_and_file_read_and_write_tables() -> None:
    typed = Typed()
    assert typed("FILE MT 3 8 10 4\nQUERY MT 3 8\nQUERY MT 3 9") == ["10", "4"]
    assert typed("MT 3")[7] == "MT 3  8     10 speed"
    assert typed("FILE MT 13 1 0")[0].startswith("M11: ")


def test_a_file_is_loaded_and_its_mistake_is_shown() -> None:
    typed = Typed()
    typed.console.load(Source(name="count.ml", text=COUNT))
    assert typed.printed == ["4 statements"]
    with pytest.raises(InvalidInput, match=r"count.ml:1: `LOOD` is not a command"):
        typed.console.load(Source(name="count.ml", text=COUNT.replace("LOAD", "LOOD")))


def test_help_lists_all_commands_and_exit_leaves() -> None:
    typed = Typed()
    assert len(typed("HELP")) == 106 + 9 + 1
    typed("EXIT")
    assert typed.console.over


@pytest.mark.ml_row(40)
def test_left_and_right_choose_the_arm_that_moves() -> None:
    typed = Typed()
    assert typed("LEFT")[0] == "M12: there is no left arm"
    typed.console = Console(typed.printed.append, left=True)
    typed("ENABLE\nLEFT\nENABLE\nMOTOR 3 500")
    assert typed("MT 3 1\nRIGHT\nMT 3 1") == ["500", "0"]
    assert typed("LEFT\nMOTOR 12 5")[0] == "M09: the left arm has no motor 12"


def test_a_program_keeps_its_registers_while_it_commands_the_other_arm() -> None:
    typed = Typed()
    typed.console = Console(typed.printed.append, left=True)
    text = "10 ENABLE\n20 LEFT\n30 ENABLE\n40 LOOPI 3 1\n50 RIGHT\n60 DMOTOR 3 10\n70 LEFT\n80 DMOTOR 3 20\n90 NEXTI"
    assert typed(f"{text}\nRUN\nMT 3 1\nRIGHT\nMT 3 1") == ["60", "30"]


def test_the_host_starts_the_interpreter_of_the_arm_language(monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []
    monkeypatch.setattr("handeye.cli.teaching.repl", lambda: opened.append("repl"))
    assert Typed()("VMCNTL") == []
    assert opened == ["repl"]
