"""Checks `handeye check --prove` with programs whose verdict is known: holes planted in the pump's program by rule, and
variants of it that are as sound as the program itself.

The rules know the text of the program, and nothing of the prover. A hole is a check that is missing: one that
docs/care.md names as the last check of a part. `CHECKS` and `CALLS` are that table.
"""

import random
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final, NamedTuple

from handeye.al import compile_text
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.program.taught import Taught, load_taught
from handeye.proof.obligation import Obligation
from handeye.proof.proof import Proof, prove

CHECKS: Final = (
    ("SCREW", "HEIGHT  DS"), ("SCREW", "TRAVEL  .2 .3"), ("TIGHTEN", "CHANGE  [0 0 -1] .5"),
    ("RACKED", "HEIGHT  TABLE"), ("PRESS", "HEIGHT  TABLE"), ("FLATNESS", "HEIGHT  FACE1"),
    ("FLATNESS", "HEIGHT  FACE5"),
    ("FLATNESS", "HEIGHT  TABLEL"), ("HEAD", "HEIGHT  OVER .493"), ("NUDGE", "TRAVEL  .2 .4"),
    ("PLUGGED", "HEIGHT  TABLE"), ("SWEEP", "TURN    AXIS"), ("BEARING", "HEIGHT  BARE"),
    ("", "INSPECT PUMP"), ("", "MATCH   PUMP"),
)  # fmt: skip
"""Macro, or the empty text for the stages, and the beginning of the statement that checks."""
CALLS: Final = (
    "FLATNESS",
    "HEADS",
    "ROTATION",
    "LAYERS",
    "TOOLS",
    "BEARING",
    "RACKED",
    "PLUGGED",
    "HEAD",
    "TIGHTEN",
    "SWING",
    "NUDGE",
    "PRESS",
)
GUARDS: Final = ("STANDS", "PRESS", "FLATNESS", "HEAD", "NUDGE", "SWEEP", "BEARING", "TIGHTEN")
"""Macros whose guards a hole loosens: those that feel what is checked last."""

_STATEMENT: Final = re.compile(r"^(?P<label>[A-Z0-9]+:)?(?P<gap>\s+)(?P<body>[A-Z][^;]*?)(?P<end>\s*(;.*)?)$")


class Planted(NamedTuple):
    """A program with its taught positions, and the rule that made it."""

    rule: str
    text: str
    taught: Taught


@dataclass(frozen=True, slots=True)
class Script:
    """The lines of a script, each with its macro; the empty text stands for the stages."""

    lines: tuple[str, ...]
    macros: tuple[str, ...]
    taught: Taught

    @classmethod
    def of(cls, text: str, taught: Taught) -> "Script":
        """Read the text of a script."""
        lines, macros, macro = text.split("\n"), [], ""
        for line in lines:
            macro = line.split()[1] if line.startswith("DEFINE") else macro if line.strip() else ""
            macros.append(macro)
        return cls(tuple(lines), tuple(macros), taught)

    def body(self, number: int) -> str:
        """Return the statement of a line without label and comment; empty if there is none."""
        found = _STATEMENT.match(self.lines[number])
        return "" if found is None or self.lines[number].startswith("DEFINE") else found["body"]

    def label(self, number: int) -> str:
        found = _STATEMENT.match(self.lines[number])
        return "" if found is None else found["label"] or ""

    def named(self, number: int) -> str:
        """Return a line in words, for the name of a rule."""
        inside = f" in {self.macros[number]}" if self.macros[number] else ""
        return f"line {number + 1} {' '.join(self.body(number).split())}{inside}"

    def calls(self, words: Sequence[str]) -> list[int]:
        """Return the lines that call one of some macros."""
        return [number for number in range(len(self.lines)) if self.body(number).split(" ")[0] in words]

    def checks(self) -> list[int]:
        """Return the lines with the statements in `CHECKS`."""
        return [
            number
            for macro, start in CHECKS
            for number in range(len(self.lines))
            if self.macros[number] == macro and self.body(number).startswith(start)
        ]

    def changed(self, rule: str, first: int, last: int, lines: Sequence[str]) -> Planted:
        """Replace the lines from `first` to `last`."""
        return Planted(rule, "\n".join([*self.lines[:first], *lines, *self.lines[last + 1 :]]), self.taught)


def script() -> Script:
    """Return the pump's program."""
    text = (plans() / "water_pump.al").read_text(encoding="utf-8")
    return Script.of(text, load_taught(plans() / "water_pump.toml"))


def verdict(planted: Planted, obligations: Sequence[Obligation]) -> Proof:
    """Compile a program, and prove it. It must compile."""
    program, diagnostics = compile_text(Source(name="planted.al", text=planted.text), planted.taught)
    assert program is not None, (planted.rule, [each.message for each in diagnostics])
    return prove(program, obligations)


# --- holes ---------------------------------------------------------------------------------------


def holes(of: Script) -> list[Planted]:
    """Return all holes that the rules make."""
    last = {
        of.body(number).split(" ")[0]: number for number in of.calls(("BLOCKS",)) if not of.macros[number]
    }
    calls = [*of.calls(CALLS), *last.values()]
    found = [each for number in calls if _matters(of, number) for each in _call_holes(of, number)]
    found += [each for number in of.checks() for each in _check_holes(of, number)]
    return [*found, *_guard_holes(of)]


def _matters(of: Script, number: int) -> bool:
    """Return True unless care.md names a later step that checks the same: the screwdriver is also felt before it is
    taken, and the rotor also turned in stage 11."""
    word = of.body(number).split(" ")[0]
    return not (word == "RACKED" and of.macros[number] == "DRIVER") and not (
        word == "SWING" and not of.macros[number]
    )


def _call_holes(of: Script, number: int) -> Iterator[Planted]:
    call, label, name = of.body(number), of.label(number), of.named(number)
    kept = f"{label}\tWHERE" if label else "\tWHERE"
    yield of.changed(f"removed: {name}", number, number, [kept])
    yield of.changed(f"jumped over: {name}", number, number, [kept, "\tJUMP ZZ1", f"\t{call}", "ZZ1:\tWHERE"])
    yield of.changed(
        f"left out after an error: {name}", number, number,
        [kept, "\tMOVE PARK", "\tSKIPN 4", "\tJUMP ZZ1", f"\t{call}", "ZZ1:\tWHERE"],
    )  # fmt: skip
    yield of.changed(
        f"counted out: {name}", number, number,
        [kept, "\tASSIGN ZZN 2", "\tSOJG ZZN ZZ1", f"\t{call}", "ZZ1:\tWHERE"],
    )  # fmt: skip
    yield of.changed(
        f"in a loop of no round: {name}", number, number,
        [kept, "\tASSIGN ZZN 1", "\tJUMP ZZ1", f"ZZ2:\t{call}", "ZZ1:\tSOJG ZZN ZZ2"],
    )  # fmt: skip


def _check_holes(of: Script, number: int) -> Iterator[Planted]:
    name, body = of.named(number), of.body(number)
    first, second = of.body(number + 1), of.body(number + 2)
    if re.match("HEIGHT|TRAVEL|INSPECT|MATCH", body):
        kept = f"{of.label(number)}\tWHERE"
        yield of.changed(f"removed: {name}", number, number, [kept])
    if limits := re.fullmatch(r"(.*?)(-?[\d.]+)(\s+)(-?[\d.]+)", body):
        low, high = float(limits[2]), float(limits[4])
        middle, half = (low + high) / 2, 2 * (high - low)
        least = max(middle - half, 0.0) if body.startswith("TRAVEL") else middle - half
        wide = f"{of.label(number)}\t{limits[1]}{least:.4f} {middle + half:.4f}"
        yield of.changed(f"limits four times as wide: {name}", number, number, [wide])
    if re.match(r"SKIP[EN]\s", first) and second.split(" ")[0] in ("JUMP", "WAIT"):
        test = of.lines[number + 1]
        if first.startswith("SKIPN"):  # its error leads to the next line
            ignored = [f"{of.label(number + 2)}\tJUMP ZZ1", "ZZ1:\tWHERE"]
        else:  # its error skips the next line
            test = test.replace("SKIPE", "SKIPN")
            ignored = [of.lines[number + 2]] * 2
        lines = [of.lines[number], test, *ignored]
        yield of.changed(f"its error ignored: {name}", number, number + 2, lines)


def _guard_holes(of: Script) -> Iterator[Planted]:
    for number, line in enumerate(of.lines):
        if of.macros[number] not in GUARDS:
            continue
        if re.match(r"STOP\s+[\[\d]", of.body(number)):
            loose = re.sub(r"-?\d+", lambda found: str(4 * int(found[0])), of.body(number))
            yield of.changed(
                f"guard four times as strong: {of.named(number)}", number, number, [f"\t{loose}"]
            )
        if of.body(number).startswith("TORQUE"):
            loose = line.replace("42", "90")
            yield of.changed(f"torque stop twice as strong: {of.named(number)}", number, number, [loose])


# --- sound variants ------------------------------------------------------------------------------


def variants(of: Script) -> list[Planted]:
    """Return all variants that the rules make."""
    rules: tuple[Callable[[Script], Iterator[Planted]], ...] = (
        _renamed, _inlined, _swapped, _repeated, _counted, _narrowed, _turned_round, _stopping,
    )  # fmt: skip
    return [each for rule in rules for each in rule(of)]


def _renamed(of: Script) -> Iterator[Planted]:
    text = "\n".join(of.lines)
    labels = sorted({of.label(number)[:-1] for number in range(len(of.lines))} - {""})
    macros = sorted({name for name in of.macros if name})
    counters = sorted(set(re.findall(r"ASSIGN\s+(\w+)", text)))
    saved = sorted(set(re.findall(r"\bSAVE\s+(\w+)", text)) - set(of.taught.positions) - {"H"})
    for what, names in (
        ("labels", labels),
        ("macros", macros),
        ("counters", counters),
        ("differences", saved),
    ):
        words = _words_after(what)
        changed = re.sub(words, lambda found: _other(found, names), text, flags=re.MULTILINE)  # noqa: B023
        yield Planted(f"renamed: {what}", changed, of.taught)
    positions = {f"{name}_X" if name != "PARK" else name: each for name, each in of.taught.positions.items()}
    names = sorted(set(of.taught.positions) - {"PARK"} - set(labels) - set(macros))
    code = "\n".join(
        re.sub(r"^[^;]*", lambda found: re.sub(rf"\b({'|'.join(names)})\b(?!:)", r"\1_X", found[0]), line)
        for line in of.lines
    )
    kept = {**of.taught.positions, **positions}
    yield Planted("renamed: positions", code, replace(of.taught, positions=kept))


def _words_after(what: str) -> str:
    """Return the pattern of the places at which names of some kind stand."""
    return {
        "labels": r"^()(\w+)(?=:)|(\b(?:JUMP|AOJ)\s+|\bSOJG\s+\w+\s+|\b(?:PRESS\s+\w+\s+))(\w+)",
        "macros": r"^(DEFINE\s+)(\w+)|(^(?:\w+:)?\s+)(\w+)(?=[\s;]|$)",
        "counters": r"()(?!)()|(\b(?:ASSIGN|SOJG)\s+)(\w+)",
        "differences": r"()(?!)()|(\b(?:SAVE|RESTORE|HEIGHT)\s+|\bSCREW\s+\w+\s+\w+\s+|\bHEAD\s+\w+\s+)(\w+)",
    }[what]


def _other(found: "re.Match[str]", names: Sequence[str]) -> str:
    before, name = (found[1] or "", found[2]) if found[2] else (found[3] or "", found[4])
    return f"{before}{name}_X" if name in names else found[0]


def _inlined(of: Script) -> Iterator[Planted]:
    for number in of.calls(sorted({name for name in of.macros if name})):
        word, *operands = _operands(of.body(number))
        head = next(n for n, line in enumerate(of.lines) if re.match(rf"DEFINE\s+{word}\b", line))
        inside = [n for n in range(head + 1, len(of.lines)) if of.macros[n] == word]
        names = _operands(_uncommented(of.lines[head]))[2:]
        labels = {of.label(n)[:-1] for n in inside} - {""}
        body = [_filled(of.lines[n], dict(zip(names, operands, strict=True)), labels) for n in inside]
        label = [f"{of.label(number)}\tWHERE"] if of.label(number) else []
        yield of.changed(f"inlined: {of.named(number)}", number, number, [*label, *body])


def _uncommented(line: str) -> str:
    return line.split(";")[0]


def _operands(text: str) -> list[str]:
    return re.findall(r"\[[^\]]*\]|\S+", text)


def _filled(line: str, operands: dict[str, str], labels: set[str]) -> str:
    def word(found: "re.Match[str]") -> str:
        name = found[0]
        return operands.get(name, f"{name}_Y" if name in labels else name)

    parts = re.split(r'("[^"]*"|;.*)', line)
    filled = [
        re.sub(r"\b[A-Z]\w*\b", word, part) if not part.startswith(('"', ";")) else part for part in parts
    ]
    return re.sub(r"\{(\w+)\}", lambda found: operands.get(found[1], found[0]), "".join(filled))


def _swapped(of: Script) -> Iterator[Planted]:
    """Swap neighbouring calls of the same macro that check different parts."""
    for number in of.calls(("HEAD", "PLUGGED", "TIGHTEN")):
        if of.body(number + 1).split(" ")[0] == of.body(number).split(" ")[0]:
            pair = [of.lines[number + 1], of.lines[number]]
            yield of.changed(f"swapped: {of.named(number)} and the next", number, number + 1, pair)
    for number in of.calls(("LAYERS",)):
        if of.body(number + 1).startswith("TOOLS"):
            yield of.changed("swapped: LAYERS and TOOLS", number, number + 1, ["\tTOOLS", "\tLAYERS"])


def _repeated(of: Script) -> Iterator[Planted]:
    for number in of.calls(
        ("HEAD", "PLUGGED", "TIGHTEN", "BLOCKS", "HEADS", "LAYERS", "TOOLS", "RACKED", "BEARING")
    ):
        if of.macros[number] != "DRIVER":
            again = [of.lines[number], f"\t{of.body(number)}"]
            yield of.changed(f"made twice: {of.named(number)}", number, number, again)


def _counted(of: Script) -> Iterator[Planted]:
    for number in of.calls(CALLS):
        call, label = of.body(number), of.label(number)
        kept = f"{label}\tASSIGN ZZN"
        yield of.changed(
            f"counted in: {of.named(number)}", number, number,
            [f"{kept} 1", "\tSOJG ZZN ZZ1", f"\t{call}", "ZZ1:\tWHERE"],
        )  # fmt: skip
        yield of.changed(
            f"in a loop of two rounds: {of.named(number)}", number, number,
            [f"{kept} 3", "\tJUMP ZZ1", f"ZZ2:\t{call}", "ZZ1:\tSOJG ZZN ZZ2"],
        )  # fmt: skip


def _narrowed(of: Script) -> Iterator[Planted]:
    for number in of.checks():
        if limits := re.fullmatch(r"(.*?)(-?[\d.]+)(\s+)(-?[\d.]+)", of.body(number)):
            low, high = float(limits[2]), float(limits[4])
            middle, half = (low + high) / 2, 0.45 * (high - low)
            narrow = f"{of.label(number)}\t{limits[1]}{middle - half:.4f} {middle + half:.4f}"
            yield of.changed(f"narrower: {of.named(number)}", number, number, [narrow])


def _turned_round(of: Script) -> Iterator[Planted]:
    """Write `SKIPN e, WAIT` as `SKIPE e, JUMP on, WAIT`, which has the same effect."""
    for number in range(len(of.lines) - 2):
        if re.match(r"SKIPN\s", of.body(number)) and of.body(number + 1).startswith("WAIT"):
            if of.label(number + 1) or not of.body(number + 2):
                continue
            turned = [
                of.lines[number].replace("SKIPN", "SKIPE"),
                "\tJUMP ZZ1",
                of.lines[number + 1],
                "ZZ1:\tWHERE",
            ]
            yield of.changed(f"test turned round: {of.named(number)}", number, number + 1, turned)


def _stopping(of: Script) -> Iterator[Planted]:
    """Test a motion that the program does not test, and call the operator."""
    for number in range(len(of.lines) - 1):
        if of.body(number).startswith("CHANGE") and not re.match("SKIP|TRAVEL|HEIGHT", of.body(number + 1)):
            tested = [of.lines[number], "\tSKIPN 4", '\tWAIT "SOMETHING IS IN THE WAY"']
            if of.body(number + 1) or of.lines[number + 1].strip() == "":
                yield of.changed(f"also stops: {of.named(number)}", number, number, tested)


def sample(planted: Sequence[Planted], count: int, seed: int) -> list[Planted]:
    """Draw some programs, equally many of each rule as far as possible."""
    draw = random.Random(seed)  # noqa: S311 - a sample, not a secret
    by_rule: dict[str, list[Planted]] = {}
    for each in draw.sample(planted, len(planted)):
        by_rule.setdefault(each.rule.split(":")[0], []).append(each)
    found: list[Planted] = []
    while len(found) < min(count, len(planted)):
        for some in by_rule.values():
            if some and len(found) < count:
                found.append(some.pop())
    return found
