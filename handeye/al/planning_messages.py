"""Makes diagnostics from the findings of the planner. Each diagnostic uses the units of the language, and points to a
place in the script.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any, Final

from handeye.al.scanner import scan
from handeye.core.diagnostics import Diagnostic, Label, arranged, problem, quoted
from handeye.core.plain_text import counted, enough_digits
from handeye.core.source import Source, Span
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE, OUNCE_INCH
from handeye.program.diagnosis.plan_findings import (
    GoalBelowTable,
    NoConfiguration,
    PlanFinding,
    RunsInto,
    TooFaint,
    TooHeavy,
    TooWeak,
)
from handeye.program.diagnosis.reach import (
    BelowTable,
    InLine,
    InnerCylinder,
    JointLimit,
    NamedArm,
    OutOfReach,
    TooFast,
    TooNear,
    named,
    reach_sentence,
)
from handeye.program.program import Program, SourcePlace, Step

RIDDLE: Final = (
    "in the listing printed in 1973, the second stop of the pin insertion can be read as 60 or as 600 oz; we read "
    "60 oz, because the simulated arm cannot press with 600 oz, so the search would never end"
)  # reference D1
_TOLERANCE: Final = 0.004
_EIGHTHS: Final = 8


def planning_diagnostics(
    program: Program, arm: NamedArm, findings: Iterable[PlanFinding]
) -> list[Diagnostic]:
    """Make diagnostics from the findings of the planner, sorted by position. Spans are offsets in the text of the
    script together with its required texts.
    """
    phrases = _Phrases(program, arm)
    return arranged(_PHRASES[type(finding)](phrases, finding) for finding in findings)


@dataclass(slots=True)
class _Phrases:
    program: Program
    arm: NamedArm
    whole: Source = field(init=False)

    def __post_init__(self) -> None:
        self.whole = self.program.whole

    def no_configuration(self, found: NoConfiguration) -> Diagnostic:
        if found.along is not None:
            return self.off_the_way(found, self.along(found.step, found.along))
        name, arm = found.position or self.word(found.step), self.arm.name
        note = reach_sentence(self.arm, found.reason)
        help = f"move or turn the position{self.counted(name)}"
        match found.reason:
            case JointLimit() as reason:
                word = self.word(found.step)
                return self.joint_limit(found, reason, word if name == word else f"{word} {name}")
            case OutOfReach() | TooNear() | InnerCylinder() as reason:
                inches = f"{enough_digits(reason.excess / INCH, 2)} in"
                least = f"{enough_digits(reason.excess / INCH, 2, up=True)} in"
                away, nearer = f"too close to the column of the {arm} arm", "away from"
                if isinstance(reason, OutOfReach):
                    away, nearer = f"beyond the reach of the {arm} arm", "closer to"
                message = f"{name} is {inches} {away}"
                help = f"move the position at least {least} {nearer} the arm{self.counted(name)}"
                return self.at_position(found, message, help=help, notes=(note,))
            case BelowTable():
                return self.at_position(
                    found, f"{note} on its way to {name}", help="use `VIA` to add a position on the way"
                )
        message = f"the {arm} arm cannot put the hand at {name}"
        return self.at_position(found, message, help=help, notes=(note,))

    def off_the_way(self, found: NoConfiguration, place: str) -> Diagnostic:
        message = f"{place}, the hand would leave the arm's reach"
        help = "shorten the motion, or start from another place"
        match found.reason:
            case JointLimit() as reason:
                return self.joint_limit(found, reason, self.word(found.step), place)
            case InLine():
                message = f"{place}, the hand could not keep its angles"
                help = "tilt the hand a little, or use a `MOVE`, which is free to turn the hand on its way"
            case TooFast(joint=joint):
                message = f"{place}, {named(self.arm, joint)} would have to move too fast"
                help = "move more slowly, or start from another place"
        return self.at_position(found, message, help=help, notes=(reach_sentence(self.arm, found.reason),))

    def joint_limit(
        self, found: NoConfiguration, reason: JointLimit, motion: str, place: str | None = None
    ) -> Diagnostic:
        beyond, limit = (
            f"{enough_digits(reason.excess / DEGREE, 1)} degrees",
            counted(round(reason.limit / DEGREE), "degree"),
        )
        joint = named(self.arm, reason.joint)
        message = f"`{motion}` would take {joint} {beyond} beyond its limit of {limit}"
        if place is None:
            help = self.radians(found.position)
            help = help or "turn the hand: other angles O, A, T can be within the limits"
            return self.at_position(found, message, help=help)
        help = (
            "shorten the motion"
            if self.goal(found.step) is None
            else "use `VIA` to add a position on the way"
        )
        return self.at_position(found, message, help=help, notes=(f"{place}, the joint reaches its limit",))

    def radians(self, name: str | None) -> str | None:
        """Return a hint for a position whose angles seem to be in radians."""
        position = None if name is None else self.program.positions.get(name)
        for angle in () if position is None else position.at[3:]:
            parts = angle / DEGREE / (math.pi / 4)
            if 1 <= abs(round(parts)) <= _EIGHTHS and abs(parts - round(parts)) < _TOLERANCE:
                turned = f"{round(parts) * 45} degrees"
                return f"O, A and T are in degrees, but {angle / DEGREE:g} looks like {turned} in radians"
        return None

    def counted(self, name: str) -> str:
        """Return `; the position is relative to ...` if the position is relative to a part, or "" if it is not."""
        position = self.program.positions.get(name)
        of = None if position is None else position.of
        return "" if of is None else f"; the position is relative to {quoted(of)}"

    def below_table(self, found: GoalBelowTable) -> Diagnostic:
        message = (
            f"the hand would be {enough_digits(found.depth / INCH, 2)} in below the table at {found.position}"
        )
        return self.at_position(found, message, help="the table top is z = 0; raise the position")

    def runs_into(self, found: RunsInto) -> Diagnostic:
        what = "the hand" if found.held is None else f"{quoted(found.held)} in the hand"
        depth = f"{enough_digits(found.depth / INCH, 2)} in"
        into = f"would be {depth} below the table"
        if found.fixture is not None:
            into = f"would go {depth} into {quoted(found.fixture)}"
        message = f"{self.along(found.step, found.along)}, {what} {into}"
        help = "add a position on the way, so that the hand goes around the obstacle or over it"
        if self.goal(found.step) is None:
            if found.at_end:
                message = f"{what} {into} at the end of this `{self.word(found.step)}`"
            help = "shorten the motion, or give it a `STOP` if it should touch something"
        elif found.position is not None:
            message, help = f"{what} {into} at {found.position}", "raise or move the position"
        taken = None if found.held is None else found.grasp
        labels = () if taken is None else (Label(span=self.word_span(taken), text="grasped here"),)
        return self.at_position(found, message, help=help, secondary=labels)

    def too_heavy(self, found: TooHeavy) -> Diagnostic:
        message = f"the arm cannot carry {found.weight / OUNCE_FORCE:.0f} oz on this motion"
        said = Label(span=self.word_span(found.declared), text="declared here")
        help = f"{named(self.arm, found.joint)} reaches its limit at {found.most / OUNCE_FORCE:.0f} oz"
        return self.at_position(found, message, help=help, secondary=(said,))

    def too_weak(self, found: TooWeak) -> Diagnostic:
        vector, turning = found.exerted
        verb, si, unit = ("turn", OUNCE_INCH, "oz-in") if turning else ("press", OUNCE_FORCE, "oz")
        wanted = math.hypot(*vector) / si
        message = f"the arm cannot {verb} with {wanted:.0f} {unit} here"
        message += ", so the stop would never fire" if found.guard else ""
        modifier = "STOP" if found.guard else "FORCE"
        is_riddle = found.guard and not turning and round(wanted) == 600
        return problem(
            found.code,
            message,
            self.modifier_span(found.step, modifier),
            notes=(RIDDLE,) if is_riddle else (),
            help=f"{named(self.arm, found.joint)} reaches its limit at {found.most / si:.0f} {unit}",
        )

    def too_faint(self, found: TooFaint) -> Diagnostic:
        vector, turning = found.exerted
        what, si, unit = ("moment", OUNCE_INCH, "oz-in") if turning else ("force", OUNCE_FORCE, "oz")
        there = "about this axis" if turning else "in this direction"
        hidden = f"a {what} of {math.hypot(*vector) / si:g} {unit}"
        felt = found.felt / si
        return problem(
            found.code,
            f"the arm can hardly distinguish {hidden} from joint friction here",
            self.modifier_span(found.step, "STOP"),
            notes=(
                f"in free air, joint friction that the arm cannot measure can feel like a {what} of up to "
                f"{felt:.2g} {unit} {there}",
            ),
            help=f"write at least {math.ceil(felt)} {unit}",
        )

    def at_position(
        self,
        found: PlanFinding,
        message: str,
        *,
        help: str,
        notes: tuple[str, ...] = (),
        secondary: tuple[Label, ...] = (),
    ) -> Diagnostic:
        """Make a diagnostic that points to the name of the position in a finding, or to the word of the motion if
        the finding has no position.
        """
        name = found.position
        span = self.word_span(found.step) if name is None else self.name_span(found.step, name)
        return problem(found.code, message, span, *secondary, notes=notes, help=help)

    def along(self, number: int, along: float) -> str:
        inches, goal = f"{along / INCH:.1f} in along", self.goal(number)
        return f"{inches} this `{self.word(number)}`" if goal is None else f"{inches} its way to {goal}"

    def goal(self, number: int) -> str | None:
        return self.program.steps[number].operation.goal_position

    def word(self, number: int) -> str:
        return self.program.steps[number].word

    def word_span(self, number: int) -> Span:
        step = self.program.steps[number]
        return self.find(step, step.word) or self.span(step)

    def name_span(self, number: int, name: str) -> Span:
        """Return the span of the name of a position in a statement or its modifiers. If neither the statement nor its
        modifiers contain the name, return the span of the statement's word.
        """
        step = self.program.steps[number]
        places: tuple[Step | SourcePlace, ...] = (*step.modifiers, step)
        found = (self.find(words, name, behind=1) for words in places)
        return next((span for span in found if span is not None), self.word_span(number))

    def modifier_span(self, number: int, word: str) -> Span:
        """Return the span of a modifier. If the statement does not contain this modifier (`PLACE`, for example,
        contains no `STOP`), return the span of the statement's word.
        """
        found = (self.find(words, word) for words in self.program.steps[number].modifiers)
        return next((span for span in found if span is not None), self.word_span(number))

    def find(self, words: Step | SourcePlace, word: str, *, behind: int = 0) -> Span | None:
        """Find the span of `word` in the lines of a step or a place. `behind` is the number of tokens to skip first."""
        span = self.span(words)
        text, start = self.whole.find(span.start)
        lines = scan(text.text[start : start + span.end - span.start], span.start)
        tokens = [token for line in lines for token in line.tokens][behind:]
        return next((token.span for token in tokens if token.text.upper() == word.upper()), None)

    def span(self, words: Step | SourcePlace) -> Span:
        return self.whole.span(words.file, words.line, words.span)


_PHRASES: Final[dict[type[PlanFinding], Callable[[_Phrases, Any], Diagnostic]]] = {
    NoConfiguration: _Phrases.no_configuration,
    GoalBelowTable: _Phrases.below_table,
    RunsInto: _Phrases.runs_into,
    TooHeavy: _Phrases.too_heavy,
    TooWeak: _Phrases.too_weak,
    TooFaint: _Phrases.too_faint,
}
