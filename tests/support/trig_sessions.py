"""TRIG sessions for tests, with an imaginary arm. The lines come from a text, not from a person."""

from collections.abc import Callable
from pathlib import Path

from handeye.systems.trig.language.command_input import Script, hear, type_script
from handeye.systems.trig.language.graph import Node
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.storage import faults

PLANS = Path(__file__).parent.parent.parent / "plans"
PALLETISE = (PLANS / "palletise.trig").read_text(encoding="utf-8")
BUCKET = (PLANS / "bucket.trig").read_text(encoding="utf-8")


class Typist:
    """A user who types lines into one session."""

    def __init__(self, text: str = "", halted: Callable[[], bool] = lambda: False) -> None:
        self.arm = NoArm()
        self.told: list[str] = []
        self.halted = halted
        self.session = Session(arm=self.arm, table=self.arm, desk=Script(()))
        self.type(text)

    def type(self, text: str) -> None:
        """Type lines; the first that is refused raises InvalidInput, as a sentence without its place."""
        script = Script(text.splitlines(), self.told.append, self.halted)
        self.session.desk = script
        while not self.session.over and (line := script.next_line()) is not None:
            hear(self.session, line)
            assert list(faults(self.session.program.graph, self.session.program.positions)) == []

    @property
    def steps(self) -> list[Node]:
        """The steps, as they are drawn."""
        return list(self.session.program.graph.steps())

    @property
    def names(self) -> list[str]:
        """Their names, or their types."""
        return [step.name or step.type for step in self.steps]

    @property
    def active(self) -> Node:
        """The step that the cursor is at."""
        return self.session.program.active

    def step(self, name: str) -> Node:
        """The step of a name."""
        return self.session.step(name)

    @property
    def at(self) -> tuple[float, float, float]:
        """Where the arm is, mm."""
        x, y, z, *_ = self.arm.here().measures()
        return x, y, z

    @property
    def blocks(self) -> dict[str, tuple[int, int, int]]:
        """Where the blocks are, mm."""
        return {
            block.name: (round(block.x * 1000), round(block.y * 1000), round(block.z * 1000))
            for block in self.arm.blocks
        }


def straight(count: int) -> str:
    """A program of named steps below each other, S1 at X 1 and so on."""
    return "\n".join(f"M P{n}\nX {n} RECORD\nCN S{n}" for n in range(1, count + 1))


def typed(text: str) -> Session:
    """Type a text into a new session, and return the session."""
    script = Script(text.splitlines())
    session = Session(arm=(arm := NoArm()), table=arm, desk=script)
    type_script(session, script, "script")
    return session
