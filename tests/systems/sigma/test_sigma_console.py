"""The console of 1981: numbered lines are the program, the others are carried out at once."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from mal_bench import PLANS

from handeye.core.errors import InvalidInput
from handeye.systems.sigma.cli.console import COMMANDS, Console

Command = Callable[..., tuple[int, str, str]]


class Typed:
    """A console, what it has told, and the answers that it will get."""

    def __init__(self, halts: Iterator[bool] | None = None) -> None:
        self.told: list[str] = []
        self.answers: list[str] = []
        self.console = Console(
            self.told.append,
            lambda _: self.answers.pop(0) if self.answers else None,
            (lambda: next(halts, False)) if halts is not None else (lambda: False),
        )

    def __call__(self, text: str) -> list[str]:
        """What the console prints for some lines."""
        self.told.clear()
        for line in text.splitlines():
            try:
                self.console.hear(line)
            except InvalidInput as error:
                self.told.append(str(error))
        return [*self.told]


def test_lines_go_into_the_program_by_their_numbers_and_out_of_it() -> None:
    typed = Typed()
    assert typed("20 print 2\n10 print 1\n30 end\n20") == []
    assert typed("LIST") == ["10 PRINT 1", "30 END"]
    assert typed("list 10-20\nLIST 30\nLIST 20-") == ["10 PRINT 1", "30 END", "30 END"]


def test_a_line_that_is_wrong_is_told_at_once_and_stays_out() -> None:
    typed = Typed()
    assert typed("10 MOOVE X1 TO 5") == ["`MOOVE` is not a statement of MAL; did you mean `MOVE`?"]
    assert typed("LIST\n5") == ["there is no line 5"]


def test_a_program_is_compiled_and_run_and_its_mistakes_are_shown() -> None:
    typed = Typed()
    assert typed("10 START B\n20 PRINT 1\n30 TASK B\n40 PRINT 2\nCOMPILE") == [
        "3 statements, 12 instructions; 2 tasks: MAIN, B"
    ]
    assert typed("RUN")[:2] == ["2", "1"]
    assert typed("50 GOTO 99\nRUN")[-1] == "1 mistake: the program is not run"


def test_a_program_stops_before_a_line_and_goes_on() -> None:
    typed = Typed()
    typed("10 ORIGIN X1\n20 MOVE X1 TO 50\n30 PRINT POS(X1)\nBREAK 30")
    assert typed("RUN")[0].startswith("BREAK before line 30, in the task MAIN, at ")
    assert typed("STATUS")[0] == "  0  X1      0-0  free               49.9875 mm"
    assert typed("CONT") == ["49.9875", "2 commands in 0.450 s; the computer was idle for 99% of the time"]
    assert typed("CONT") == ["no program is running; RUN starts the program"]
    assert typed("BREAK\nRUN")[0] == "49.9875"


def test_ctrl_c_breaks_an_endless_loop_and_cont_goes_on() -> None:
    typed = Typed(iter([False] * 20 + [True] + [False] * 20 + [True]))
    assert typed("10 GOTO 10\nRUN")[0].endswith("s; CONT continues")
    assert typed("CONT")[0].startswith("BREAK at ")


def test_input_asks_until_it_gets_a_number() -> None:
    typed = Typed()
    typed.answers = ["HIGH", "12"]
    assert typed("10 INPUT A\n20 PRINT A\nRUN")[:2] == ["`HIGH` is not a number", "12"]
    assert typed("RUN") == ["the task MAIN, line 10, waits for a number for A, typed at the console"]


def test_programs_are_saved_to_new_files_and_loaded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    typed = Typed()
    typed(f"LOAD {PLANS / 'dead.mal'}")
    assert typed("SAVE mine") == ["mine.mal: 26 lines"]
    assert typed("SAVE mine") == ["mine.mal already exists; nothing was written, choose another name"]
    assert (tmp_path / "mine.mal").read_text(encoding="utf-8") == (PLANS / "dead.mal").read_text(
        encoding="utf-8"
    )
    assert typed("NEW\nLIST") == []
    assert typed("LOAD mine.mal\nRUN")[1].startswith("DEADLOCK: the task MAIN, line 60")
    assert "no such file" in typed("LOAD none.mal")[0].lower()


@pytest.mark.parametrize("word", COMMANDS)
def test_every_command_does_something_or_tells_why_not(word: str) -> None:
    Typed()(f"{word}\n{word} 99 99\n{word} {'X' * 300}")


def test_the_console_takes_lines_from_a_pipe(command: Command) -> None:
    code, out, _ = command("sigma", typed="10 PRINT 6 * 7\nRUN\nFOO\n")
    assert (code, out.splitlines()[0]) == (2, "42")
    assert "`FOO` is not a command; " in out
    shown = command("sigma", str(PLANS / "chess.mal"), typed="RUN\nBYE\n")[1].splitlines()
    assert shown[1] == "the task MAIN, line 330: NO PIECE IS FOUND"
