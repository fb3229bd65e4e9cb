"""A user who types lines to the arm program, and the cell in which they are executed."""

from pathlib import Path
from typing import Any

from handeye.core.resources import plans
from handeye.core.variation import WorldSpec
from handeye.program.taught import Taught, load_taught
from handeye.teaching.answers import Answer, text
from handeye.teaching.repl import Repl
from handeye.teaching.workplace import Workplace

TAUGHT = load_taught(plans() / "water_pump.toml")


def workplace(taught: Taught = TAUGHT, **more: Any) -> Workplace:
    """The cell of world 0, in which nothing has been done."""
    known: dict[str, Any] = {"halt": lambda: False, **more}
    return Workplace(world=WorldSpec(seed=0), camera="ray", taught=taught, **known)


class Console:
    """Types lines, and returns what the user sees."""

    def __init__(self, place: Workplace, folder: Path) -> None:
        self.repl = Repl(workplace=place, folder=folder)

    def type(self, *lines: str) -> Answer:
        """Type lines. Returns the answer to the last line."""
        answers = [self.repl.hear(line) for line in lines]
        return answers[-1]

    def read(self, *lines: str) -> str:
        """Type lines. Returns the text of the answer to the last line."""
        return text(self.type(*lines))

    @property
    def steps(self) -> list[str]:
        """The functions of the last executed plan."""
        return [step.text for step in self.repl.workplace.runner.setup.plan.program.steps]

    @property
    def gap(self) -> float:
        """Opening of the hand, in."""
        return self.repl.workplace.run.drive.sensed.gap / 0.0254
