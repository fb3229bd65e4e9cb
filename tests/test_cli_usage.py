"""A command line that is wrong is told in one sentence, which names what may have been meant."""

import pytest
from conftest import Command

WRONG = {
    "frobnicate": "there is no command `frobnicate` (see `handeye --help`)",
    "asemble": "there is no command `asemble`; did you mean `assemble`? (see `handeye --help`)",
    "trace shw": "there is no command `shw`; did you mean `show`? (see `handeye trace --help`)",
    "--hlep": "there is no option `--hlep`; did you mean `--help`? (see `handeye --help`)",
    "assemble --sed 3": "`assemble` has no option `--sed`; did you mean `--seed`? (see `handeye assemble --help`)",
    "world --no-json": "`world` has no option `--no-json`; did you mean `--json`? (see `handeye world --help`)",
    "fmt --chek": "`fmt` has no option `--chek`; did you mean `--check`?",
    "check": "`check` needs FILE (see `handeye check --help`)",
    "trace photograph run": "`trace photograph` needs --at (see `handeye trace photograph --help`)",
    "run job.json --break": "--break needs a value (see `handeye run --help`)",
    "trace photograph run -o": "-o needs a value (see `handeye trace photograph --help`)",
    "plan a.al --output b": "`plan` has no option `--output` any more: --out, or -o, gives the file or folder to write "
    "(see `handeye plan --help`)",
    "faults --workers 3": "`faults` has no option `--workers` any more: --jobs sets the number of processes "
    "(see `handeye faults --help`)",
    "render -o it.png --width 64": "`render` has no option `--width` any more: --size sets width and height, as in "
    "1280x960 "
    "(see `handeye render --help`)",
    "trials base 100": "`trials base` takes the number of trials as --n 100 (see `handeye trials base --help`)",
    "check a b": "`check` does not take `b` (see `handeye check --help`)",
    "assemble --seed 1 --seed 2": "--seed is given more than once (see `handeye assemble --help`)",
    "assemble --json=maybe": "--json takes no value, but `maybe` was given (see `handeye assemble --help`)",
    "run p --camera film": "--camera must be one of auto, gl, ray, not `film` (see `handeye run --help`)",
    "trials base --n 1.5": "--n: `1.5` is not a whole number (see `handeye trials base --help`)",
    "trials base --n 1_0": "--n: `1_0` is not a whole number (see `handeye trials base --help`)",
    "assemble --seed ١": "--seed: `١` is not a whole number (see `handeye assemble --help`)",
    "trace photograph run --at noon -o it.png": "--at is a number; `noon` is not (see `handeye trace photograph "
    "--help`)",
}
"""Command lines, and what is said of them."""


@pytest.mark.parametrize("line", WRONG)
def test_a_wrong_command_line_is_told_in_a_sentence(command: Command, line: str) -> None:
    assert command(*line.split()) == (2, "", f"handeye: {WRONG[line]}\n")
