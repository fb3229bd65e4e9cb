"""`handeye exercise`."""

from pathlib import Path

import msgspec
import pytest

from handeye.cli import app
from handeye.core.errors import InvalidInput

RIGHT = str(Path(__file__).parent / "solutions" / "share.mal")


def answered(*words: str) -> int:
    """The exit code of a command."""
    code = app(["exercise", *words], result_action="return_value", exit_on_error=False)
    assert isinstance(code, int)
    return code


@pytest.fixture(autouse=True)
def _aside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_it_lists_the_exercises_and_shows_one(capsys: pytest.CaptureFixture[str]) -> None:
    assert answered() == 0
    assert "session 5  share" in capsys.readouterr().out
    assert answered("touch") == 0
    assert "20 worlds in which the hole is 20 mm off" in capsys.readouterr().out


def test_start_writes_the_program_and_its_positions_once() -> None:
    assert answered("touch", "--start") == 0
    assert sorted(file.name for file in Path().iterdir()) == ["touch.al", "touch.toml"]
    with pytest.raises(InvalidInput, match="already exists; nothing was written"):
        answered("touch", "--start")
    assert answered("touch", "--start", "--overwrite") == 0


def test_a_grade_is_one_json_object(capsys: pytest.CaptureFixture[str]) -> None:
    assert answered("share", RIGHT, "--json") == 0
    found = msgspec.json.decode(capsys.readouterr().out)
    assert (found["right"], found["of"], found["silent"], found["exit_code"]) == (1, 1, 0, 0)


def test_a_program_with_mistakes_is_not_run(capsys: pytest.CaptureFixture[str]) -> None:
    Path("mine.al").write_text("        MOVE    NOWHERE\n")
    assert answered("touch", "mine.al") == 2
    assert "`handeye explain unknown-position`" in capsys.readouterr().out
    assert answered("touch", "mine.al", "--json") == 2
    found = msgspec.json.decode(capsys.readouterr().out)
    assert (found["of"], found["diagnostics"][0]["code"]) == (0, "unknown-position")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("tuch",), "did you mean `touch`"),
        (("touch", "no.al"), "there is no such file"),
        (("touch", RIGHT), r"needs a program whose name ends in \.al"),
        (("share", RIGHT, "--seed", "3"), "has no worlds"),
        (("touch", "no.al", "--seed", "20"), "its seeds are 0 to 19"),
        (("touch", "--seed", "3"), "needs the file of your program"),
        (("touch", "no.al", "--seed", "3", "--first-seed", "100"), "its seeds are 100 to 119"),
        (("touch", "no.al", "--first-seed", "-1"), "a seed must be a whole number from 0 to"),
        (("touch", "no.al", "--first-seed", "9007199254740990"), "a seed must be a whole number from 0 to"),
        (("share", RIGHT, "--first-seed", "3"), "has no worlds"),
        (("touch", "--first-seed", "3"), "--first-seed needs the file of your program"),
        (("touch", "--start", "--first-seed", "3"), "leave out your file and all seeds"),
        (("touch", "no.al", "--start"), "leave out your file"),
        (("touch", "no.al", "--jobs", "0"), "at least 1"),
    ],
)
def test_bad_input_is_one_sentence(words: tuple[str, ...], told: str) -> None:
    with pytest.raises(InvalidInput, match=told):
        answered(*words)
