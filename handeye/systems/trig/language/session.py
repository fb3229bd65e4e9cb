"""A session, in which each typed line immediately changes the program, the cursor or the arm."""

from dataclasses import dataclass, field
from pathlib import Path

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import InvalidInput, NoSuchName, Refused
from handeye.core.record import Vector3
from handeye.systems.trig.language.arguments import read_branch, read_threshold, read_vector
from handeye.systems.trig.language.desk import Cancelled, Desk, Tabletop, yes
from handeye.systems.trig.language.graph import TOP, TOP_NAME, Node
from handeye.systems.trig.language.place import Place, Position, is_named
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.language.running import Interpreter
from handeye.systems.trig.language.trig_arm import TrigArm


class KillSwitchHit(Refused):
    """Raised if the user presses the kill switch of the teach box."""

    def __init__(self) -> None:
        super().__init__("the kill switch has stopped the arm; nothing was recorded")


@dataclass(slots=True, kw_only=True)
class Session:
    """An arm, a user, and the program that the user is teaching."""

    arm: TrigArm
    table: Tabletop
    desk: Desk
    program: TrigProgram = field(default_factory=TrigProgram)
    origin: Place | None = None  # the arm's place at the last CALPOS
    file: Path | None = None  # read or written last
    over: bool = False
    files: bool = True  # may be read and written; not by the script of a job

    @property
    def runner(self) -> Interpreter:
        return Interpreter(
            program=self.program, arm=self.arm, halted=self.desk.halted, refresh=self.desk.refresh
        )

    # -- finding ---------------------------------------------------------------------------------------

    def position(self, name: str | None, *, negate: bool = False) -> Position:
        """Return a defined position. Raises NoSuchName if the position is not defined, and Refused if the opposite of
        an absolute position is requested.
        """
        found = self.program.positions.get(name or "")
        if found is None:
            known = suggestion(name or "", filter(is_named, self.program.positions))
            raise NoSuchName(f"there is no position {quoted(name or '')}; {known or 'M teaches a position'}")
        if negate and not found.relative:
            raise Refused(
                f"there is no -{name}: {name} is an absolute position, and only a relative position has an opposite"
            )
        return found

    def step(self, name: str) -> Node:
        """Return the step called `name`, or the top if `name` is the top's name. Raises NoSuchName if there is no such
        step.
        """
        graph = self.program.graph
        found = graph[TOP] if name == TOP_NAME else graph.named(name)
        if found is None:
            known = suggestion(name, (node.name for node in graph.nodes.values() if node.name))
            raise NoSuchName(f"there is no step {quoted(name)}; {known or 'CN names the active step'}")
        return found

    # -- asking ----------------------------------------------------------------------------------------

    def confirmed(self, question: str) -> None:
        """Ask a question. Raises Cancelled unless the user says yes."""
        if not self.desk.ask(question, yes):
            raise Cancelled

    def threshold(self) -> float:
        """Ask for a threshold, and return it (N)."""
        return self.desk.ask("Threshold (oz)? ", read_threshold)

    def vector(self) -> Vector3:
        """Ask for a force vector."""
        return self.desk.ask("Force vector (x y z)? ", read_vector)

    def branch(self, given: int | None, node: Node | None = None) -> int:
        """Return the branch that a command concerns: a branch of `node`, or of the active step if `node` is
        None."""
        node = self.program.active if node is None else node
        if node.type != "guarded":
            if given is not None:
                raise Refused("n and g are branches of a guarded step, but the active step is not guarded")
            return 0
        if given is not None:
            return given
        if self.program.taken is not None and node is self.program.active:
            return self.program.taken
        return self.desk.ask("Normal or guarded? ", read_branch)

    def open_branch(self, given: int | None) -> int:
        """Return the branch of the active step on which a new step is inserted. Raises Refused if that
        branch is a link.
        """
        branch = self.branch(given)
        active = self.program.active
        if branch in active.links:
            target = self.program.graph[self.program.graph.step_at(active.sons[branch])]
            if target.name is None:
                raise Refused(
                    "a link leads from here to a step without a name; go there with N, "
                    "name the step with CN, come back and remove the link with DLINK"
                )
            raise Refused(
                f"a link leads from here to {target.name}; remove the link first with `DLINK {target.name}`"
            )
        return branch

    def taught(self) -> Place:
        """Let the user move the arm with the teach box, and return the arm's place when the user presses record.
        Raises KillSwitchHit if the user hits the kill switch.
        """
        while True:
            button = self.desk.press()
            if button == "record":
                return self.arm.here()
            if button == "kill":
                raise KillSwitchHit
            here = self.arm.here()
            value = here[button.axis] + button.amount if button.by else button.amount
            try:
                self.arm.go(here.with_axis(button.axis, value), self.desk.halted)
            except InvalidInput as error:
                self.desk.wrong(error)
            self.desk.refresh()
