"""What the planner has to say against a motion, in the words of the script: inches, degrees, ounces, joints by name."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from handeye.arm.ik import IKResult
from handeye.arm.ik.reasons import (
    BelowTable,
    InLine,
    InnerCylinder,
    JointLimit,
    OutOfReach,
    Reason,
    TooFast,
    TooNear,
)
from handeye.arm.ik.wording import named
from handeye.arm.model import ArmModel
from handeye.diagnostics import Diagnostic, Label, quoted
from handeye.planning.clearance import Crossing
from handeye.planning.spans import word_span
from handeye.planning.strength import Weakness
from handeye.program.operations import Move
from handeye.program.program import Position, Step
from handeye.source import Source
from handeye.units import DEGREE, INCH, OUNCE_FORCE, OUNCE_INCH

RIDDLE = (
    "in the print of 1973 the second stop of the pin insertion can be read as 60 or as 600 oz; "
    "60 it must have been, for at 600 the search would never end"
)
"""Reference D1."""


_ROUNDED = 0.004
"""Of 45 degrees: how far from a multiple of them an angle is that people write in radians, as 3.14."""
_CIRCLE = 8
"""Times 45 degrees."""


@dataclass(slots=True, kw_only=True)
class PlanningFindings:
    """Collects them, each at the place in the text it is about."""

    arm: ArmModel
    whole: Source
    """The script, with what it requires."""
    positions: Mapping[str, Position]
    """What the words of the script stand for."""
    found: list[Diagnostic] = field(default_factory=list)
    _goals: set[tuple[str, str]] = field(default_factory=set)
    """Codes and positions that have been told: a wrong position is one mistake, however often it is gone to."""

    def unreachable(self, step: Step, word: str, failure: IKResult) -> None:
        """There are no joint positions for a goal, or for the way to it."""
        reason, note = failure.reason, failure.message(self.arm)
        assert reason is not None
        if failure.along is not None:
            self._off_the_way(step, reason, _along(step, failure.along), note)
            return
        match reason:
            case JointLimit():
                self._joint_limit(step, f"{step.text.split()[0]} {word}", word, reason)
            case OutOfReach() | TooNear() | InnerCylinder():
                away, help = "too near to the column of", "farther from"
                if isinstance(reason, OutOfReach):
                    away, help = "beyond the reach of", "nearer to"
                inches = f"{reason.excess / INCH:.2f} in"
                self._add(
                    "unreachable-position", step, word, f"{word} is {inches} {away} the {self.arm.name} arm",
                    note=note, help=f"bring it at least {inches} {help} the arm{self._counted(word)}",
                )  # fmt: skip
            case BelowTable():
                self._add(
                    "hand-through-table",
                    step,
                    word,
                    f"{note} on its way to {word}",
                    help="go by a position between",
                )
            case _:
                self._add(
                    "unreachable-position", step, word, f"the {self.arm.name} arm cannot put the hand at {word}",
                    note=note, help=f"put it elsewhere, or turn it{self._counted(word)}",
                )  # fmt: skip

    def _off_the_way(self, step: Step, reason: Reason, place: str, note: str) -> None:
        word = _word(step)
        match reason:
            case JointLimit():
                self._joint_limit(step, word, word, reason, place)
            case InLine():
                self._add(
                    "wrist-in-line", step, word, f"the hand could not keep its angles {place}",
                    note=note, help="tilt the hand a little, or go there with a `MOVE`",
                )  # fmt: skip
            case TooFast():
                self._add(
                    "joint-too-fast", step, word,
                    f"{named(self.arm, reason.joint)} would have to move too fast {place}",
                    note=note, help="move more slowly, or begin elsewhere",
                )  # fmt: skip
            case _:
                self._add(
                    "path-leaves-reach", step, word, f"the hand would leave the arm's reach {place}",
                    note=note, help="shorten the motion, or begin elsewhere",
                )  # fmt: skip

    def _joint_limit(
        self, step: Step, motion: str, word: str, reason: JointLimit, place: str | None = None
    ) -> None:
        beyond, limit = f"{reason.excess / DEGREE:.1f} degrees", f"{reason.limit / DEGREE:.0f} degrees"
        note, help = None, self._slip(word)
        help = help or "turn the hand otherwise: other angles O, A, T can be within the limits"
        if place is not None:
            note = f"it comes to its limit {place}"
            help = "go by a position between" if isinstance(step.operation, Move) else "shorten the motion"
        self._add(
            "joint-limit", step, word,
            f"`{motion}` would take {named(self.arm, reason.joint)} {beyond} beyond its limit of {limit}",
            note=note, help=help,
        )  # fmt: skip

    def _slip(self, word: str) -> str | None:
        """What was mistaken in the angles of a position, if they are written in radians."""
        position = self.positions.get(word)
        for angle in () if position is None else position.at[3:]:
            parts = angle / DEGREE / (math.pi / 4)
            if 1 <= abs(round(parts)) <= _CIRCLE and abs(parts - round(parts)) < _ROUNDED:
                return (
                    f"O, A and T are in degrees; {angle / DEGREE:g} is {round(parts) * 45} degrees in radians"
                )
        return None

    def _counted(self, word: str) -> str:
        """What a position is counted from, if not from the table."""
        position = self.positions.get(word)
        return (
            "" if position is None or position.of is None else f"; it is counted from {quoted(position.of)}"
        )

    def below_table(self, step: Step, word: str, depth: float) -> None:
        """A goal is below the table top."""
        self._add(
            "hand-through-table", step, word,
            f"the hand would be {depth / INCH:.2f} in below the table at {word}",
            help="the table top is z = 0; raise the position",
        )  # fmt: skip

    def crosses(self, step: Step, crossing: Crossing, held: str | None, grasp: Step | None) -> None:
        """The hand, or what it holds, would go through something."""
        what = "the hand" if held is None else f"{quoted(held)} in the hand"
        depth = f"{crossing.depth / INCH:.2f} in"
        if crossing.what is None:
            code, message = "through-table", f"{what} would be {depth} below the table"
        else:
            code, message = "through-fixture", f"{what} would go {depth} into {quoted(crossing.what)}"
        word, place = _word(step), _along(step, crossing.along)
        if not isinstance(step.operation, Move):
            place = f"at the end of this `{word}`" if crossing.at_end else place
            help = "shorten the motion, or give it a `STOP` if it is to meet something"
        elif crossing.at_end:
            word, place = step.operation.goal, f"at {step.operation.goal}"
            help = "raise the position, or put it elsewhere"
        else:
            help = "go round by a position between, or higher"
        self._add(
            ("hand-" if held is None else "carries-") + code, step, word, f"{message} {place}",
            secondary=() if held is None or grasp is None else (self._label(grasp, "taken here"),), help=help,
        )  # fmt: skip

    def too_heavy(self, step: Step, weight: float, weak: Weakness, because: Step) -> None:
        """A load cannot be held up on a motion."""
        self._add(
            "load-beyond-arm", step, _word(step),
            f"the arm cannot hold {weight / OUNCE_FORCE:.0f} oz up on this motion",
            secondary=(self._label(because, "said here"),),
            help=f"{named(self.arm, weak.joint)} gives out at {weak.most / OUNCE_FORCE:.0f} oz",
        )  # fmt: skip

    def too_weak(self, code: str, step: Step, wanted: float, weak: Weakness, *, turning: bool) -> None:
        """A force, or a moment if `turning`, is beyond the arm."""
        verb, si, unit = ("turn", OUNCE_INCH, "oz-in") if turning else ("press", OUNCE_FORCE, "oz")
        message = f"the arm cannot {verb} with {wanted / si:.0f} {unit} here"
        riddle = False
        if code == "stop-beyond-arm":
            message += ", so the stop would never fire"
            riddle = round(wanted / si) == 600 and not turning
        modifier = "STOP" if code == "stop-beyond-arm" else "FORCE"
        self._add(
            code, step, modifier, message, note=RIDDLE if riddle else None,
            help=f"{named(self.arm, weak.joint)} gives out at {weak.most / si:.0f} {unit}",
        )  # fmt: skip

    def _label(self, step: Step, text: str) -> Label:
        return Label(span=word_span(self.whole, step, _word(step)), text=text)

    def _add(
        self, code: str, step: Step, word: str, message: str, *,
        secondary: tuple[Label, ...] = (), note: str | None = None, help: str | None = None,
    ) -> None:  # fmt: skip
        if isinstance(step.operation, Move) and word in (step.operation.goal, *step.operation.via):
            if (code, word) in self._goals:
                return
            self._goals.add((code, word))
        primary = Label(span=word_span(self.whole, step, word))
        notes = (note,) if note else ()
        self.found.append(
            Diagnostic(
                code=code, message=message, primary=primary, secondary=secondary, notes=notes, help=help
            )
        )


def _word(step: Step) -> str:
    return step.text.split()[0]


def _along(step: Step, along: float) -> str:
    inches = f"{along / INCH:.1f} in along"
    if isinstance(step.operation, Move):
        return f"{inches} its way to {step.operation.goal}"
    return f"{inches} this `{_word(step)}`"
