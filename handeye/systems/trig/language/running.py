"""Running: the steps of a program carried out, forwards and backwards.

A run goes along the sons, where a loop goes back to its bloop. The way back is that of the trail: what was done last is
undone first, whatever has been edited or where the cursor has been since.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from handeye.systems.trig.language.node import GUARDED, NONE, NORMAL, TOP, Node
from handeye.systems.trig.language.obstacles import Obstacle
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.program import NOWHERE, Cut, Done, TrigProgram
from handeye.systems.trig.language.teachable import Halted, Teachable
from handeye.systems.trig.language.undoing import undo_last


@dataclass(frozen=True, slots=True, kw_only=True)
class Ran:
    """How a run has ended."""

    steps: int
    """Done or undone."""
    end: Literal["count", "none", "halted", "beginning", "forgotten", "deleted", "stopped"]
    """As many as wanted, the end of the program, somebody's key, nothing left to undo, no memory of it, no step, or an
    obstacle."""
    obstacle: Obstacle | None = None
    """What the arm met as it undid the active step."""


@dataclass(slots=True, kw_only=True)
class Interpreter:
    """Carries out a program with an arm."""

    program: TrigProgram
    arm: Teachable
    halted: Halted
    """A key, or the kill switch."""
    refresh: Callable[[], None]
    """Called whenever a step is begun or done."""

    # -- forwards --------------------------------------------------------------------------------------

    def run(self) -> Ran:
        """The whole program, from the top, as it was taught.

        Raises:
            InvalidInput: the arm cannot go where a step wants it.
        """
        return self._from_top(None)

    def forward(self, wanted: int) -> Ran:
        """So many steps, of which the active one is the first.

        Raises:
            InvalidInput: the arm cannot go where a step wants it.
        """
        program = self.program
        halted_here = program.paused == program.cursor or self._is_cut(program.active)
        if program.cursor in (TOP, program.first) and not halted_here:
            return self._from_top(wanted)
        came = program.trail[-1].node if program.trail else TOP
        return self._go_on(program.cursor, came, wanted)

    def _from_top(self, wanted: int | None) -> Ran:
        self.program.begin()
        return self._go_on(self.program.graph[TOP].sons[0], TOP, wanted)

    def _go_on(self, id: int, came: int, wanted: int | None) -> Ran:
        steps, graph = 0, self.program.graph
        while id != NONE and steps != wanted:
            next = self.carry_out(id, came)
            if next is None:
                return Ran(steps=steps, end="halted")
            steps += graph[id].shown
            came, id = id, next
        return Ran(steps=steps, end="none" if id == NONE else "count")

    def carry_out(self, id: int, came: int) -> int | None:
        """Carry out one node, a step with the cursor on it; arguments and result are those of `execute`.

        Raises:
            InvalidInput: the arm cannot do it; nothing is changed.
        """
        node = self.program.graph[id]
        if came in node.fathers:
            node.last_father = came
        if node.shown and not self._begin(id):
            self.program.paused = id
            return None
        self.program.paused = NONE
        next = self.execute(node, came)
        if next is not None and node.shown:
            self.refresh()
        return next

    def _begin(self, id: int) -> bool:
        """Put the cursor on a step that is to be carried out; False: somebody wants to halt."""
        self.program.put_cursor(id)
        self.refresh()
        return not self.halted()

    def execute(self, node: Node, came: int) -> int | None:
        """Carry out one node.

        Args:
            came: the node that was carried out before it.

        Returns:
            The node to go on with; None if the arm was halted on its way.

        Raises:
            InvalidInput: the arm cannot do it; nothing is changed.
        """
        match node.type:
            case "normal" | "guarded":
                return self._move(node)
            case "grasp" | "ungrasp":
                self._remember(node)
                before = self.arm.gap
                self.arm.hand(node.type == "grasp")
                self._amend(gaps=(before, self.arm.gap))
            case "savpos" if node.position is not None:
                position = self.program.positions[node.position]
                self._remember(node, position=node.position, data=position.data)
                position.data = self.arm.here()
            case "loop":
                self._remember(node, rounds=node.count)
                if node.count < node.wanted:
                    node.count += 1
                    return node.partner
            case "bloop":
                loop = self.program.graph[node.partner]
                self._remember(node, rounds=loop.count)
                if came != loop.id:
                    loop.count = 0
        if node.shown:
            self.program.ended_at = self.arm.here()
        return node.sons[NORMAL]

    def _move(self, node: Node) -> int | None:
        program = self.program
        goal = program.cut.goal if program.cut is not None and self._is_cut(node) else self.goal(node)
        self.arm.check_travel(goal)
        if not self._is_cut(node):
            self._remember(node)
        program.cut = Cut(program.trail[-1], goal)
        branch = self._arrive(node, goal)
        if branch is None:
            return None
        program.trail[-1] = program.trail[-1]._replace(met=self.arm.met)
        program.cut, program.ended_at = None, self.arm.here()
        program.taken = branch if node.type == "guarded" else None
        return node.sons[branch]

    def _arrive(self, node: Node, goal: Place) -> int | None:
        """The branch by which a move goes on; None: it was halted."""
        if node.threshold is None or node.vector is None:
            return NORMAL if self.arm.go(goal, self.halted) else None
        arrival = self.arm.feel(goal, node.vector, node.threshold, self.halted)
        if arrival.kind == "tripped":
            self._amend(touched=self.arm.here())
        return {"reached": NORMAL, "tripped": GUARDED, "halted": None}[arrival.kind]

    def goal(self, node: Node) -> Place:
        """Where a move goes from where the arm is."""
        assert node.position is not None
        position = self.program.positions[node.position]
        if not position.relative:
            return position.data
        return self.arm.here().moved(position.data.turned_back() if node.negate else position.data)

    def _is_cut(self, node: Node) -> bool:
        """Whether a step was halted on its way, and nothing has been done since."""
        cut, trail = self.program.cut, self.program.trail
        return cut is not None and cut.done.node == node.id and bool(trail) and trail[-1] is cut.done

    def _remember(self, node: Node, *, rounds: int = 0, position: str = "", data: Place = NOWHERE) -> None:
        done = Done(node.id, self.arm.here(), self.arm.closed, rounds, position, data)
        self.program.remember(done)

    def _amend(self, *, gaps: tuple[float, float] = (0.0, 0.0), touched: Place | None = None) -> None:
        """Add to what is remembered of the last step what is known when it is done."""
        trail = self.program.trail
        trail[-1] = trail[-1]._replace(gaps=gaps, touched=touched)

    # -- backwards -------------------------------------------------------------------------------------

    def back(self, wanted: int) -> Ran:
        """Undo so many steps, the last one first; the cursor ends on the step from which control had come.

        Raises:
            InvalidInput: the arm cannot go back to where it was.
        """
        steps, program = 0, self.program
        while steps < wanted:
            if not program.trail:
                return Ran(steps=steps, end="forgotten" if program.forgotten else "beginning")
            id = program.trail[-1].node
            if id not in program.graph:
                return Ran(steps=steps, end="deleted")
            node = program.graph[id]
            if node.shown and not self._begin(node.id):
                return Ran(steps=steps, end="halted")
            stop = undo_last(program, self.arm, self.halted)
            if stop is not None:
                obstacle = None if stop == "halted" else stop
                return Ran(steps=steps, end="stopped" if obstacle else "halted", obstacle=obstacle)
            program.trail.pop()
            steps += node.shown
            self._come_from()
        return Ran(steps=steps, end="count")

    def _come_from(self) -> None:
        """Put the cursor on the step that was carried out before, as far as there is one."""
        program = self.program
        last = next(
            (done.node for done in reversed(program.trail) if self._is_step(done.node)), program.first
        )
        program.put_cursor(TOP if last == NONE else last)
        program.taken, program.cut, program.paused = None, None, NONE
        self.refresh()

    def _is_step(self, id: int) -> bool:
        return id in self.program.graph and self.program.graph[id].shown
