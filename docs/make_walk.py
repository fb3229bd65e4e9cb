"""Writes anew what the stepper answers in docs/stepping.md; what is typed there, and all around it, people write.

python docs/make_walk.py
"""

import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "support"), str(ROOT / "tests" / "execution")]

from stepping_walk import SAID, SEED, commands, of_command  # noqa: E402
from test_whole_run import begun, transcript  # noqa: E402

import handeye  # noqa: E402
from handeye.trace.account import account  # noqa: E402

PAGE = ROOT / "docs" / "stepping.md"
TOLD_TO, TOLD_FROM = re.compile(r"AOJ +L2$"), re.compile(r"\d  CHANGE ")


def answers(lines: Sequence[str]) -> Iterator[list[str]]:
    """What stands before the first command, and each command with its answer."""
    piece: list[str] = []
    for line in lines:
        if line.startswith(SAID) and piece:
            yield piece
            piece = []
        piece.append(line)
    yield piece


def with_answers(page: str, heard: Sequence[str]) -> str:
    """The page with what was heard where it shows the stepper."""
    for shown, now in zip(answers(commands()), answers(heard), strict=True):
        page = page.replace("\n".join(shown) + "\n", "\n".join(now) + "\n", 1)
    return page


def with_account(page: str, told: Sequence[str]) -> str:
    """The page with what the trace tells of the step that begins the search for the second hole."""
    end = next(number for number, line in enumerate(told) if TOLD_TO.search(line)) + 2
    start = max(number for number, line in enumerate(told[:end]) if TOLD_FROM.search(line))
    shown = "\n".join(of_command("trace show pump"))
    return page.replace(shown, "\n".join(["...", *told[start:end], "..."]))


def main() -> None:
    """Carry out the run of the walk, and write what it comes to."""
    said = [line.removeprefix(SAID) for line in commands() if line.startswith(SAID)]
    with tempfile.TemporaryDirectory() as folder:
        run = handeye.assemble(SEED, out=folder)
        heard = "\n".join(transcript(begun(Path(folder)), said)).splitlines()
    page = with_answers(PAGE.read_text(encoding="utf-8"), heard)
    PAGE.write_text(with_account(page, list(account(run.events))), encoding="utf-8")


if __name__ == "__main__":
    main()
