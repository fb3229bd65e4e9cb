"""A job of a command that moves the arm: build the cell, run, save, judge, print."""

import shlex
import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

from handeye.cli.common import CALLED, note, notes, put, put_line, say, screen
from handeye.cli.panic_button import PanicButton
from handeye.cli.prompt import PipedLines, typed_already, typed_lines
from handeye.cli.reports import write_report
from handeye.cli.saving import OptionalRecord, StageKeeper
from handeye.core.entries import entry_named
from handeye.core.errors import InvalidInput
from handeye.core.host_time import HostTimer
from handeye.core.plain_text import size
from handeye.debugger.ask import Ask
from handeye.debugger.breakpoints import breakpoint
from handeye.debugger.command_table import commands_of
from handeye.debugger.formatting import MAX_STEPS_SHOWN
from handeye.debugger.live import Live
from handeye.debugger.stepper import Stepper, interact
from handeye.execution.servo import Halted
from handeye.judge.finding import all_right
from handeye.results.cautions import cautions, losses
from handeye.results.finishing import finished, keep_outcome
from handeye.results.judging import findings
from handeye.results.page import page, short_page
from handeye.results.progress import Progress
from handeye.results.result import to_json
from handeye.runs.advance import AnyStop, Pause
from handeye.runs.checkpoint_store import CheckpointStore, leave
from handeye.runs.folder import PICTURES, REPORT, RunFolder, open_new
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.operator import attend, parse_policy
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import listing_of
from handeye.runs.unnamed_runs import UnnamedRun, bytes_of, held, runs_folder
from handeye.tasks import option

if TYPE_CHECKING:
    from handeye.view.moment import Newest
    from handeye.view.server import Server

Then = Literal["dismantle", "assemble"]  # Undo all the work, or do it again

PANIC: Final = Pause(kind="panic")
NOT_KEPT: Final = "the run is not saved and cannot be resumed; --out FOLDER would save it"


@dataclass(frozen=True, slots=True, kw_only=True)
class Job:
    """A run to begin or to resume, and its options."""

    start: Checkpoint
    folder: RunFolder | None = None  # Folder of a run that is resumed
    out: Path | None = None
    keep: bool = False  # Keep the run in the folder of runs if no other folder is named
    overwrite: bool = False
    calibrate: bool = False
    checkpoints: Path | None = None  # Another folder for checkpoints at the beginning of stages
    stops: Sequence[AnyStop] = ()  # Places where the run pauses and the command ends
    breaks: Sequence[str] = ()
    halfway: bool = False  # Save a checkpoint where the run pauses, if the run has no folder
    step: bool = False
    live: bool = False  # Show each line as it begins, and accept commands during the run
    server: "Server | None" = None  # Serves the page in which the run is stepped, instead of the terminal
    on_stop: str | None = None
    json: bool = False
    details: bool = False
    report: bool = False
    referee: bool = False
    listening: Sequence[Observer] = ()  # Observers that the system's own command adds
    then: Sequence[Then] = ()
    """What the arm does after the program has ended, in this order. The arm begins the next item only if the referee
    has accepted the work so far.
    """
    planning_cpu_s: float = 0.0


class _Work:
    """A job in progress."""

    def __init__(self, job: Job, panic: PanicButton) -> None:
        self.job = job
        self.panic = panic
        policy = self.job.on_stop
        if policy is None:
            policy = "ask" if sys.stdin.isatty() and notes.is_terminal and not self.job.json else "abort"
        # checked first, so that an unknown word creates no folder
        self.policy = parse_policy(policy, listing_of(self.job.start.setup).stages)
        self.folder = job.folder
        if self.folder is None and job.out is not None:
            self.folder = open_new(job.out, job.start, overwrite=job.overwrite)
        self.unnamed = self._unnamed() if self.folder is None and job.keep else None
        if self.unnamed is not None:
            self.folder = self.unnamed.folder
        self.meter = Meter(
            timer=HostTimer.of_command(),
            planning_cpu_s=job.planning_cpu_s,
            before=None if job.folder is None else job.folder.spent,
        )
        self.progress = Progress(listing_of(job.start.setup).stages, notes)
        self.newest: Newest | None = None
        self.refused = False
        self.left: Path | None = None
        """The last checkpoint that was saved outside the folder of the run."""

    def _unnamed(self) -> UnnamedRun | None:
        """Return a folder for a run for which the user named no folder. Returns None if unnamed runs are not saved, or
        if the folder cannot be made: the run then continues without a folder.
        """
        home = runs_folder()
        if home is None:
            return None
        try:
            return UnnamedRun(home, self.job.start)
        except InvalidInput as fault:
            note(f"the run is not saved: {fault}")
        return None

    @contextmanager
    def keeping(self) -> Iterator[Observer]:
        """The observer that saves the run. If the user named no folder and the default folder can no longer be
        written, the run continues without a folder.
        """
        try:
            yield Observer() if self.folder is None else self.folder
        except (InvalidInput, OSError) as fault:
            if self.unnamed is None or self.folder is None:
                raise
            note(f"the rest of the run is not saved: {fault}")
            self.folder = None

    def close(self) -> None:
        """Close the files."""
        if self.unnamed is not None:
            with suppress(InvalidInput):
                self.unnamed.close()
        elif self.folder is not None:
            self.folder.close()

    def do(self) -> int:
        """Run the job; return the exit code."""
        runner = self._built()
        if runner is None:
            return self._interrupted(None)
        try:
            pause = self._stepped(runner) if self.job.step else self._parts(runner)
        except KeyboardInterrupt:
            pause = PANIC
            with self.keeping() as folder:
                folder.checkpoint(runner.checkpoint())
        if pause.kind == "panic":
            return self._interrupted(runner)
        with self.panic.released():
            code = self._finished(runner, pause)
        return code or 2 * (self.refused and not sys.stdin.isatty())

    def _built(self) -> Runner | None:
        """The runner, ready for its first step; None if the panic button was pressed during set-up."""
        try:
            with self.progress:
                runner = Runner(
                    self.job.start,
                    halt=self._halted,
                    viewed=self.progress.viewed,
                    observers=self._observers,
                    calibrate=self.job.calibrate,
                )
        except Halted:
            if self.unnamed is not None:
                self.unnamed.discard()
                self.unnamed = self.folder = None
            return None
        except BaseException:
            if self.unnamed is not None:
                self.unnamed.discard()
            elif self.folder is not None and self.job.folder is None:
                self.folder.discard()
            raise
        for sentence in cautions(runner, judged=self.job.referee):
            note(sentence)
        for sentence in () if self.folder is None else losses(self.folder, runner):
            note(sentence)
        return runner

    def _halted(self) -> bool:
        """True if the panic button was pressed, at this terminal or in the browser."""
        return self.panic() or (self.job.server is not None and self.job.server.link.panic())

    def _observers(self, runner: Runner) -> list[Observer]:
        looking: list[Observer] = [*self.job.listening]
        looking += [] if self.job.step else [self.progress]
        if self.job.start.stage is not None:
            self.progress.goes_on(self.job.start.stage)
        with self.keeping() as folder:
            if isinstance(folder, RunFolder):
                again = self.job.folder is not None
                folder.watch(runner, self.job.start, again=again, meter=self.meter)
                looking.append(folder if self.unnamed is None else OptionalRecord(self.keeping))
        if self.job.checkpoints is not None:
            looking.append(StageKeeper(self.job.checkpoints, self.job.start.setup))
        if self.job.server is not None:
            from handeye.view.moment import Newest

            self.newest = Newest(runner)
            looking.append(self.newest)
        return looking

    # -- carrying out ---------------------------------------------------------------------------------

    def _parts(self, runner: Runner) -> Pause:
        """Assemble, then carry out the further parts of the job. Stop early if the referee rejects a result."""
        pause = runner.kind.carry_out(runner, lambda: self._attended(runner))
        for part in self.job.then:
            if pause.kind != "end" or not all_right(findings(runner, pause)):
                break
            words = runner.task.words
            note(words.apart if runner.undone else words.done)
            if part == "dismantle":
                runner.order_reversal(0, halts=True)
            else:
                runner.answer("proceed")
            pause = self._attended(runner)
        return pause

    def _attended(self, runner: Runner) -> Pause:
        with self.progress:
            breaks = [breakpoint(text, runner.listing) for text in self.job.breaks]
            lines = typed_lines("> ", self._waiting, lambda: (), droppable=False)
            return attend(runner, self.policy or Ask(lines, note), [*breaks, *self.job.stops], self._kept)

    def _stepped(self, runner: Runner) -> Pause:
        stepper = Stepper(
            runner,
            breaks=self.job.breaks,
            stops=self.job.stops,
            kept=self._kept,
            keep=self._keep,
            pictures=None if self.folder is None else self.folder.path / PICTURES,
        )
        if self.job.server is not None and self.newest is not None:
            return self._stepped_in_browser(stepper, self.job.server, self.newest)
        names = [name for settable in runner.system.settables().values() for name in settable.names]
        commands = (command.name for command in commands_of(runner))
        words = [*commands, *runner.kind.topics, *runner.listing.labels, *names]
        lines, live = self._lines(words)
        if self.folder is None and self.job.checkpoints is None:
            note("without --out FOLDER the run is not saved; `checkpoint FILE` saves its present state")
        most = MAX_STEPS_SHOWN if screen.is_terminal else None
        try:
            write, prompt = put_line if self.job.json else say, sys.stdin.isatty()
            return interact(stepper, lines, write, json=self.job.json, prompt=prompt, most=most, live=live)
        finally:
            self.refused = stepper.refused

    def _stepped_in_browser(self, stepper: Stepper, server: "Server", newest: "Newest") -> Pause:
        from handeye.view.stepping import drive, stepping_page

        with self.progress.aside():
            note("making the page")
            server.show(stepping_page(stepper.session.runner, newest), newest)
            say(server.access.address, whole=True)
            return drive(stepper, server.link, self.panic.aside)

    def _lines(self, words: list[str]) -> tuple[Iterator[str], Live | None]:
        """Lines to execute, and the live display of the run, if there is one."""
        put = partial(screen.print, end="", markup=False, soft_wrap=True)
        if sys.stdin.isatty():
            lines = typed_lines("handeye> ", self._waiting, lambda: words)
            watched = self.job.live or (screen.is_terminal and not self.job.json)
            return lines, Live(typed=typed_already, put=put, width=screen.width) if watched else None
        if not self.job.live:
            return typed_lines("", self._waiting, lambda: words), None
        piped = PipedLines(sys.stdin.fileno())
        return piped.wait(self._waiting), Live(typed=piped.come, put=put, width=screen.width)

    @contextmanager
    def _waiting(self) -> Iterator[None]:
        """A context in which the user is asked for a line. In this context, the progress bar is hidden, and Ctrl-C
        interrupts as usual.
        """
        with self.panic.aside(), self.progress.aside():
            yield
        if sys.stdin.isatty():
            self.panic()  # Ctrl-C that was pressed while nothing moved must not stop the next motion

    def _kept(self, position: int) -> Checkpoint | None:
        """Return the newest state of this run on disk after at most `position` steps, or None if there is no such
        state.
        """
        if self.folder is not None:
            return self.folder.kept.at_or_before(position)
        if self.job.checkpoints is None:
            return None
        begun = self.job.start.position  # a later state may belong to a run that continued differently
        return CheckpointStore(self.job.checkpoints).at_or_before(min(position, begun))

    def _keep(self, checkpoint: Checkpoint) -> Path | None:
        """Save a state to the path given on the command line. Returns None if no path was given."""
        if self.folder is not None:
            self.folder.check_traced()
            return self.folder.kept.save(checkpoint)
        if self.job.checkpoints is not None:
            self.left = leave(self.job.checkpoints, checkpoint)
        return self.left

    # -- ending ---------------------------------------------------------------------------------------

    def _interrupted(self, runner: Runner | None) -> int:
        where = "during the set-up of the cell" if runner is None else f"at {runner.time:.1f} s"
        note(f"interrupted {where}; the brakes are set")
        if self.folder is None and runner is not None:
            try:
                self._keep(runner.checkpoint())
            except InvalidInput as fault:
                note(str(fault))
        self._tell_how_to_go_on(runner)
        return 130

    def _tell_how_to_go_on(self, runner: Runner | None) -> None:
        kept = self.left if self.folder is None else self.folder.path
        if kept is not None:
            words = [str(kept), *option(self.job.start.setup.task)]
            say(f"resume with: {CALLED} resume {shlex.join(words)}", notes, whole=True)
        elif runner is not None and runner.position > max(0, self.job.start.position):
            note(NOT_KEPT)

    def _finished(self, runner: Runner, pause: Pause) -> int:
        job = self.job
        if pause.kind == "break" and job.halfway and self.folder is None:
            self._keep(runner.checkpoint())
        if self.unnamed is None:
            result = finished(runner, pause, self.meter, judged=job.referee, folder=self.folder)
        else:
            result = finished(runner, pause, self.meter, judged=job.referee)
            with self.keeping() as folder:
                if isinstance(folder, RunFolder):
                    keep_outcome(folder, runner, pause, result, photographs=job.referee)
        if self.job.json:
            put(to_json(result, line=self.job.step))
        else:
            screen.print(page(result) if job.details else short_page(result))
            note("")
        self._report()
        if self.folder is not None:
            note(f"saved in {self.folder.path} ({size(bytes_of(self.folder.path))})")
        if self.folder is not None and pause.kind != "break" and not job.json:
            self._tell_what_next()
        if pause.kind in ("break", "operator"):
            self._tell_how_to_go_on(runner)
        return result.exit_code

    def _tell_what_next(self) -> None:
        """Name the commands that show more of a saved run."""
        assert self.folder is not None
        named = () if self.unnamed is not None else (str(self.folder.path),)
        if not self.job.report and "plans" in entry_named(self.job.start.setup.system).can:
            words = ("report", *named, *option(self.job.start.setup.task))
            say(f"see it:     {CALLED} {shlex.join(words)}", notes, whole=True)
        if not self.job.details:
            say(f"all tables: {CALLED} {shlex.join(('show', *named))}", notes, whole=True)

    def _report(self) -> None:
        """Write the report of the run to its folder if requested; a failure does not affect the run."""
        if not self.job.report or self.folder is None:
            return
        place = self.folder.path / REPORT
        try:
            write_report(self.folder.path, place, overwrite=True)
        except InvalidInput as fault:
            note(f"no report is written: {fault}")
        else:
            note(f"report: {place}")


def work(job: Job) -> int:
    """Execute a job, and return the exit code. Raises InvalidInput if a file cannot be used or written."""
    with PanicButton() as panic, ExitStack() as closing:
        if job.folder is not None:
            closing.enter_context(held(job.folder.path))
        under_way = _Work(job, panic)
        closing.callback(under_way.close)
        return under_way.do()
