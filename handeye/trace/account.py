"""Writes a readable account of what happened in a run and why, for readers who know the arm language."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import INCH
from handeye.program import events as happened
from handeye.program.events import AnyEvent, SystemEvent
from handeye.trace.sentences import inches, measures_of, sentence

ASTRAY: Final = 0.02 * INCH  # a motion that ends farther than this from its goal is reported
_BENEATH: Final = " " * 20  # indents the outcome of a step


def account(events: Sequence[AnyEvent]) -> list[str]:
    """Return the account of a run as lines of text. The account lists the stages, gives the time, line, text and
    outcome of each step, and says how the run ended.
    """
    teller = _Teller()
    for event in events:
        teller.tell(event)
    if events and not isinstance(events[-1], happened.RunFinished):
        teller.lines += [
            "",
            f"{teller.clock(events[-1])}  the run pauses here, before the end of the program",
        ]
    return teller.lines


@dataclass(slots=True)
class _Teller:
    lines: list[str] = field(default_factory=list)
    _task: str = ""
    _heading: int | None = None  # the line with the heading of the present stage, if a stage has begun
    _begun: float = 0.0  # when that stage began, s
    _camera: float = 0.0  # part of the stage that the camera's mechanism took, s
    _shift: Array | None = None  # offset of the goal of the present step from its planned place, m
    _off: Array = field(default_factory=lambda: np.zeros(3))
    """Offset (m) from the planned end of the last motion to its actual end. If the next motion is straight, it
    begins with this offset.
    """
    _tested: str | None = None  # the answer to a test, until it is known where the program continues

    def clock(self, event: AnyEvent) -> str:
        """Return the time of an event since the run began (s), formatted for a column."""
        return f"{event.time:z9.2f}"

    def tell(self, event: AnyEvent) -> None:
        match event:
            case happened.RunStarted():
                self._task = event.task
                made = ", ".join(f"{name} {version}" for name, version in event.versions.items())
                self.lines += [sentence(event), f"plan {event.plan}; {made}"]
            case happened.FrictionMeasured():
                self.lines.append(sentence(event))
            case happened.StageStarted():
                self._begun, self._camera, self._heading = event.time, 0.0, len(self.lines) + 1
                self.lines += ["", event.stage.upper()]
            case happened.StageFinished():
                self._lead_on("and the stage ends")
                if self._heading is not None:
                    camera = f", {self._camera:.1f} s of it for the camera" if self._camera else ""
                    took = f"in {round(event.time - self._begun, 3):.1f} s{camera}"
                    self.lines[self._heading] = f"{event.stage.upper()}: {event.status} {took}"
            case happened.UndoStarted():
                self._shift = None
                self.lines.append(f"{self.clock(event)} {event.place:>5}  {sentence(event)}")
            case happened.StepStarted():
                self._lead_on(f"continue at line {event.place}")
                self._shift = None
                self.lines.append(f"{self.clock(event)} {event.place:>5}  {event.text}")
            case happened.StepFinished():
                self._ended(event)
            case happened.ErrorTested():
                self._tested = sentence(event)
            case happened.Adjusted():
                self._shift = np.array(event.shift)
                self._beneath(sentence(event))
            case happened.CameraBusy():
                self._camera += event.seconds
                self._beneath(sentence(event))
            case happened.RunFinished():
                self._lead_on("and the program ends")
                self.lines += ["", f"{self.clock(event)}  {sentence(event)}"]
            case happened.OperatorCalled() | happened.PanicStopped() | happened.OperatorAnswered():
                self._lead_on("and there it stops")
                self.lines.append(f"{self.clock(event)}  *** {sentence(event)}")
            case happened.StageUndone() | happened.UndoEnded():
                self.lines += ["", f"{self.clock(event)}  {sentence(event)}"]
            case (
                happened.ExperimentMade()
                | happened.PeriodsCommanded()
                | happened.LineTyped()
                | happened.WentBack()
                | happened.UndoOrdered()
            ):
                self.lines.append(f"{self.clock(event)}  *** {sentence(event)}")
            case SystemEvent():
                self._beneath(sentence(event, measures_of(self._task)))
            case _:
                self._beneath(sentence(event))

    def _beneath(self, text: str) -> None:
        self.lines.append(f"{_BENEATH}{text}")

    def _lead_on(self, where: str) -> None:
        """Report the result of a test, as soon as the next step is known."""
        if self._tested is not None:
            self._beneath(f"{self._tested}: {where}")
        self._tested = None

    def _ended(self, event: happened.StepFinished) -> None:
        """Report where a motion ended. Nothing is reported if the motion ended at its goal, or missed the goal by the
        same offset as the previous motion.
        """
        if event.planned is None or event.hand is None:
            return
        off = np.subtract(event.hand, event.planned)
        shift = np.zeros(3) if self._shift is None else self._shift
        astray = min((off - shift, off - self._off), key=lambda v: float(np.linalg.norm(v)))
        self._off = off
        if np.linalg.norm(astray) > ASTRAY:
            away = f"{np.linalg.norm(astray) / INCH:.2f} in from its planned end"
            self._beneath(f"the hand is at {inches(event.hand)}, {away}")
