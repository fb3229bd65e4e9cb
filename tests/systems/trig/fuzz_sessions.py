"""Drawn sessions of TRIG: somebody types anything, and nothing but sentences may come of it.

python tests/systems/trig/fuzz_sessions.py 100000 [--first 0]

A session that goes wrong is told with its number, by which it can be typed again, and its lines.
"""

import argparse
import os
import random
import sys
import tempfile
import traceback
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final

from handeye.core.errors import HandeyeError, InvalidInput
from handeye.systems.trig.language.arguments import Kind
from handeye.systems.trig.language.command_input import hear
from handeye.systems.trig.language.command_table import COMMANDS, TrigCommand
from handeye.systems.trig.language.desk import Button, Cancelled, Desk, Jog
from handeye.systems.trig.language.display import full_display, partial_display
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.place import is_named
from handeye.systems.trig.language.running import Interpreter
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.storage import decoded, encoded, faults
from handeye.systems.trig.language.styled import plain

LINES: Final = 35
"""Of a session, at most."""
LONGEST: Final = 150
"""Steps of a run, after which somebody strikes a key."""
WATCHED: Final = 0.1
"""How often what always holds is looked for after a line: it takes longer than the line."""
RARE: Final = ("Q", "EX", "FLUSH", "R", "DA", "W", "FREE", "CALPOS", "GOGRASP", "GOUNGRASP")
COMMON: Final = ("M", "MR", "MG", "GRASP", "LOOP", "LOOP", "CN", "CN", "RUN", "L", "GOTO", "SAVPOS", "D")
OF_KIND: Final[dict[Kind, tuple[str, ...]]] = {
    "position": ("A", "B", "C", "-A", "9X", "ÄÖ", "A" * 41),
    "signed": ("A", "B", "C", "-A", "-B", "--A", "-"),
    "step": ("S1", "S2", "S3", "S4", "S5", "**TOP**", "***"),
    "branch": ("n", "g", "N", "x"),
    "count": ("1", "2", "3", "4", "-1", "-3", "20", "1000", "-1000", "0", "1e9", "99999999999", "½"),
    "threshold": ("2", "0", "1.5", "-1", "nan", "1e400"),
    "vector": ("(0 0 1)", "(1 0 0)", "(0, 0, 2)", "0 0 1", "(0 0)", "(0 0 0)", "(a b c)"),
    "file": ("f", "g", "no/where", ".", "..", "f.trig.json"),
}
"""Words of each kind; the first few are of use."""
USEFUL: Final = 3
NOISE: Final = (
    "",
    ";",
    ">",
    "\x00",
    "GRASP GRASP",
    "HELP",
    "HELP M",
    "HELP X",
    "* STACK 5 X 0 Y 0",
    "* X",
    "é",
    "X 1",
)


class Somebody(Desk):
    """Answers, drives and strikes keys as chance has it."""

    def __init__(self, chance: random.Random) -> None:
        self.chance, self.steps = chance, 0

    def answer(self, question: str) -> str:
        if self.chance.random() < 0.05:
            raise Cancelled
        if self.chance.random() < 0.1:
            return self.chance.choice(NOISE)
        if "Threshold" in question:
            return "2"
        if "vector" in question:
            return "(0 0 1)"
        return self.chance.choice("ng" if "ormal" in question else ("Yes", "Yes", "Yes", "No"))

    def press(self) -> Button:
        draw = self.chance.random()
        if draw < 0.5:
            return "record"
        if draw < 0.53:
            return "kill"
        if draw < 0.55:
            raise Cancelled
        return Jog(
            self.chance.randrange(3), self.chance.choice((-0.04, -0.01, 0.01, 0.02, 0.9)), by=draw < 0.9
        )

    def tell(self, sentence: str) -> None:
        check_sentence(sentence)

    def wrong(self, error: InvalidInput) -> None:
        check_sentence(str(error))

    def halted(self) -> bool:
        self.steps += 1
        return self.steps % LONGEST == 0 or self.chance.random() < 0.01


class DrawnSession:
    """A session by its number."""

    def __init__(self, number: int) -> None:
        self.chance = random.Random(number)  # noqa: S311 - no secret
        self.made = Session(arm=(arm := NoArm()), table=arm, desk=Somebody(self.chance))
        self.made.arm.hand(False)
        self.lines: list[str] = []

    def carry_out(self) -> None:
        """Type lines until somebody leaves, or has typed enough; then go back to the beginning."""
        hear(self.made, "* STACK 4 X 0 Y 0")
        while not self.made.over and len(self.lines) < LINES:
            self.lines.append(self._line())
            watched = self.chance.random() < WATCHED
            before = encoded(self.made.program) if watched else b""
            try:
                hear(self.made, self.lines[-1])
            except HandeyeError as error:
                check_sentence(str(error))
                if watched and not self.lines[-1].startswith("RUN"):
                    assert encoded(self.made.program) == before, "it was refused and has changed the program"
            if watched:
                check(self.made)
        check(self.made)
        check_back(self.made)

    def _line(self) -> str:
        chance = self.chance
        if chance.random() < 0.04:
            return chance.choice(NOISE)
        word = chance.choice(COMMON if chance.random() < 0.6 else [*COMMANDS])
        if word in RARE and chance.random() < 0.8:
            word = "UNGRASP"
        return self._command(COMMANDS[word])

    def _command(self, command: TrigCommand) -> str:
        count = self.chance.randint(command.needs, len(command.takes))
        kinds: Sequence[Kind] = command.takes[:count]
        if (
            kinds[-1:] == ("branch",)
            and self.made.program.active.type != "guarded"
            and self.chance.random() < 0.9
        ):
            kinds = kinds[:-1]
        if self.chance.random() < 0.03:
            kinds = [*kinds, self.chance.choice([*OF_KIND])]
        return " ".join([command.word, *map(self._word, kinds)])

    def _word(self, kind: Kind) -> str:
        """A word of a kind: something that there is, something of use, or anything."""
        draw, program = self.chance.random(), self.made.program
        known = {
            "step": [node.name for node in program.graph.nodes.values() if node.name],
            "position": [name for name in program.positions if is_named(name)],
        }.get("position" if kind == "signed" else kind)
        if known and draw < 0.6:
            return self.chance.choice(known)
        if kind == "branch" and draw < 0.8:
            return "ng"[program.active.type == "guarded" and draw < 0.4]
        return self.chance.choice(OF_KIND[kind][:USEFUL] if draw < 0.9 else OF_KIND[kind])


def check(made: Session) -> None:
    """What holds after every line."""
    program = made.program
    found = next(faults(program.graph, program.positions), None)
    assert found is None, found
    assert program.cursor in program.graph
    assert program.active.shown or program.cursor == 0
    for width, height in ((80, 12), (20, 3)):
        lines = partial_display(program, width, height)
        text = f"{plain(lines)}\n{plain(full_display(program, width, 5))}"
        assert len(lines) <= height
        assert max(map(len, text.split("\n"))) <= width, text
        actives = sum(style == "active" for line in lines for style, _ in line)
        assert actives == 1, f"{actives} cursors"


def check_back(made: Session) -> None:
    """A program that is written can be read, and what was done can be undone, or an obstacle is met."""
    program = made.program
    read = decoded(encoded(program), "f")
    for position in program.positions.values():
        position.data = position.init
    for node in program.graph.nodes.values():
        node.count = 0
    assert encoded(read) == encoded(program)
    runner = Interpreter(program=program, arm=made.arm, halted=lambda: False, refresh=lambda: None)
    whole = all(done.node in program.graph for done in program.trail)
    ran = runner.back(10**9)
    assert ran.end in ("beginning" if whole else "deleted", "stopped"), ran


def check_sentence(text: str) -> None:
    """Sentences that a terminal may show."""
    assert text.replace("\n", "").isprintable(), repr(text)
    assert text


def carried_out(number: int, tell: Callable[[str], object]) -> bool:
    """Whether a session goes as it should; if not, it is told."""
    drawn = DrawnSession(number)
    try:
        drawn.carry_out()
    except Exception:
        tell("\n".join([f"session {number}:", *drawn.lines, traceback.format_exc()]))
        return False
    return True


def main() -> int:
    """Draw sessions, and tell of those that go wrong."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("count", type=int, help="sessions")
    parser.add_argument("--first", type=int, default=0, help="number of the first")
    wanted = parser.parse_args()
    wrong, home = 0, Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for number in range(wanted.first, wanted.first + wanted.count):
            wrong += not carried_out(number, sys.stdout.write)
            if number % 1000 == 999:
                sys.stderr.write(f"{number + 1 - wanted.first} sessions, {wrong} wrong\n")
        os.chdir(home)
    sys.stdout.write(f"{wanted.count} sessions, {wrong} wrong\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
