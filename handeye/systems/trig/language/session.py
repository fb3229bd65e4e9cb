"""Session: somebody types lines, and the program, its cursor and the arm follow at once."""

from dataclasses import dataclass, field
from pathlib import Path

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import InvalidInput, NoSuchName, Refused
from handeye.core.record import Vector3
from handeye.systems.trig.language.desk import Desk, Withdrawn, yes
from handeye.systems.trig.language.given import read_branch, read_threshold, read_vector
from handeye.systems.trig.language.node import TOP, TOP_NAME, Node
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.position import Position, is_named
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.language.running import Interpreter
from handeye.systems.trig.language.tabletop import Tabletop
from handeye.systems.trig.language.teachable import Teachable


class Killed(Refused):
    """The kill switch of the teach box."""

    def __init__(self) -> None:
        super().__init__("the kill switch has stopped the arm; nothing was recorded")


@dataclass(slots=True, kw_only=True)
class Session:
    """An arm, a person, and the program that they make."""

    arm: Teachable
    table: Tabletop
    desk: Desk
    program: TrigProgram = field(default_factory=TrigProgram)
    origin: Place | None = None
    """Where the arm was at the last CALPOS."""
    file: Path | None = None
    """The file that was read or written last."""
    over: bool = False
    files: bool = True
    """Programs can be read from files and written to them, as whoever types likes; not by a script of somebody else."""

    @property
    def runner(self) -> Interpreter:
        """What carries the program out."""
        return Interpreter(
            program=self.program, arm=self.arm, halted=self.desk.halted, refresh=self.desk.refresh
        )

    # -- finding ---------------------------------------------------------------------------------------

    def position(self, name: str | None, *, negate: bool = False) -> Position:
        """A position that is defined.

        Raises:
            InvalidInput: it is not, or cannot be gone the other way.
        """
        found = self.program.positions.get(name or "")
        if found is None:
            raise NoSuchName(f"there is no position {quoted(name or '')}{self._meant(name or '')}")
        if negate and not found.relative:
            raise Refused(f"{name} is an absolute position; only a relative one has an opposite")
        return found

    def _meant(self, name: str) -> str:
        known = suggestion(name, filter(is_named, self.program.positions))
        return f"; {known}" if known else "; M teaches one"

    def step(self, name: str) -> Node:
        """The step of a name; the top has one, too.

        Raises:
            InvalidInput: there is none.
        """
        graph = self.program.graph
        found = graph[TOP] if name == TOP_NAME else graph.named(name)
        if found is None:
            known = suggestion(name, (node.name for node in graph.nodes.values() if node.name))
            help = known or "CN names the active step"
            raise NoSuchName(f"there is no step {quoted(name)}; {help}")
        return found

    # -- asking ----------------------------------------------------------------------------------------

    def confirmed(self, question: str) -> None:
        """Go on if somebody says yes.

        Raises:
            Withdrawn: somebody says no.
        """
        if not self.desk.ask(question, yes):
            raise Withdrawn

    def threshold(self) -> float:
        """A threshold that is asked for, N."""
        return self.desk.ask("Threshold (oz)? ", read_threshold)

    def vector(self) -> Vector3:
        """A force vector that is asked for."""
        return self.desk.ask("Force vector (x y z)? ", read_vector)

    def branch(self, given: int | None, node: Node | None = None) -> int:
        """The branch of the active step, or of another one, that a command is about.

        Raises:
            InvalidInput: it has but one.
            Withdrawn: nobody says which.
        """
        node = self.program.active if node is None else node
        if node.type != "guarded":
            if given is not None:
                raise Refused("n and g are branches of a guarded step, and this one is not guarded")
            return 0
        if given is not None:
            return given
        if self.program.taken is not None and node is self.program.active:
            return self.program.taken
        return self.desk.ask("Normal or guarded? ", read_branch)

    def open_branch(self, given: int | None) -> int:
        """The branch of the active step that a new one goes on.

        Raises:
            InvalidInput: it has no such branch, or that is a link.
            Withdrawn: nobody says which.
        """
        branch = self.branch(given)
        active = self.program.active
        if branch in active.links:
            target = self.program.graph[self.program.graph.step_at(active.sons[branch])]
            if target.name is None:
                raise Refused(
                    "a link leads on from here to a step without a name; N and CN name it for DLINK"
                )
            raise Refused(f"a link leads on to {target.name} here; `DLINK {target.name}` takes it away first")
        return branch

    def taught(self) -> Place:
        """Where the teach box takes the arm until its record button is pressed.

        Raises:
            Killed: its kill switch is thrown.
            Withdrawn: it is put down.
        """
        while True:
            button = self.desk.press()
            if button == "record":
                return self.arm.here()
            if button == "kill":
                raise Killed
            here = self.arm.here()
            value = here[button.axis] + button.amount if button.by else button.amount
            try:
                self.arm.go(here.with_axis(button.axis, value), self.desk.halted)
            except InvalidInput as error:
                self.desk.wrong(error)
            self.desk.refresh()
