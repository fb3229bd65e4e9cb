"""Drawn MAL programs: good ones, mangled ones, noise; `python tests/systems/sigma/fuzz_mal.py 20000` draws many.

Whatever a text holds, checking it gives diagnostics, running it ends in words, and nothing is raised.
"""

import random
import sys
from pathlib import Path
from typing import Final

sys.path.insert(0, str(Path(__file__).parent))
from mal_bench import PLANS

from handeye.core.diagnostics import render
from handeye.core.source import Source
from handeye.systems.sigma.machine.perfect import PerfectMotors
from handeye.systems.sigma.mal.compiler import compile_source
from handeye.systems.sigma.mal.interleavings import interleavings
from handeye.systems.sigma.mal.language import LANGUAGE
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.mal.words import WORDS

MOST_STATEMENTS: Final = 150
NAMES: Final = ("A", "B", "I", "J", "HEIGHT", "READY", "FREE", "LEFT", "RIGHT", "A" * 60)
AXES: Final = ("X1", "Y1", "Z1", "X2", "Y2", "Z2")
NOISE: Final = (
    *WORDS, *NAMES, *AXES, *"+-*/=<>(),;\"'.:%&\\\t\0\x1b\x7fäß\u2028\U0001f916", "<>", "<=", "1E99", "1E308",
    "9" * 400,
    "(" * 60, "NOT " * 60, "- " * 60, "IF 1 = 1 THEN " * 40, "\r", "\n", "1.", ".5", "HAND1", "DIM",
)  # fmt: skip


def number(draw: random.Random) -> str:
    return draw.choice(("0", "1", "2", "5", "-3", "0.5", "300", "1000", "1E30", "65536"))


def expression(draw: random.Random, depth: int = 0) -> str:
    kind = draw.randrange(9 if depth < 4 else 4)
    if kind < 2:
        return number(draw)
    if kind < 4:
        return draw.choice(NAMES)
    if kind < 7:
        return f"{expression(draw, depth + 1)} {draw.choice('+-*/')} {expression(draw, depth + 1)}"
    if kind == 7:
        function = draw.choice(("ABS", "INT", "SGN", "SQR", "BEAM"))
        return f"{function}({expression(draw, depth + 1)})"
    return draw.choice(
        (f"POS({draw.choice(AXES)})", f"FORCE({draw.choice(AXES)})", "TIME", f"STATUS({draw.choice(AXES)})")
    )


def statement(draw: random.Random, lines: int, depth: int = 0) -> str:
    name, line, value, axis = (
        draw.choice(NAMES),
        draw.randrange(1, lines + 2) * 10,
        expression(draw),
        draw.choice(AXES),
    )
    forms = [
        f"{name} = {value}", f"GOTO {line}", f"GOSUB {line}", "RETURN", f"FOR I = 1 TO {value}", "NEXT I", "END",
        "STOP",
        f"SET {name}", f"RESET {name}", f"WAIT {name}", f"TAKE {name}", f"DELAY {value}", f"MOVE {axis} TO {value}",
        f"MOVE {axis} BY {value}, {draw.choice(AXES)} TO {value} LINE", f"MOVE {axis} BY 5 SLOW {value} NOWAIT",
        f"ORIGIN {axis}", f"SPEED {axis}, {value}", f"CURVE {axis}, {value}", f"LIMIT {axis}, STANDARD",
        f"LIMIT {axis}, {value}", f"ACTUATE HAND1 = {value}", f"ON ABORT GOTO {line}", "RESUME", f"START {name}",
        f"KILL {name}", f'PRINT "A", {value};', f"INPUT {name}", f"TASK {name}", "REM WHAT IS LEFT",
    ]  # fmt: skip
    if depth < 3:
        then = draw.choice((str(line), statement(draw, lines, depth + 1)))
        forms += [f"IF {value} > {expression(draw)} THEN {then}"] * 4
    return draw.choice(forms)


def program(draw: random.Random) -> str:
    lines = draw.randrange(1, 10)
    return "\n".join(f"{10 * n} {statement(draw, lines)}" for n in range(1, lines + 1))


def mangled(draw: random.Random, text: str) -> str:
    for _ in range(draw.randrange(1, 8)):
        at = draw.randrange(len(text) + 1)
        cut = at + draw.randrange(3)
        text = text[:at] + draw.choice((draw.choice(NOISE), "", text[at : at + 20])) + text[cut:]
    return text


def drawn(seed: int) -> str:
    """A text."""
    draw = random.Random(seed)  # noqa: S311 - it keeps no secret
    kind = draw.randrange(4)
    if kind == 0:
        texts = (program(draw) for _ in range(30))
        return next(
            (text for text in texts if compile_source(Source(name="", text=text))[0] is not None), "10 END"
        )
    if kind == 1:
        return mangled(draw, program(draw))
    if kind == 2:
        file = draw.choice(sorted(PLANS.glob("*.mal")))
        return mangled(draw, file.read_text(encoding="utf-8"))
    return "".join(draw.choice(NOISE) + draw.choice(("", " ", "\n10 ")) for _ in range(draw.randrange(1, 40)))


def carried_out(seed: int) -> str:
    """What comes of a text: `errors`, `ended`, `stands` or `goes on`."""
    source = Source(name="drawn.mal", text=drawn(seed))
    compiled, found = compile_source(source)
    for each in found:
        assert render(each, source)
        assert each.help
    LANGUAGE.words(source, len(source.text) // 2)
    if compiled is None:
        return "errors"
    tidy = LANGUAGE.formatted(source.text)
    assert LANGUAGE.formatted(tidy) == tidy
    if not compiled.lines:
        return "ended"
    if seed % 5 == 0:
        interleavings(compiled, 60)
    vm = VirtualMachine(compiled, PerfectMotors())
    vm.begin()
    for _ in range(MOST_STATEMENTS):
        if not vm.turn:
            break
        vm.statement()
        vm.settle()
    if vm.memory.fault is not None:
        assert "\n" not in vm.memory.fault.told
        return "stands"
    return "goes on" if vm.memory.tasks else "ended"


if __name__ == "__main__":
    from collections import Counter

    count = Counter(carried_out(seed) for seed in range(int(sys.argv[1])))
    print(count)  # noqa: T201 - a command
