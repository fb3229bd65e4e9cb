"""States what a correct program does in a world of the agents' bench, and makes the referee's findings on a program."""

from __future__ import annotations

import re
from math import acos, degrees
from typing import TYPE_CHECKING, Final, Literal

import msgspec
import numpy as np

from handeye.core.errors import BadFile
from handeye.core.units import MILLIMETRE
from handeye.judge.finding import Findings, at_least, at_most
from handeye.results.judging import findings_so_far
from handeye.tasks.inserting import InsertionTask

if TYPE_CHECKING:
    from handeye.cell.truth import Truth
    from handeye.core.pose import Array
    from handeye.runs.runner import Runner

_HEARD: Final = "heard"  # the mechanism that keeps the lines that a program prints


class Body(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The required place of a body when the program has ended."""

    name: str
    frame: str = ""  # body from which the place is measured; empty: the world
    x: float | None = None  # mm; a coordinate that is left out may have any value
    y: float | None = None
    z: float | None = None
    within: float = 3.0  # mm: greatest distance from the place
    turned: float | None = None  # deg about the vertical
    fold: float = 360.0  # deg by which the body may be turned without a difference
    askew: float = 5.0  # deg: greatest error of `turned`
    lean: float = 3.0  # deg: greatest tilt

    def findings(self, truth: Truth) -> Findings:
        """Return the findings on this body."""
        body, label = truth.data.body(self.name), self.name.replace("_", " ")
        at = self._place(truth) / MILLIMETRE
        off = [at[axis] - want for axis, want in enumerate((self.x, self.y, self.z)) if want is not None]
        found = {
            f"{self.name}.place": at_most(
                float(np.linalg.norm(off)), self.within, "mm", f"distance of {label} from its place"
            ),
            f"{self.name}.lean": at_most(
                degrees(acos(min(1.0, float(body.xmat[8])))), self.lean, "deg", f"tilt of {label}"
            ),
        }
        if self.turned is not None:
            yaw = degrees(np.arctan2(body.xmat[3], body.xmat[0])) - self.turned
            skew = abs((yaw + self.fold / 2) % self.fold - self.fold / 2)
            found[f"{self.name}.turned"] = at_most(
                skew, self.askew, "deg", f"error of the rotation of {label}"
            )
        return found

    def _place(self, truth: Truth) -> Array:
        """Return the position of the body (m, shape (3,)), in the frame of the body `frame` or, without `frame`, in
        the world frame.
        """
        at = np.array(truth.data.body(self.name).xpos)
        if not self.frame:
            return at
        frame = truth.data.body(self.frame)
        return np.asarray(frame.xmat.reshape(3, 3).T @ (at - frame.xpos))


class Measured(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A value that a program measures and prints."""

    printed: str  # regular expression for the printed line, whose group is the value
    geom: str  # shape whose position the value is
    axis: Literal["x", "y", "z"]
    scale: float = 1.0  # printed units in a millimetre
    offset: float = 0.0  # printed value for the position 0
    within: float  # greatest error, in printed units

    def findings(self, truth: Truth) -> Findings:
        """Return the finding on this value. A value that was not printed has an infinite error."""
        at = float(truth.data.geom(self.geom).xpos["xyz".index(self.axis)]) / MILLIMETRE
        told = [found[1] for line in _lines(truth) if (found := re.search(self.printed, line))]
        try:
            off = abs(float(told[-1]) - at * self.scale - self.offset)
        except (IndexError, ValueError):
            off = float("inf")
        what = f"error of {self.axis} of {self.geom.replace('_', ' ')}, as the program prints it"
        return {f"{self.geom}.{self.axis}": at_most(off, self.within, "units", what)}


class Right(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The behaviour of a correct program in a world."""

    stops: str = ""
    """If the work is impossible: a regular expression for the message with which a right program stops."""
    state: Literal["done", "on_face", "apart"] = "done"
    """Which referee of the task judges the final state of the cell: the referee of the finished work, of a pin on the
    face of the plate, or of a cell whose parts are back in their places.
    """
    only: list[str] | None = None  # findings of the task's referee that count; None: all
    undone: bool = False  # after the end, the arm undoes its work, and all parts must be back in their places
    most_force: float | None = None  # N: greatest force between pin and plate
    touched: bool = False  # pin and plate have touched
    seconds: float | None = None  # simulated: greatest duration of the program
    prints: str = ""  # regular expression for the last printed line
    bodies: list[Body] = []
    measured: list[Measured] = []

    def findings(self, runner: Runner, truth: Truth) -> Findings:
        """Return the referee's findings on a program that has ended."""
        found = dict(self._of_task(runner, truth))
        parts: tuple[Body | Measured, ...] = (*self.bodies, *self.measured)
        for each in parts:
            found |= each.findings(truth)
        if self.prints:
            last = (_lines(truth) or ("",))[-1]
            right = re.fullmatch(self.prints, " ".join(last.split())) is not None
            found["printed"] = at_least(right, 1, "", "number of right results in the last printed line")
        if self.seconds is not None:
            found["seconds"] = at_most(runner.time, self.seconds, "s", "duration of the program")
        return found

    def _of_task(self, runner: Runner, truth: Truth) -> Findings:
        """Return the findings of the referee of the task."""
        task = runner.task
        if self.state == "apart":
            found = dict(task.judge_apart(truth))
        elif self.state == "on_face":
            if self.state not in task.referees:
                raise BadFile(f"the task {task.name} has no referee for a pin on the face of a plate")
            found = dict(task.referees[self.state](truth))
        else:
            found = dict(findings_so_far(runner))
        if self.only is not None:
            found = {name: found[name] for name in self.only}
        if isinstance(task, InsertionTask):
            seen = task.witnessed(runner.arm_cell)
            if self.most_force is not None:
                found["force"] = at_most(
                    seen.peak, self.most_force, "N", "greatest force between pin and plate"
                )
            if self.touched:
                found["touched"] = at_least(
                    seen.first is not None, 1, "", "contacts of the pin with the plate"
                )
        return found


USUAL: Final = Right()


def _lines(truth: Truth) -> tuple[str, ...]:
    """Return the lines that the program has printed."""
    return tuple(getattr(truth.states.get(_HEARD), "lines", ()))
