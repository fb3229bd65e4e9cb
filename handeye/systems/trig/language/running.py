"""Runs the steps of a program, forwards and backwards.

A run goes from each step to one of its sons; a loop returns to its bloop. A reversal follows the trail, the last step
first, regardless of later edits and of the cursor. A reversal brings the arm back to the start of each move, the hand
to its earlier state, and positions and counts to their old values. When a grasp or a release is reversed, the gap
between the fingers must first be the same as after that step, and then the same as before that step. An object that
was taken up must find support again. An object that a guarded step met must still be there.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice
from typing import Final, Literal

from handeye.systems.trig.language.graph import GUARDED, NONE, NORMAL, TOP, Node
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.program import NOWHERE, HaltedMove, RecordedStep, TrigProgram
from handeye.systems.trig.language.trig_arm import Halted, HoldOff, MissingContact, Obstacle, TrigArm
from handeye.touch.senses import as_before, at_least, least_gap

AGAIN: Final = 1e-3
"""When the arm feels again for an earlier contact, it moves at most this distance (m) beyond the place of that
contact. Our choice: 1/12 of the height of a block.
"""
Stop = Literal["halted"] | Obstacle
_MIN_MOTION: Final = 1e-6  # m; a shorter step has no direction


def undo_last(program: TrigProgram, arm: TrigArm, halted: Halted) -> Stop | None:
    """Reverse the last step. The caller removes the step from the trail. If the reversal was stopped, returns the
    reason; if not, returns None.
    """
    done = program.trail[-1]
    node = program.graph[done.node]
    match node.type:
        case "normal" | "guarded":
            return _touch_again(node, done, arm, halted) or _way_back(program, done, arm, halted)
        case "grasp" | "ungrasp":
            return _hand_back(done, arm)
        case "savpos":
            program.positions[done.position].data = done.data
        case "loop":
            node.count = done.rounds
        case "bloop":
            program.graph[node.partner].count = done.rounds
    return None


def _way_back(program: TrigProgram, done: RecordedStep, arm: TrigArm, halted: Halted) -> Stop | None:
    """Move the arm back to the start of a move. If the arm took up an object there, set the object down again."""
    if _took_up(program) and at_least(arm.gap, least_gap(0.0)):
        return arm.set_down(done.place, halted, done.met)
    return arm.back(done.place, halted, done.met)


def _took_up(program: TrigProgram) -> bool:
    """Return True if the step before the last move was a grasp. Steps that neither move the arm nor use the hand do
    not count.
    """
    for done in islice(reversed(program.trail), 1, None):
        node = program.graph.nodes.get(done.node)
        if node is None or node.type in ("normal", "guarded", "ungrasp"):
            return False
        if node.type == "grasp":
            return True
    return False


def _touch_again(node: Node, done: RecordedStep, arm: TrigArm, halted: Halted) -> Stop | None:
    """Before the arm reverses a guarded step, check that the object that stopped the step is still there,
    unless the step pushed the object away.

    If the arm meets nothing, the arm returns to the place of contact, so that the user can put the object back.
    """
    if done.touched is None or node.vector is None or node.threshold is None:
        return None
    way = done.touched.seen_from(done.place)
    far = math.hypot(*way[:3])
    if far < _MIN_MOTION or math.dist(arm.here()[:3], done.touched[:3]) > AGAIN:
        return None
    beyond = Place(*(component * AGAIN / far for component in way[:3]))
    goal = arm.within_travel(done.touched.moved(beyond))
    arrival = arm.feel(goal, node.vector, node.threshold, halted)
    if arrival.kind == "reached":
        return arm.back(done.touched, halted) or MissingContact()
    return "halted" if arrival.kind == "halted" else None


def _hand_back(done: RecordedStep, arm: TrigArm) -> HoldOff | None:
    """Restore the hand. The gap must be the same as when the hand closed on the object or released the object."""
    before, after = done.gaps
    off = _off_hold(after, arm)
    if off is None:
        arm.hand(done.closed)
        off = _off_hold(before, arm)
    return off


def _off_hold(kept: float, arm: TrigArm) -> HoldOff | None:
    gap = arm.gap
    return None if as_before(gap, kept) else HoldOff(gap=round(gap, 6), kept=round(kept, 6))


@dataclass(frozen=True, slots=True, kw_only=True)
class RunResult:
    """The result of a run: the number of executed steps, and the reason for the end."""

    steps: int  # executed or reversed
    end: Literal["count", "none", "halted", "beginning", "forgotten", "deleted", "stopped"]
    """Why the run ended. In the order of the values: the number of steps was reached, the program ended, a key was
    pressed, nothing was left to undo, the history of earlier steps was dropped, a step was deleted, or an obstacle
    stopped the arm.
    """
    obstacle: Obstacle | None = None  # met while reversing the active step


@dataclass(slots=True, kw_only=True)
class Interpreter:
    """Executes a program with an arm."""

    program: TrigProgram
    arm: TrigArm
    halted: Halted  # a key, or the kill switch
    refresh: Callable[[], None]  # called at the start and end of each step

    # -- forwards --------------------------------------------------------------------------------------

    def run(self) -> RunResult:
        """Run the whole program from the top, with the positions as taught."""
        return self._from_top(None)

    def forward(self, wanted: int) -> RunResult:
        """Execute a number of steps, beginning at the active step."""
        program = self.program
        halted_here = program.paused == program.cursor or self._is_cut(program.active)
        if program.cursor in (TOP, program.first) and not halted_here:
            return self._from_top(wanted)
        came = program.trail[-1].node if program.trail else TOP
        return self._go_on(program.cursor, came, wanted)

    def _from_top(self, wanted: int | None) -> RunResult:
        self.program.begin()
        return self._go_on(self.program.graph[TOP].sons[0], TOP, wanted)

    def _go_on(self, id: int, came: int, wanted: int | None) -> RunResult:
        steps, graph = 0, self.program.graph
        while id != NONE and steps != wanted:
            next = self.carry_out(id, came)
            if next is None:
                return RunResult(steps=steps, end="halted")
            steps += graph[id].shown
            came, id = id, next
        return RunResult(steps=steps, end="none" if id == NONE else "count")

    def carry_out(self, id: int, came: int) -> int | None:
        """Execute one node, and move the cursor if the node is a visible step. The arguments and the result are the
        same as for `execute`.
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
        """Move the cursor to the next step. Returns False if the user wants to halt."""
        self.program.put_cursor(id)
        self.refresh()
        return not self.halted()

    def execute(self, node: Node, came: int) -> int | None:
        """Execute one node, which was reached from the node `came`. Returns the next node, or None if the arm
        was halted."""
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
        program.cut = HaltedMove(program.trail[-1], goal)
        branch = self._arrive(node, goal)
        if branch is None:
            return None
        program.trail[-1] = program.trail[-1]._replace(met=self.arm.met)
        program.cut, program.ended_at = None, self.arm.here()
        program.taken = branch if node.type == "guarded" else None
        return node.sons[branch]

    def _arrive(self, node: Node, goal: Place) -> int | None:
        """Return the branch to take after a move, or None if the move was halted."""
        if node.threshold is None or node.vector is None:
            return NORMAL if self.arm.go(goal, self.halted) else None
        arrival = self.arm.feel(goal, node.vector, node.threshold, self.halted)
        if arrival.kind == "tripped":
            self._amend(touched=self.arm.here())
        return {"reached": NORMAL, "tripped": GUARDED, "halted": None}[arrival.kind]

    def goal(self, node: Node) -> Place:
        """Return the goal of a move that starts at the arm's present place."""
        assert node.position is not None
        position = self.program.positions[node.position]
        if not position.relative:
            return position.data
        return self.arm.here().moved(position.data.turned_back() if node.negate else position.data)

    def _is_cut(self, node: Node) -> bool:
        """Return True if the move of the step was halted, and nothing has been executed since."""
        cut, trail = self.program.cut, self.program.trail
        return cut is not None and cut.done.node == node.id and bool(trail) and trail[-1] is cut.done

    def _remember(self, node: Node, *, rounds: int = 0, position: str = "", data: Place = NOWHERE) -> None:
        done = RecordedStep(node.id, self.arm.here(), self.arm.closed, rounds, position, data)
        self.program.remember(done)

    def _amend(self, *, gaps: tuple[float, float] = (0.0, 0.0), touched: Place | None = None) -> None:
        trail = self.program.trail
        trail[-1] = trail[-1]._replace(gaps=gaps, touched=touched)

    # -- backwards -------------------------------------------------------------------------------------

    def back(self, wanted: int) -> RunResult:
        """Reverse a number of steps, the last step first. The cursor ends on the step before the reversed steps."""
        steps, program = 0, self.program
        while steps < wanted:
            if not program.trail:
                return RunResult(steps=steps, end="forgotten" if program.forgotten else "beginning")
            id = program.trail[-1].node
            if id not in program.graph:
                return RunResult(steps=steps, end="deleted")
            node = program.graph[id]
            if node.shown and not self._begin(node.id):
                return RunResult(steps=steps, end="halted")
            stop = undo_last(program, self.arm, self.halted)
            if stop is not None:
                obstacle = None if stop == "halted" else stop
                return RunResult(steps=steps, end="stopped" if obstacle else "halted", obstacle=obstacle)
            program.trail.pop()
            steps += node.shown
            self._come_from()
        return RunResult(steps=steps, end="count")

    def _come_from(self) -> None:
        """Move the cursor to the last executed step that has not been reversed, if there is one."""
        program = self.program
        steps = (done.node for done in reversed(program.trail) if done.node in program.graph)
        last = next((id for id in steps if program.graph[id].shown), program.first)
        program.put_cursor(TOP if last == NONE else last)
        program.taken, program.cut, program.paused = None, None, NONE
        self.refresh()
