"""Drawn ML programs: good ones, mangled ones, noise; `python tests/systems/ml/fuzz_ml.py 10000` draws many.

Each text is drawn from a seed of its own. So `--first 4000` continues after the text of seed 3999.

Whatever a text holds, checking it gives diagnostics, typing or running it ends in words, and nothing else is raised.
"""

import argparse
import random
import sys
import traceback
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Final

sys.path.insert(0, str(Path(__file__).parent))
from ml_bench import PLANS

from handeye.core.diagnostics import has_errors, render
from handeye.core.errors import InvalidInput
from handeye.core.source import Source
from handeye.systems.ml.language.assembler import assembled
from handeye.systems.ml.language.check import checked
from handeye.systems.ml.language.commands import COMMANDS
from handeye.systems.ml.language.language import LANGUAGE
from handeye.systems.ml.machine.surroundings import Stimulus
from handeye.systems.ml.ml_api import Ml
from handeye.systems.ml.tables.layout import SHAPES

MOST_STATEMENTS: Final = 80
NUMBERS: Final = ("0", "1", "2", "3", "5", "-1", "9", "12", "300", "-1000", "32767", "-32768", "5000")
USUAL: Final = (
    "SENSOR",
    "DMOTOR",
    "DMOVE",
    "BRANCH",
    "ADD",
    "LOAD",
    "PRINT",
    "POINT",
    "GT?",
    "BRCOMP",
    "DELAY",
)
STARTS: Final = ("RUN", "TRY", "BRANCH", "GOSUB", "BR", "IF")  # typed, they may run a program without end
NOISE: Final = (
    *COMMANDS, *NUMBERS, *"-&*+.,;:\"'%\\\t\0\x1b\x7fäß\u2028\U0001f916", "&&&", "&&&&&&1", "&257", "9" * 400, "&" * 90,
    "\r", "\n", "\n10 ", "1.", "1E9", "- & 3", "* 1 2 3", "A" * 60, "IF", "EQU 5", "X VAR", "L:",
)  # fmt: skip


def parameter(draw: random.Random, kind: str) -> str:
    if draw.random() < 0.15:
        return draw.choice(("&1", "-&2", "&&3", "&&&&&&4", "&200"))
    if kind == "table":
        return draw.choice([*SHAPES])
    if kind == "statement":
        return str(10 * draw.randrange(1, 12))
    if kind in ("motor", "sensor", "line", "word", "variable") and draw.random() < 0.8:
        return str(draw.randrange(1, 12))
    return draw.choice(NUMBERS)


def statement(draw: random.Random, wild: float) -> str:
    command = COMMANDS[draw.choice([*COMMANDS] if draw.random() < wild else USUAL)]
    count = draw.choice(sorted(command.counts))
    return " ".join((command.code, *(parameter(draw, command.kind(at)) for at in range(count))))


def program(draw: random.Random) -> str:
    wild = draw.choice((0.0, 0.5, 0.9))
    return "\n".join(f"{10 * n} {statement(draw, wild)}" for n in range(1, draw.randrange(2, 12)))


def mangled(draw: random.Random, text: str) -> str:
    for _ in range(draw.randrange(1, 8)):
        at = draw.randrange(len(text) + 1)
        cut = at + draw.randrange(3)
        text = text[:at] + draw.choice((draw.choice(NOISE), "", text[at : at + 20])) + text[cut:]
    return text


def drawn(seed: int) -> str:
    """A text."""
    draw = random.Random(seed)  # noqa: S311 - it keeps no secret
    match draw.randrange(4):
        case 0:
            return program(draw)
        case 1:
            return mangled(draw, program(draw))
        case 2:
            file = draw.choice(sorted(PLANS.glob("*.ml")))
            return mangled(draw, file.read_text(encoding="utf-8"))
    return "".join(draw.choice(NOISE) + draw.choice(("", " ", "\n10 ")) for _ in range(draw.randrange(1, 40)))


def typed(ml: Ml, line: str) -> bool:
    """Type a line; False if it is refused."""
    try:
        ml.do(line)
    except InvalidInput as error:
        told = str(error)
    else:
        return True
    assert "\n" not in told
    return False


def outcome(seed: int) -> str:
    """What comes of a text: `errors`, `ended`, `stopped` or `goes on`."""
    text = drawn(seed)
    source = Source(name="drawn.ml", text=text)
    found = checked(source)[1]
    for each in (*found, *assembled(source)[1]):
        assert render(each, source)
        assert each.help
    LANGUAGE.words(source, len(text) // 2)
    tidy = LANGUAGE.formatted(text)
    assert LANGUAGE.formatted(tidy) == tidy
    ml = Ml(stimuli=[Stimulus(channel="right_strain_x", value=5, motor=3, beyond=200)])
    refused = False
    for line in text.split("\n"):
        if line.strip() and not line.lstrip().upper().startswith(STARTS):
            refused = not typed(ml, line) or refused
    try:
        ml.begin()
    except InvalidInput:
        return "errors"
    going = ml.step(MOST_STATEMENTS)
    assert ml.do("LIST") == ml.listing
    if ml.stopped:
        assert "\n" not in ml.stopped
        return "stopped"
    return "goes on" if going else "errors" if refused or has_errors(found) else "ended"


def counted(seed: int, tell: Callable[[str], object]) -> str:
    """What comes of a text: its outcome, or `wrong`, and then it is told."""
    try:
        return outcome(seed)
    except Exception:
        tell(f"seed {seed}:\n{traceback.format_exc()}")
        return "wrong"


def main() -> int:
    """Draw texts, and tell of those that go wrong."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("count", type=int, help="texts")
    parser.add_argument("--first", type=int, default=0, help="seed of the first")
    wanted = parser.parse_args()
    outcomes: Counter[str] = Counter()
    for seed in range(wanted.first, wanted.first + wanted.count):
        outcomes[counted(seed, sys.stdout.write)] += 1
        if seed % 100 == 99:
            sys.stderr.write(f"{outcomes.total()} texts, to seed {seed}: {dict(outcomes)}\n")
    sys.stdout.write(f"{outcomes.total()} texts: {dict(outcomes)}\n")
    return 1 if outcomes["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
