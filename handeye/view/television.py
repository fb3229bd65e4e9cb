"""The picture of the television camera that those who look on are shown, with what was found in it."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import msgspec

from handeye.program.events import AnyEvent, ErrorRaised, PartInspected, PartMatched, PartSeen, PictureTaken
from handeye.report.facts.seen import Finding, SeenPicture
from handeye.report.page.seen import figure
from handeye.runs.runner import Runner
from handeye.runs.system import Listing, RunningSystem
from handeye.trace.steps import DoneStep, done_steps

NEWS = PictureTaken | PartSeen | PartInspected | PartMatched | ErrorRaised
"""Events after which there is another picture, or more on it."""


@dataclass(frozen=True, eq=False)
class Television:
    """What the television shows; a value that stays what it is, whatever the run does."""

    picture: SeenPicture | None = None
    """The picture that the program took or examined last, timed by the cell's clock; None: it has taken none."""

    @property
    def shows(self) -> tuple[float, str, Sequence[Finding]] | None:
        """What tells it from others: the picture and what was found in it."""
        return None if self.picture is None else (self.picture.time, self.picture.name, self.picture.findings)

    @cached_property
    def message(self) -> str:
        """The same for pages: markup, none where there is no picture."""
        shown = "" if self.picture is None else figure(self.picture, self.picture.name)
        return msgspec.json.encode({"television": str(shown)}).decode()


def television(runner: Runner) -> Television:
    """What the television shows of a run."""
    return shown(runner.events, runner.listing, runner.system)


def shown(events: Sequence[AnyEvent], listing: Listing, system: RunningSystem) -> Television:
    """What the television shows after some events, copied from what the program remembers."""
    taken, findings = _last(events, listing) if system.shots else (None, ())
    if taken is None or taken.picture not in system.shots:
        return Television()
    return Television(
        SeenPicture(
            time=taken.time,
            name=taken.picture,
            lens=taken.lens,
            picture=system.shots[taken.picture].picture.copy(),
            marks=tuple(system.marks(taken.picture)),
            findings=tuple(findings),
        )
    )


def _last(events: Sequence[AnyEvent], listing: Listing) -> tuple[PictureTaken | None, Sequence[Finding]]:
    """The picture that was taken or looked at last, and what was found in it."""
    taken: dict[str, PictureTaken] = {}
    findings: dict[str, list[Finding]] = {}
    last = None
    for step in done_steps(events):
        for event in step.events:
            if isinstance(event, PictureTaken):
                taken[event.picture], findings[event.picture], last = event, [], event.picture
        examined = _examined(step, listing)
        if examined in taken:
            findings[examined] += [event for event in step.events if isinstance(event, Finding)]
            last = examined
    return (None, ()) if last is None else (taken[last], findings[last])


def _examined(step: DoneStep, listing: Listing) -> str | None:
    return listing.steps[step.started.step].examines
