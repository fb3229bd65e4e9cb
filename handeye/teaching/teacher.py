"""Teaches positions: the arm is moved by commands or by hand, and its positions are stored under names."""

import tomllib
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from handeye.arm.ik import IKResult
from handeye.arm.line import jog, pivot
from handeye.arm.samples import Samples
from handeye.cell.simulated import pushed
from handeye.core.diagnostics import quoted
from handeye.core.errors import CannotWrite, NoSuchName, Refused
from handeye.core.files import is_there, write_whole
from handeye.core.record import Vector3
from handeye.core.source import Source, read_source
from handeye.execution.servo import Halted
from handeye.execution.servo_loop import Outcome
from handeye.planning.motions import TURN_SPEED, change_samples
from handeye.planning.planner import SPEED
from handeye.program.diagnosis.cause_text import error_sentence
from handeye.program.motion_operations import Change
from handeye.program.program import Position
from handeye.program.taught import Taught
from handeye.program.taught_text import with_position
from handeye.teaching.answers import Answer, carry_out
from handeye.teaching.functions import TYPED
from handeye.teaching.workplace import Workplace

REST_S = 0.5  # s for a floating arm to come to rest when it is released


@dataclass(slots=True, kw_only=True)
class Teacher:
    """A cell, a file of taught positions, and the positions that have not been written to the file yet."""

    workplace: Workplace
    file: Path
    saved: str  # the text of the file
    text: str = field(init=False)  # the text of the file, with all names given since it was read
    afloat: bool = False  # the brakes are off, and gravity is balanced
    # what `undo` restores: positions and text as they were before a name was given; None: the cell
    _before: list[tuple[Taught, str] | None] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.text = self.saved

    @property
    def unsaved(self) -> list[str]:
        """Names of the positions that are missing in the file, or whose values differ from those in the file."""
        now, then = (tomllib.loads(text).get("positions", {}) for text in (self.text, self.saved))
        return [name for name in {**then, **now} if now.get(name) != then.get(name)]

    # -- moving ---------------------------------------------------------------------------------------

    def function(self, text: str) -> Answer:
        """Execute an instruction of the arm language."""
        marks = len(self.workplace.before)
        given = carry_out(self.workplace, Source(name=TYPED, text=text), alone=True)
        if len(self.workplace.before) > marks:
            self._before.append(None)
        self.afloat = False
        return given

    def joint(self, index: int, goal: float) -> None:
        """Move one joint to a position (rad or m), and hold all others. Raises Refused if the motion is impossible."""
        self._follow(jog(self.workplace.run.arm, self.workplace.q, index, goal, speed=SPEED))

    def straight(self, displacement: Vector3) -> None:
        """Move the hand straight by a displacement (m, table coordinates) without turning it. Raises Refused if the
        motion is impossible.
        """
        change = Change(displacement=displacement)
        self._follow(change_samples(self.workplace.run.arm, self.workplace.q, change))

    def turn(self, turn: Vector3) -> None:
        """Turn the hand about its tool point by a rotation vector (rad, table coordinates). Raises Refused if the
        motion is impossible.
        """
        self._follow(pivot(self.workplace.run.arm, self.workplace.q, np.array(turn), TURN_SPEED))

    def _follow(self, samples: Samples | IKResult) -> None:
        if isinstance(samples, IKResult):
            raise Refused(samples.message(self.workplace.run.arm))
        self.afloat = False
        self._let(lambda: self.workplace.run.drive.follow(samples))

    def let_go(self) -> None:
        """Release the brakes. From now on, the arm moves when it is pushed."""
        self.afloat = True
        self._let(lambda: self._float(REST_S))

    def push(self, force: Vector3, seconds: float) -> None:
        """Push the hand of the floating arm with a force (N, table coordinates) for some seconds. Raises
        Refused if the arm does not float.
        """
        if not self.afloat:
            raise Refused("the arm cannot be pushed while its brakes are set; `float` releases the brakes")

        def act() -> None:
            with pushed(self.workplace.runner.arm_cell, force):
                self._float(seconds)
            self._float(REST_S)

        self._let(act)

    def _float(self, seconds: float) -> None:
        self.workplace.run.drive.float(seconds)

    def _let(self, act: Callable[[], Outcome | None]) -> None:
        """Let the arm move. Ctrl-C or an obstacle sets the brakes."""
        self.workplace.mark()
        self._before.append(None)
        try:
            outcome = act()
        except Halted:
            self._brake()
            raise Refused("stopped by the panic button; the brakes are set") from None
        if outcome is not None and outcome.error is not None:
            self._brake()
            raise Refused(f"{error_sentence(outcome.error, outcome.cause)}; the brakes are set")

    def _brake(self) -> None:
        self.afloat = False
        with suppress(Halted):  # the button is pressed again: the brakes are set, and stay so
            self.workplace.run.drive.stop()

    # -- naming ---------------------------------------------------------------------------------------

    def name(self, name: str, part: str | None, *, again: bool = False) -> Position:
        """Store the present hand position under a name, relative to the table or a part. Raises InvalidInput if the
        name, the part or the file does not allow the position to be stored.
        """
        taught = self.workplace.taught
        if part is not None and part not in taught.parts:
            known = ", ".join(taught.parts) or "none"
            raise NoSuchName(f"there is no part {quoted(part)}; the parts are {known}")
        if name in taught.positions and not again:
            raise Refused(f"{name} is already taught; `here {name} again` replaces it")
        run = self.workplace.run
        position = run.world.seen_from(part, run.drive.hand())
        text = with_position(self.text, name, position)
        self._before.append((taught, self.text))
        self.text = text
        self.workplace.taught = replace(taught, positions={**taught.positions, name: position})
        return position

    def save(self) -> list[str]:
        """Write the file, and return the names of the positions that are new in it. Raises CannotWrite if the file
        cannot be written; for example, another program may have changed it.
        """
        names = self.unsaved
        if names:
            now = read_source(self.file).text if is_there(self.file) else ""
            if now != self.saved:
                raise CannotWrite(
                    f"{self.file} has changed since it was read, so nothing was written; `list` shows what to add"
                )
            write_whole(self.file, self.text.encode())
            self.saved = self.text
        return names

    # -- going back -----------------------------------------------------------------------------------

    def undo(self) -> str:
        """Undo the last motion or the last stored name, and return a sentence that says what was undone. The saved file
        is not changed. Raises Refused if there is nothing to undo.
        """
        if not self._before:
            raise Refused("there is nothing to undo")
        before = self._before.pop()
        if before is None:
            self.workplace.back()
            self.afloat = False
            return "the last motion is undone"
        self.workplace.taught, self.text = before
        return "the last name is undone"
