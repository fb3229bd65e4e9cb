"""Places in runs: a step as it was carried out."""

from handeye.core.record import Record
from handeye.core.source import line_name
from handeye.program.events import StepStarted
from handeye.report.recorded import Recorded


class Place(Record, frozen=True, kw_only=True):
    """A step as it was carried out."""

    stage: str
    step: int
    """Its number in its program."""
    file: str = ""
    """The required file it stands in; empty: the source itself."""
    line: int
    text: str
    time: float
    """When it began, s since the run began."""

    @property
    def name(self) -> str:
        """Its line, as people are told: `12`, or `pins.al:12`."""
        return line_name(self.line, self.file)


def place_of(run: Recorded, started: StepStarted) -> Place:
    """The place of a step that was begun."""
    program = run.program
    return Place(
        stage=program.stages[program.steps[started.step].stage],
        step=started.step,
        file=started.file,
        line=started.line,
        text=started.text,
        time=run.seconds(started.time),
    )
