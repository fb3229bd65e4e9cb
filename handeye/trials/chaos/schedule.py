"""Defines a schedule: where a run begins, which faults and interruptions it has, and which answers the operator
gives.

As text, a schedule consists of words `NAME=VALUE`, separated by blanks. A word may be left out if its value is an
empty list or the smallest possible number.
"""

import random
import re
from collections.abc import Iterator, Sequence
from typing import Annotated, Final, Literal, get_args

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.core.faults import Catalogue, Fault, FaultKind
from handeye.core.record import Record
from handeye.core.variation import Level, checked_seed
from handeye.core.world_options import by_number, faults

BreakKind = Literal["panic", "pause", "back", "kill"]
"""Kinds of interruptions. `panic`: the panic button is pressed after N servo periods. `pause`: the run pauses
after N steps, and is resumed from disk. `back`: like `pause`, but the run then goes back by half of its steps.
`kill`: the process is killed after N events.
"""
Answer = Literal["retry", "skip", "proceed", "abort"]
Count = Annotated[int, msgspec.Meta(ge=1, le=9999)]

_NEAR: Final = (1, 400)  # Servo periods before the panic button is hit: up to seven seconds
_FEW: Final = (1, 6)  # Steps or events before any other interruption
MOST_STEPS: Final = 24  # Steps of a schedule that does not continue to the end of its stage


class Break(Record, frozen=True, kw_only=True):
    """An interruption."""

    kind: BreakKind
    after: Count  # Count since the run continued, in the unit of its kind

    def __str__(self) -> str:
        return f"{self.kind}:{self.after}"


class Schedule(Record, frozen=True, kw_only=True):
    """Faults, interruptions and answers for one run."""

    seed: int
    level: Level = "nominal"
    start: Annotated[
        int, msgspec.Meta(ge=0)
    ]  # Steps of the fault-free run that are done when this run begins
    steps: Count | None = None  # Greatest number of steps; None: the run ends with its first stage
    faults: tuple[str, ...] = ()  # As they would be typed
    breaks: tuple[Break, ...] = ()
    answers: tuple[Answer, ...] = ()  # Answers of the operator in order, then abort

    def __str__(self) -> str:
        words = {
            "seed": str(self.seed),
            "level": "" if self.level == "nominal" else self.level,
            "start": str(self.start),
            "steps": "" if self.steps is None else str(self.steps),
            "faults": ",".join(self.faults),
            "breaks": ",".join(map(str, self.breaks)),
            "answers": ",".join(self.answers),
        }
        return " ".join(f"{name}={value}" for name, value in words.items() if value)

    def without(self) -> Iterator["Schedule"]:
        """Yield copies of this schedule, each with one fault, interruption or answer removed."""
        for name in ("faults", "breaks", "answers"):
            things = getattr(self, name)
            for number in range(len(things)):
                yield msgspec.structs.replace(self, **{name: (*things[:number], *things[number + 1 :])})

    def given(self, catalogue: Catalogue) -> tuple[Fault, ...]:
        """Return the faults of the schedule. Raises InvalidInput if a fault is unknown, or if the schedule does
        not say with which stage the fault begins.
        """
        found = faults(catalogue, self.faults, by_number)
        for fault in found:
            if fault.stage is None:
                raise BadArgument(f"the fault {quoted(fault.name)} has no stage to begin at; add @STAGE")
        return found


def parse_schedule(text: str) -> Schedule:
    """Parse a schedule. Raises InvalidInput if the text is not a schedule."""
    words = dict(re.findall(r"(\w+)=(\S+)", text))
    known = {*Schedule.__struct_fields__}
    if (
        " ".join(f"{name}={value}" for name, value in words.items()) != " ".join(text.split())
        or {*words} - known
    ):
        raise BadArgument(
            f"{quoted(text)} is not a schedule; write it like seed=3 start=41 faults=lamp.dead@4"
        )
    lists = {name: tuple(words[name].split(",")) for name in ("faults", "answers") if name in words}
    breaks = tuple(_break(word) for word in words.get("breaks", "").split(",") if word)
    numbers = {name: int(words[name]) for name in ("seed", "start", "steps") if is_count(words.get(name, ""))}
    try:
        made = msgspec.convert({**words, **lists, **numbers, "breaks": breaks}, Schedule)
    except msgspec.ValidationError as error:
        raise BadArgument(f"{quoted(text)} is not a schedule: {error}") from None
    checked_seed(made.seed)
    return made


def is_count(text: str) -> bool:
    """Return True if a text is a whole number of at most 18 digits."""
    return re.fullmatch("[0-9]{1,18}", text) is not None


def _break(word: str) -> dict[str, object]:
    kind, _, after = word.partition(":")
    if kind not in get_args(BreakKind) or not is_count(after):
        raise BadArgument(
            f"{quoted(word)} is not an interruption; write KIND:N, where N is a whole number and KIND is "
            f"{' or '.join(get_args(BreakKind))}"
        )
    return {"kind": kind, "after": int(after)}


def draw(
    number: int, seed: int, worlds: Sequence[tuple[int, Level]], starts: Sequence[Sequence[int]], catalogue: Catalogue,
    stage_of: Sequence[Sequence[int]],
) -> Schedule:  # fmt: skip
    """Draw one schedule. Each seed gives a series of schedules, and `number` is the place of this schedule in the
    series. `starts` and `stage_of` contain one list for each world.
    """
    chance = random.Random(f"{seed} {number}")  # noqa: S311 - choices, not secrets
    which = chance.randrange(len(worlds))
    place = chance.randrange(len(starts[which]))
    stage = stage_of[which][place]
    kinds = [kind for kind in catalogue.kinds.values() if not kind.from_start]
    broken = chance.sample(kinds, min(len(kinds), chance.choices((0, 1, 2), (2, 5, 3))[0]))
    return Schedule(
        seed=worlds[which][0],
        level=worlds[which][1],
        start=starts[which][place],
        steps=None if chance.random() < 0.4 else chance.randint(1, MOST_STEPS),
        faults=tuple(sorted(catalogue.written(_fault(chance, kind, stage)) for kind in broken)),
        breaks=tuple(_breaks(chance)),
        answers=tuple(
            chance.choices(get_args(Answer), (6, 2, 2, 1), k=chance.choices((0, 1, 2, 3), (3, 3, 2, 1))[0])
        ),
    )


def _fault(chance: random.Random, kind: FaultKind, stage: int) -> Fault:
    """Draw a fault of a given kind. The fault begins with the stage, and has its usual size or a random size."""
    usual = kind.usual(stage)
    if kind.size is None or chance.random() < 0.5:
        return usual
    low, high = (limit for limit in kind.limits)
    value = float(f"{min(max(kind.size.usual * chance.uniform(-1.5, 1.5), low), high):.3g}")
    return msgspec.structs.replace(usual, value=value * kind.measure.size)


def _breaks(chance: random.Random) -> Iterator[Break]:
    for _ in range(chance.choices((0, 1, 2), (2, 5, 3))[0]):
        kind = chance.choices(get_args(BreakKind), (4, 3, 3, 1))[0]
        yield Break(kind=kind, after=chance.randint(*(_NEAR if kind == "panic" else _FEW)))
