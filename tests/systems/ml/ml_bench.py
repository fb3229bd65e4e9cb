"""ML programs on perfect motors, and drawn statements, for tests."""

from pathlib import Path
from typing import Any, Final

from hypothesis import strategies as st

from handeye.core.source import Source
from handeye.systems.ml.happenings import Traced
from handeye.systems.ml.language.check import checked
from handeye.systems.ml.language.commands import COMMANDS
from handeye.systems.ml.language.syntax import Parameter, Reference, Statement
from handeye.systems.ml.ml_api import Ml
from handeye.systems.ml.tables.layout import SHAPES
from handeye.systems.ml.tables.store import word_of

ROOT: Final = Path(__file__).parents[3]
PLANS: Final = ROOT / "plans"
FOLLOWER: Final = PLANS / "curve_follower.ml"


def codes(text: str) -> list[str]:
    """Codes of a program's mistakes, in order."""
    return [each.code for each in checked(Source(name="t.ml", text=text))[1]]


def messages(text: str) -> list[str]:
    return [each.message for each in checked(Source(name="t.ml", text=text))[1]]


def executed(text: str, **options: Any) -> Ml:
    """A terminal on which a program was stored and run to its end."""
    ml = Ml(text, **options)
    ml.do("RUN")
    return ml


def traced(ml: Ml) -> list[str]:
    """Statements that were executed while TRACE was on, with their values."""
    return [f"{event.statement} {event.text}" for event in ml.events if isinstance(event, Traced)]


WORDS: Final = st.integers(-0x8000, 0x7FFF)
REFERENCES: Final = st.builds(Reference, st.integers(1, 256), st.integers(1, 6), st.booleans())
NAMES: Final = st.text(alphabet="ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789", min_size=1, max_size=8)


@st.composite
def statements(draw: st.DrawFn) -> Statement:
    """Any statement that the parser accepts."""
    command = COMMANDS[draw(st.sampled_from(sorted(COMMANDS)))]
    count = draw(st.sampled_from(sorted(command.counts)))
    parameters: list[Parameter] = []
    for at in range(count):
        match command.kind(at):
            case "text":
                parameters.append(draw(NAMES))
            case "table":
                parameters.append(draw(REFERENCES | st.sampled_from([word_of(name) for name in SHAPES])))
            case _:
                parameters.append(draw(REFERENCES | WORDS))
    if command.code == "SENSOR" and count == 3:
        lower = draw(st.integers(-0x8000, 0x7FFE))
        parameters[1:] = [lower, draw(st.integers(lower + 1, 0x7FFF))]
    point = tuple(draw(WORDS) for _ in range(12)) if command.code == "POINT" and draw(st.booleans()) else ()
    return Statement(command.code, tuple(parameters), point)
