"""The words of the command line: arguments, options, numbers, and the streams it finds."""

import subprocess
import sys
from pathlib import Path

import pytest
from conftest import Command

NUMBERS = [
    ("assemble", "--seed"),
    ("run", "job.plan.json", "--seed"),
    ("trials", "assembly", "--jobs"),
    ("trials", "base", "--n"),
    ("bench", "insertion", "--n"),
]
"""Commands that end with a whole number."""


@pytest.mark.parametrize("words", NUMBERS)
def test_a_fraction_is_no_whole_number(command: Command, words: tuple[str, ...]) -> None:
    code, _, err = command(*words, "1.5")
    assert (code, "`1.5` is not a whole number" in err) == (2, True)


@pytest.mark.parametrize(
    ("words", "missing"),
    [(("check",), "FILE"), (("plan",), "FILE"), (("diff", "a.json"), "NEW"), (("diff",), "OLD")],
)
def test_what_is_missing_is_called_as_in_the_help(
    command: Command, words: tuple[str, ...], missing: str
) -> None:
    code, _, err = command(*words)
    assert (code, f"needs {missing} (see `handeye {words[0]} --help`)" in err) == (2, True)


COMMANDS = [
    "assemble", "run", "resume", "show", "do", "repl", "teach", "check", "plan", "stages", "fmt", "explain", "lsp",
    "inspect", "diff", "schema", "trace show", "trace stats", "trace photograph", "trace verify", "world", "render",
    "trials assembly", "trials base", "trials gasket", "bench timing",
]  # fmt: skip


@pytest.mark.parametrize("words", COMMANDS)
def test_help_offers_each_thing_once(command: Command, words: str) -> None:
    code, out, _ = command(*words.split(), "--help")
    assert (code, "--file" in out, "--no-j" in out.replace("--no-judge", "")) == (0, False, False)
    assert ("--no-judge" in out) == (words in ("resume", "run"))


CLOSED = {
    "<&-": ("run job.plan.json --step", "repl", "teach job.al", "do 'OPEN 1'", "fmt -"),
    ">&-": ("schema", "inspect job.plan.json --json", "inspect job.plan.json --graph svg", "--help"),
    "2>&-": ("stages job.plan.json",),
}
"""A stream that is closed, and commands that would use it."""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("closed", "words"), [(closed, words) for closed, all in CLOSED.items() for words in all]
)
def test_a_closed_stream_is_as_the_null_device(command: Command, closed: str, words: str) -> None:
    Path("job.al").write_text("OPEN 1\n", encoding="utf-8")
    assert command("plan", "job.al")[0] == 0
    line = f'exec "$0" -m handeye {words} {closed}'
    done = subprocess.run(
        ["/bin/sh", "-c", line, sys.executable],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, "Traceback" in done.stderr) == (0, False)


@pytest.mark.slow
@pytest.mark.parametrize("word", ["--help", "schema"])
def test_a_reader_that_goes_away_is_told_by_the_code(word: str) -> None:
    words = [sys.executable, "-m", "handeye", word]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        process.stdout.close()
        assert process.stderr is not None
        assert process.stderr.read() == ""
    assert process.returncode == 141
