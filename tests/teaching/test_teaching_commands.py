"""`handeye do` and `handeye repl`, as somebody at the command line meets them."""

import io
import json
import re
from pathlib import Path

import pytest
from conftest import Command

from handeye.cli.prompt import completion

pytestmark = pytest.mark.slow


def answers(out: str) -> list[dict[str, object]]:
    return [json.loads(line) for line in out.splitlines()]


def test_do_plans_functions_and_carries_them_out_one_after_the_other(command: Command) -> None:
    code, out, _ = command("do", "OPEN 3", "PARK", "--json")
    assert code == 0
    assert [a["did"][0]["text"] for a in answers(out)] == ["OPEN 3", "PARK"]  # type: ignore[index]


def test_do_ends_with_the_first_function_that_is_wrong(command: Command) -> None:
    code, out, _ = command("do", "OPEN 9", "PARK", "--json")
    (answer,) = answers(out)
    assert (code, answer["diagnostics"][0]["code"]) == (2, "number-out-of-range")  # type: ignore[index]


def test_do_takes_a_modifier_with_its_motion(command: Command) -> None:
    code, out, _ = command("do", "STOP [0 0 -30]\nCHANGE Z -9")
    assert code == 0
    assert "stopped: the hand presses with" in out


def test_do_tells_a_modifier_alone_how_it_goes_with_its_motion(command: Command) -> None:
    code, _, err = command("do", "STOP [0 0 -30]", "CHANGE Z -9")
    assert (code, err.count("\n")) == (2, 1)
    assert err.startswith("a modifier and its motion must be one argument: handeye do $'STOP 50\\nCHANGE")


@pytest.mark.parametrize(
    ("more", "advice"),
    [
        (
            (),
            "with --keep FILE, `handeye do` saves the cell at the end, and --from FILE continues from the saved cell",
        ),
        (("--keep", "a.checkpoint"), "`handeye do --from a.checkpoint` continues from the saved cell"),
    ],
)
def test_do_says_how_to_go_on_when_the_operator_is_called(
    command: Command, more: tuple[str, ...], advice: str
) -> None:
    code, out, _ = command("do", "CLOSE 1", *more)
    assert (code, out.splitlines()[-1]) == (1, advice)
    assert Path("a.checkpoint").exists() == bool(more)


def test_do_goes_on_from_the_cell_that_another_has_kept(command: Command) -> None:
    assert command("do", "OPEN 3", "--keep", "a.checkpoint")[0] == 0
    code, out, _ = command("do", "WHERE", "--from", "a.checkpoint", "--keep", "b.checkpoint", "--json")
    assert (code, Path("b.checkpoint").exists()) == (0, True)
    assert answers(out)[0]["time"] > 1.5  # type: ignore[operator]


def test_do_without_a_function_says_what_is_wanted(command: Command) -> None:
    code, _, err = command("do")
    assert (code, err) == (2, 'handeye: give an instruction, such as `handeye do "OPEN 3"`\n')


def test_repl_reads_functions_from_standard_input_and_answers_each_with_a_line_of_json(
    command: Command,
) -> None:
    code, out, _ = command("repl", "--json", typed="OPEN 3\nPARK\nDO\nQUIT\nOPEN 1\n")
    assert code == 0
    told = answers(out)
    assert [a["typed"] for a in told] == ["OPEN 3", "PARK", "DO", "QUIT"]
    assert [deed["text"] for deed in told[2]["did"]] == ["OPEN 3", "PARK"]  # type: ignore[attr-defined]


def test_repl_finds_programs_and_what_is_taught_beside_a_script(command: Command) -> None:
    Path("job.toml").write_text("[positions]\nLOW = { at = [25, 30, 6, 90, 90, 0] }\n")
    Path("other.al").write_text("        MOVE    LOW\n")
    code, out, _ = command("repl", "job.al", typed="DO other\n")
    assert code == 0
    line, place = out.split("hand at ")
    assert line.split() == ["1", "MOVE", "LOW"]
    assert [float(x) for x in re.findall(r"[\d.]+", place)] == pytest.approx([25, 30, 6], abs=0.05)


@pytest.mark.parametrize("word", ["QUIT", "exit"])
def test_whoever_leaves_is_heard_no_more(command: Command, word: str) -> None:
    assert command("repl", typed=f"{word}\nFLY\n")[0] == 0
    assert command("teach", "job.al", typed=f"{word}\nFLY\n")[0] == 0


class Terminal(io.StringIO):
    """Somebody sits there."""

    def isatty(self) -> bool:
        return True


def test_what_is_left_unsaved_is_told_by_the_exit_code_on_a_terminal_too(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("handeye.cli.teaching.typed_lines", lambda *_: iter(["here NEW", "quit", "quit"]))
    monkeypatch.setattr("io.StringIO", Terminal)
    code, _, err = command("teach", "job.al")
    assert (code, err) == (2, "not saved: NEW\n")


def test_a_refused_line_on_standard_input_is_told_by_the_exit_code(command: Command) -> None:
    assert command("repl", typed="FLY\n")[0] == 2


def test_a_word_is_completed_whatever_its_case() -> None:
    words = ("PARK", "PLACE", "P1")
    assert [completion("p", n, words) for n in range(4)] == ["P1 ", "PARK ", "PLACE ", None]
