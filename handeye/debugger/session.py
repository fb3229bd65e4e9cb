"""A debugging session, which has the runner, the breakpoints, and access to the stored states of the run."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Final, Literal

from handeye.core.errors import Refused
from handeye.core.plain_text import counted
from handeye.debugger.breakpoints import breakpoint
from handeye.debugger.listing import Place, SourceLine, excerpt
from handeye.debugger.live import Pace
from handeye.debugger.reply import Break
from handeye.debugger.views import task_views
from handeye.execution.servo import Halted
from handeye.program.events import StepStarted
from handeye.runs.advance import AnyStop, ByHand, Pause, ReversalEnd, advance, ended
from handeye.runs.observer import Observer
from handeye.runs.operator import beginnings
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.system import Listing

LINES_AROUND: Final = 2  # of the script, before and after the one where the run pauses


class DebugSession:
    """The session on which the stepper's commands act."""

    def __init__(
        self,
        runner: Runner,
        *,
        stops: Sequence[AnyStop] = (),
        kept: Callable[[int], Checkpoint | None],
        keep: Callable[[Checkpoint], Path | None],
        pictures: Path | None,
    ) -> None:
        """Take control of a run. The run pauses at breakpoints and also at `stops`.

        `kept(n)` finds the newest checkpoint on disk in which at most n steps are done. `keep` writes a checkpoint, if
        the run stores checkpoints. `pictures` is the folder to which the last picture is written when the user asks
        for it.
        """
        self.runner = runner
        self.stops = stops
        self.kept = kept
        self.keep = keep
        self.pictures = pictures
        self.breaks: dict[int, AnyStop] = {}  # breakpoints by number; a number is never used twice
        self.over = False
        self.pace = Pace()
        self.output = Observer()  # prints what the run does while it continues
        self.input = Observer()  # takes lines typed while it continues or goes back
        self.going: Literal["on", "back"] | None = None  # the direction of the run; None while it is paused
        self._pause_asked = False
        self._set = 0
        self._begun = tuple(runner.events)

    @property
    def program(self) -> Listing:
        """The stages and steps of the run's program."""
        return self.runner.listing

    @property
    def idle(self) -> bool:
        """True if no step has been executed, or all executed steps were rolled back."""
        return tuple(self.runner.events) == self._begun

    # -- breaks ---------------------------------------------------------------------------------------

    def add_break(self, text: str) -> Break:
        """Set a breakpoint. If the same breakpoint is already set, it keeps its number. Raises InvalidInput if the
        place that `text` names does not exist.
        """
        stop = breakpoint(text, self.program)
        number = next((number for number, there in self.breaks.items() if there == stop), None)
        if number is None:
            number = self._set = self._set + 1
            self.breaks[number] = stop
        return Break(number=number, stop=stop)

    # -- going ----------------------------------------------------------------------------------------

    def go(self, stops: Sequence[AnyStop] = (), steps: int | None = None) -> Pause:
        """Continue until the next breakpoint or the next of `stops`, or for `steps` steps.

        A step that is interrupted by the panic button or a failure is rolled back. Raises InvalidInput if the
        run cannot continue.
        """
        refusal = self.at_its_end()
        if refusal is not None:
            raise Refused(refusal)
        return self._go(stops, steps)

    def have_undone(self, left: int, *, halts: bool = False) -> Pause:
        """Let the arm undo steps until N executed steps remain, where N is `left`. If `halts` is True, the run then
        ends. Raises InvalidInput if the arm cannot undo the steps.
        """
        if self.runner.trouble is not None:
            raise Refused(self.at_its_end() or "")
        self.runner.order_reversal(left, halts=halts)
        return self._go([ReversalEnd()], None)

    def _go(self, stops: Sequence[AnyStop], steps: int | None) -> Pause:
        wanted = [*self.stops, *self.breaks.values(), *stops]
        try:
            with self._attended("on", self.pace, self.output, self.input):
                pause = advance(self.runner, wanted, steps, lambda: self._pause_asked)
        except BaseException:  # whatever the interruption: Ctrl-C, or an error in code of the caller
            self.runner.rollback()
            raise
        if pause.kind == "panic":
            self.runner.rollback()
        return pause

    def ask_pause(self) -> None:
        """Make a moving run pause after the present step. Raises InvalidInput if the run is already paused."""
        if self.going is None:
            raise Refused("the run is already paused")
        if self.going == "back":
            raise Refused("the run is already going back to an earlier state, and pauses there")
        self._pause_asked = True

    @contextmanager
    def _attended(self, going: Literal["on", "back"], *observers: Observer) -> Iterator[None]:
        """Within this context, the run is in progress, and `observers` watch it."""
        self.going = going
        self.runner.observers += observers
        try:
            yield
        finally:
            for observer in observers:
                self.runner.observers.remove(observer)
            self.going, self._pause_asked = None, False

    @property
    def pause(self) -> Pause:
        if self.runner.ended:
            return ended(self.runner)
        return Pause(kind="break", next=self.runner.at, met=ByHand())

    def at_its_end(self) -> str | None:
        """Return the reason why the run cannot continue without the operator, or None if the run can continue."""
        runner = self.runner
        if not runner.ended:
            return None
        if runner.trouble is not None:
            return f"the run can only go back, and cannot continue from here: {runner.trouble}"
        if runner.call is not None:
            given = ", ".join(f"`{word}`" for word in runner.kind.choices(runner))
            return f"the program calls the operator: answer {given} or `abort`, or use `back` or `undo`"
        return "the program has ended: `back` goes back from here, `quit` leaves"

    def back_to(self, position: int) -> None:
        """Go back to the state with `position` steps done. Raises Refused if this state is not stored, or if the panic
        button is pressed.
        """
        try:
            with self._attended("back", self.input):
                self.runner.back_to(position, self.kept)
        except Halted:
            self.runner.rollback()
            done = self.runner.position
            raise Refused(
                f"the panic button stopped the return to the state after {counted(position, 'step')}; "
                f"the run is now at the state after {counted(done, 'step')}"
            ) from None

    def first(self) -> int:
        """Return the number of steps done in the earliest state to which the run can go back."""
        first = self.runner.history[0].position
        while first > 0 and (before := self.kept(first - 1)) is not None:
            first = before.position
        return first

    def stage_began(self) -> int | None:
        """Return the number of steps that were done when the present stage began or, between two stages, when the
        previous stage began. Returns None before the first stage.
        """
        return next(reversed(beginnings(self.runner).values()), None)

    # -- where it stands ------------------------------------------------------------------------------

    @property
    def stage(self) -> int | None:
        """Index of the present or next stage, or None after the last stage."""
        step = self.runner.next
        present = self.runner.stage
        return present if present is not None or step is None else step.stage

    @property
    def place(self) -> Place:
        """File and line of the next step or, if no step follows, of the last step that began."""
        step, events = self.runner.next, reversed(self.runner.events)
        if step is not None:
            return step.file, step.line
        return next(((event.file, event.line) for event in events if isinstance(event, StepStarted)), ("", 1))

    def source(self, place: Place | None = None, around: int = LINES_AROUND) -> tuple[SourceLine, ...]:
        """Return the lines of the script around a line, or around the present line by default."""
        file, line = place or self.place
        here = self.place[1] if self.place[0] == file else None
        return excerpt(self.program, line, here, around, file, task_views(self.runner))
