"""Commands for those who write scripts."""

import subprocess
import sys
from pathlib import Path

import pytest
from conftest import Command

from handeye.al import INSTRUCTIONS
from handeye.al.instructions import EXPLAINED
from handeye.cli.scripts import watched
from handeye.core.codes import CODES
from handeye.core.errors import ERRORS, InvalidInput
from handeye.editor.explain import example, explanation

UNTIDY = "l1: open   1 ;wide\n"
TIDY = "l1:     OPEN    1               ;wide\n"


def handeye(*words: str, typed: bytes) -> tuple[int, bytes, bytes]:
    done = subprocess.run(
        [sys.executable, "-m", "handeye", *words], input=typed, capture_output=True, check=False
    )
    return done.returncode, done.stdout, done.stderr


def test_fmt_puts_files_into_columns_and_says_which(command: Command) -> None:
    Path("a.al").write_text(UNTIDY, encoding="utf-8")
    Path("b.al").write_text(TIDY, encoding="utf-8")
    assert command("fmt", "a.al", "b.al") == (0, "a.al: formatted\n", "")
    assert Path("a.al").read_text(encoding="utf-8") == Path("b.al").read_text(encoding="utf-8") == TIDY


def test_fmt_check_writes_nothing_and_ends_with_one(command: Command) -> None:
    Path("a.al").write_text(UNTIDY, encoding="utf-8")
    Path("b.al").write_text(TIDY, encoding="utf-8")
    assert command("fmt", "--check", "a.al", "b.al") == (1, "a.al would change\n", "")
    assert command("fmt", "--check", "b.al") == (0, "", "")
    assert Path("a.al").read_text(encoding="utf-8") == UNTIDY


def test_fmt_leaves_a_text_with_mistakes_of_form_alone(command: Command) -> None:
    Path("a.al").write_text("open 1 2\n", encoding="utf-8")
    code, out, err = command("fmt", "a.al")
    assert (code, out, err.count("error["), err.endswith("a.al is unchanged\n")) == (2, "", 1, True)
    assert Path("a.al").read_text(encoding="utf-8") == "open 1 2\n"


def test_fmt_does_not_ask_what_names_mean(command: Command) -> None:
    Path("a.al").write_text("move nowhere\n", encoding="utf-8")
    assert command("fmt", "a.al")[0] == 0
    assert Path("a.al").read_text(encoding="utf-8") == "        MOVE    nowhere\n"


def test_fmt_without_files_says_what_it_needs(command: Command) -> None:
    assert command("fmt") == (2, "", "handeye: fmt needs the name of a script, or - for standard input\n")


def test_fmt_knows_the_macros_of_required_files_and_leaves_those_files_alone(
    command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    main, required = Path("main.al"), Path("b.al")
    main.write_text("require b.al\ndrop\n", encoding="utf-8")
    required.write_text("DEFINE DROP\nopne 1\n\n", encoding="utf-8")
    assert command("fmt", "main.al") == (0, "main.al: formatted\n", "")
    assert main.read_text(encoding="utf-8") == "        REQUIRE b.al\n        DROP\n"
    assert required.read_text(encoding="utf-8") == "DEFINE DROP\nopne 1\n\n"


def test_fmt_of_standard_input_needs_no_required_file() -> None:
    code, out, _ = handeye("fmt", "-", typed=b"require b.al\ndrop\n")
    assert (code, out) == (0, b"        REQUIRE b.al\n        DROP\n")


@pytest.mark.slow
def test_fmt_of_standard_input_goes_to_standard_output() -> None:
    assert handeye("fmt", "-", typed=UNTIDY.encode()) == (0, TIDY.encode(), b"")
    assert handeye("fmt", "-", typed=b"\xff")[0] == 2


@pytest.mark.parametrize("code", CODES)
def test_explain_tells_meaning_and_example_of_every_code(command: Command, code: str) -> None:
    exit_code, out, err = command("explain", code)
    assert (exit_code, err) == (0, "")
    assert out.startswith(f"{CODES[code].severity}[{code}]: {CODES[code].meaning}\n")
    assert CODES[code].example.split("\n")[0] in out


@pytest.mark.parametrize("code", [code for code, entry in CODES.items() if entry.phase != "strict"])
def test_explain_shows_what_an_example_gets(code: str) -> None:
    _, diagnostic = example(code)
    assert diagnostic is not None


def test_explain_shows_the_cure_and_what_the_example_becomes() -> None:
    text = explanation("label-splits-modifier")
    assert text.endswith(
        "cure: put the label before `STOP`\n\n    L:\n    STOP 50\n       MOVE T\n    JUMP L"
    )


def test_what_the_manual_shows_of_explain_is_what_it_says() -> None:
    manual = (Path(__file__).parents[2] / "docs" / "editors.md").read_text(encoding="utf-8")
    command, shown = manual.split("```\n$ handeye explain ")[1].split("```")[0].split("\n", 1)
    assert shown.rstrip("\n") == explanation(command)


@pytest.mark.parametrize("number", ERRORS)
def test_explain_tells_what_an_error_number_means(command: Command, number: int) -> None:
    code, out, err = command("explain", str(number))
    assert (code, out.splitlines()[0], err) == (0, f"error {number}: {ERRORS[number]}", "")


@pytest.mark.parametrize("op", INSTRUCTIONS)
def test_explain_tells_what_an_instruction_does(command: Command, op: str) -> None:
    exit_code, out, _ = command("explain", op.lower())
    assert exit_code == 0
    assert INSTRUCTIONS[op].help in out


@pytest.mark.parametrize("op", EXPLAINED)
def test_explain_tells_where_the_page_of_an_instruction_is(op: str) -> None:
    page = explanation(op).rpartition(": ")[2]
    assert (Path(__file__).parents[2] / page).read_text(encoding="utf-8").startswith(f"# `{op}")


def test_explain_tells_usage_operands_and_origin_of_an_instruction() -> None:
    assert explanation("move").split("\n") == [
        "MOVE position (DIRECT)",
        "",
        "go to a position: rise, move across and go down; with DIRECT, go straight to the position",
        "",
        "  position  the name of a position (paper 1973)",
        "  (DIRECT)  this word (handeye)",
        "",
        "The paper of 1973 has this motion.",
        "More and examples: docs/language/reference/move.md",
    ]


def test_explain_names_the_codes_that_a_word_is_part_of() -> None:
    with pytest.raises(
        InvalidInput, match=r"`unreachable`; known: `unreachable-code`, `unreachable-position`$"
    ):
        explanation("unreachable")


def test_explain_names_the_nearest_code(command: Command) -> None:
    code, out, err = command("explain", "unknown-labl")
    assert (code, out) == (2, "")
    assert err == (
        "handeye: there is no code, error number or instruction `unknown-labl`; did you mean `unknown-label`?\n"
    )


def test_explain_refuses_a_number_that_is_larger_than_any(command: Command) -> None:
    code, out, err = command("explain", "9" * 5000)
    assert (code, out, err.count("\n")) == (2, "", 1)


def test_explain_without_a_word_lists_every_code_and_error(command: Command) -> None:
    _, out, _ = command("explain")
    assert [code for code in CODES if f"  {code} " not in out] == []
    assert [meaning for meaning in ERRORS.values() if meaning not in out] == []


class Edits:
    """Changes files while a script is watched, one change a pause, then presses Ctrl-C."""

    def __init__(self, *changes: tuple[str, str]) -> None:
        self.changes = list(changes)

    def __call__(self) -> None:
        if not self.changes:
            raise KeyboardInterrupt
        name, text = self.changes.pop(0)
        Path(name).write_text(text, encoding="utf-8")


@pytest.fixture
def script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("a.al").write_text("OPEN 1\n", encoding="utf-8")
    return Path("a.al")


def test_a_watched_script_is_checked_again_when_it_or_what_is_taught_changes(script: Path) -> None:
    checked = []

    def check() -> int:
        checked.append(script.read_text(encoding="utf-8"))
        return len(checked)

    edits = Edits(("a.al", "OPEN 1.5\n"), ("other.al", "PARK\n"), ("a.toml", "[positions]\n"))
    assert watched(script, check, edits) == 3
    assert checked == ["OPEN 1\n", "OPEN 1.5\n", "OPEN 1.5\n"]


def test_a_watched_script_is_checked_again_when_a_file_it_requires_changes(script: Path) -> None:
    script.write_text("REQUIRE lib/b.al\n", encoding="utf-8")
    Path("lib").mkdir()
    checked = []

    def check() -> int:
        checked.append(len(checked))
        return 0

    edits = Edits(
        ("lib/b.al", "REQUIRE c.al"), ("lib/c.al", "PARK"), ("c.al", "PARK"), ("lib/c.al", "OPEN 1")
    )
    watched(script, check, edits)
    assert len(checked) == 4


def test_watching_goes_on_after_a_file_that_cannot_be_used(
    script: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    answers = [0, InvalidInput("a.toml is not TOML"), 0]

    def check() -> int:
        answer = answers.pop(0)
        if isinstance(answer, InvalidInput):
            raise answer
        return answer

    assert watched(script, check, Edits(("a.toml", "?"), ("a.toml", ""))) == 0
    assert capsys.readouterr().err.splitlines() == [
        "watching a.al; Ctrl-C ends it",
        "",
        "── a.toml changed",
        "handeye: a.toml is not TOML",
        "",
        "── a.toml changed",
    ]
