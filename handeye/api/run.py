"""A run controlled from Python: step it, go back, and read its state."""

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

import msgspec
import numpy as np
from numpy.typing import NDArray

from handeye.api.control import Controller, take_control
from handeye.api.exporting import exported
from handeye.api.plans import Plan
from handeye.api.run_page import run_page
from handeye.api.state import Answer, State, answer, state_of
from handeye.api.trace import Trace
from handeye.arm.model import ArmModel
from handeye.core.arguments import given_count, given_file, given_place
from handeye.core.brief import Several
from handeye.core.errors import BadArgument, Refused
from handeye.core.files import check_place
from handeye.core.plain_text import counted
from handeye.debugger.breakpoints import breakpoint, is_ahead, stage_number
from handeye.debugger.reply import Break
from handeye.debugger.stepper import Stepper
from handeye.debugger.views import last_picture
from handeye.program.events import AnyEvent
from handeye.results.finishing import finished, outcome
from handeye.results.judging import Referee
from handeye.results.pauses import pause_sentence
from handeye.results.pictures import annotated_png, annotated_webp
from handeye.results.result import Result
from handeye.runs.advance import AfterSteps, AnyStop, AtStage, DriverFailure, Pause
from handeye.runs.checkpoint_file import CHECKPOINT, write_checkpoint
from handeye.runs.exported_state import present_state
from handeye.runs.folder import TRACE, RunFolder
from handeye.runs.host_seconds import Meter
from handeye.runs.operator import Operator, attend, beginnings
from handeye.runs.setup import plan_of
from handeye.runs.undo_orders import stage_began
from handeye.trace.reading import read_trace_as

if TYPE_CHECKING:
    from handeye.results.export import Export

Place = str | int
"""A place in the script: a stage (its name or part of its name), a label, an instruction, `error:N`, or a line."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunEnding:
    """The objects that a run uses when it ends: the folder to complete, the referee that judges the run, and the timer
    of the computing time.
    """

    folder: RunFolder | None
    judged: bool
    referee: Referee | None
    meter: Meter  # measures the host time of the run


class Run:
    """The execution of a plan in a world. A run pauses where you ask. `handeye.begin` starts a run.

    Methods that advance the run return the `State` in which the run pauses; `State.why` gives the reason for the
    pause. The run is closed when its `with` block ends.

    In the example, `CLOSE .5` expects a part at least half an inch thick between the fingers. The hand is empty, so
    the program calls the operator.

    >>> with handeye.begin("OPEN 1\\nL1: CLOSE .5\\nOPEN 2\\n", camera="ray") as run:
    ...     state = run.until("L1")
    ...     print(state.line, state.why)
    ...     print(run.until().why)
    2 breakpoint at label L1
    the program called the operator: ...
    """

    def __init__(self, stepper: Stepper, keeping: RunEnding, why: str) -> None:
        """Not for callers: use `handeye.begin`."""
        self._stepper, self._session = stepper, stepper.session
        self._runner, self._keeping = stepper.session.runner, keeping
        self._why: str | None = why
        self._closed: Result | None = None
        self._outcome: tuple[int, Result] | None = None
        self._broken: DriverFailure | None = None

    # -- running --------------------------------------------------------------------------------------

    def step(self, n: int = 1) -> State:
        """Execute the next `n` steps, or fewer if the run stops earlier: at a breakpoint, at a call to the operator or
        at the end of the program.

        Raises:
            InvalidInput: the run cannot continue, or `n` is not a whole number of 1 or more.
        """
        return self._go(steps=given_count(n, "steps"))

    def until(self, place: Place | None = None) -> State:
        """Run to a place, or to the end if no place is given. A breakpoint or a call to the operator pauses the run
        earlier.

        Args:
            place: a stage, by its name or a unique part of it; a label; an instruction (`"AOJ"`: the next step that
                begins with `AOJ`); a line (58, or `"pins.al:3"` for line 3 of that file); or an error
                (`"error:23"`: after the step that raises error 23).

        Raises:
            InvalidInput: the run cannot continue, the place does not exist, or the run cannot reach the place from
                here.
        """
        stops: list[AnyStop] = []
        if place is not None:
            stops.append(breakpoint(given_place(place), self._runner.listing))
            if not is_ahead(stops[0], self._runner.checkpoint()):
                raise BadArgument(f"the run cannot reach {place} from here")
        return self._go(stops)

    def back(self, steps: Place = 1) -> State:
        """Restore the run (arm, parts, program and clock) to its state before the last `steps` steps. The events of
        these steps are dropped.

        Args:
            steps: how many steps to go back; or a stage (its name or a part of the name), to go back to the latest
                beginning of that stage.

        Raises:
            InvalidInput: the run has not done that many steps, or has not reached that stage, or the earlier state
                is no longer stored.
        """
        self._check_open()
        if isinstance(steps, str):
            stage = stage_number(steps, self._runner.listing)
            if stage not in beginnings(self._runner):
                raise Refused(f"stage {self._runner.listing.stages[stage]} has not begun yet")
            position = beginnings(self._runner)[stage]
        else:
            count = given_count(steps, "steps")
            position = self._runner.position - count
            if position < 0:
                raise _too_many(count, self._runner.position, "done")
        self._session.back_to(position)
        return self._stand("went back")

    def undo(self, steps: Place = 1) -> State:
        """Make the arm undo its work with guarded motions, the last step first. The program can then continue from the
        step that the arm has reached.

        `back` resets the simulator; `undo` moves the arm, as on a real machine. The undone steps stay in the
        events. If a motion meets unexpected resistance, or if the hand no longer holds the object that it held
        when the step was executed, the program calls the operator.

        Args:
            steps: how many executed steps to undo; or a stage (its name or a part of the name), to undo back to the
                latest beginning of that stage.

        Raises:
            InvalidInput: the run has executed fewer steps than `steps`, or cannot continue.

        >>> run = handeye.begin("OPEN 1\\nOPEN 2\\n", camera="ray")
        >>> run.until().why
        'the program finished'
        >>> run.undo().line
        2
        """
        self._check_open()
        executed = self._runner.system.executed
        if isinstance(steps, str):
            stage = stage_number(steps, self._runner.listing)
            left = stage_began(executed, self._runner.listing, stage)
        else:
            count = given_count(steps, "steps")
            left = len(executed) - count
            if left < 0:
                raise _too_many(count, len(executed), "executed")
        return self._stand(reason(self._session.have_undone(left)))

    def dismantle(self) -> State:
        """Make the arm undo all its work. The run then ends, and `result.apart` gives the referee's verdict on the
        dismantling.

        Raises:
            InvalidInput: there is nothing to undo.
        """
        self._check_open()
        pause = self._session.have_undone(0, halts=True)
        self._keeping = replace(self._keeping, judged=True)
        return self._stand(reason(pause))

    def break_at(self, place: Place) -> Break:
        """Set a breakpoint: the run pauses whenever it reaches `place`. The places are the same as for `until`.

        Returns:
            the breakpoint; `run.say("delete 1")` removes the breakpoint with the `number` 1.

        Raises:
            InvalidInput: the place does not exist, or the run is closed.
        """
        self._check_open()
        return self._session.add_break(given_place(place))

    def say(self, line: str) -> Answer:
        """Execute a command of the stepper (`handeye run --step`), such as `"show force"`, `"set saved H 0 0 .1"`
        or `"retry"`.

        Returns:
            the answer as a record; `print` shows the answer as the stepper does. A command that cannot be executed
            changes nothing, and the answer's `error` gives the reason.

        Raises:
            InvalidInput: the line is not a string, or the run is closed.

        >>> run = handeye.begin("OPEN 1\\nOPEN 2\\n", camera="ray")
        >>> print(run.say("show gap"))
        ── stage 1, program, step 0; 0 steps done, 0.00 s
        gap       -0.002 in
        """
        self._check_open()
        if not isinstance(line, str):
            raise BadArgument(f"a command of the stepper must be a text, not {line!r}")
        reply = self._stepper.do(line)
        self._why = None if reply.pause is None else reason(reply.pause)
        if self._stepper.over:
            self.close()
        return answer(reply)

    def _go(self, stops: list[AnyStop] | None = None, steps: int | None = None) -> State:
        self._check_open()
        self._why = None
        return self._stand(reason(self._session.go(stops or [], steps)))

    def reach(self, stage: int) -> State:
        """Run until just before a stage, given by its index from 0; do nothing if the run is already just before that
        stage.

        Raises:
            InvalidInput: the run ended or stopped before that stage; the run is then closed.
        """
        name = self._runner.listing.stages[stage]
        begins = AtStage(stage=stage, name=name)
        if begins.met_before(self._runner) or (stage == 0 and not self._runner.position):
            return self.state
        try:
            if not is_ahead(begins, self._runner.checkpoint()):
                raise BadArgument(f"the run never reaches “{name}” from the step at which the run begins")
            state = self._go([begins])
            if not begins.met_before(self._runner):
                raise Refused(f"the run stopped before “{name}”: {state.why}")
        except BaseException:
            self.close()
            raise
        return state

    def attend(self, operator: Operator) -> State:
        """Run to the end. Let the operator (a person or a rule) answer each time the program calls for help."""
        self._check_open()
        try:
            pause = attend(self._runner, operator, [], self._session.kept)
        except BaseException:
            self._runner.rollback()
            raise
        return self._stand(reason(pause))

    def control(self, controller: Controller, seconds: float = 60.0) -> State:
        """Let a controller command the arm, once in every servo period (1/60 s). The program continues when the
        control has ended.

        The controller knows the cell only through the sensors. The controller receives the readings at the end of a
        servo period: `time` (s), `q` and `qd` (joint positions and rates, shape (n,), rad and m), `gap` (m), `touch`
        (the two switches of the fingers), `tool_torque` (of the screwdriver, N m), and `braked`. The controller
        returns a `handeye.Command` for the next period, or None to end its control. When the control ends, the brakes
        are set for .1 s, and the arm comes to rest. Fingers and screwdriver keep their last commands. `run.arm` is the
        model of the arm; the functions of `handeye.arm` use it.

        The commands are recorded as an event of the run, so `handeye trace verify` and `back` repeat them. Afterwards,
        the arm cannot undo the steps that it executed before the control.

        Args:
            controller: a function that takes the readings, and returns the command or None.
            seconds: greatest simulated time for which the controller commands the arm.

        Raises:
            InvalidInput: the run cannot be controlled now, an argument cannot be used, or the controller returned
                something other than a command.
            PhysicsFailed: the simulation became unstable.

        If the controller raises an exception, the run returns to its state before the control.

        >>> run = handeye.begin("OPEN 1\\nOPEN 2\\n", camera="ray")
        >>> wait = lambda seen: handeye.Command() if seen.time < 0.5 else None
        >>> round(run.control(wait).time, 2)
        0.62
        """
        self._check_open()
        return self._stand(take_control(self._runner, controller, seconds))

    def _stand(self, why: str) -> State:
        self._why = why
        return self.state

    # -- knowing --------------------------------------------------------------------------------------

    @property
    def plan(self) -> Plan:
        """The plan of the run."""
        return Plan(record=plan_of(self._runner.setup))

    @property
    def arm(self) -> ArmModel:
        """The model of the arm, with the link weights that the arm has measured. All other values are those of the
        drawings. The arm of a world differs from the drawings, and only measurements show by how much.
        """
        return self._runner.context.drive.built

    @property
    def state(self) -> State:
        """The state in which the run is paused."""
        stage = self._session.stage
        name = None if stage is None else self._runner.listing.stages[stage]
        why = reason(self._session.pause) if self.ended else self._why
        return state_of(self._runner, name, why or "paused")

    @property
    def events(self) -> tuple[AnyEvent, ...]:
        """All events as records of `handeye.program.events`, without the events of steps that `back` has dropped."""
        return Several(self._runner.events)

    @property
    def picture(self) -> NDArray[np.uint8] | None:
        """The last picture that the program took, shape (256, 333), from 0 (black) to 15 (white); None if the
        program has not taken a picture.
        """
        name = last_picture(self._runner)
        return None if name is None else self._runner.system.shots[name].picture.copy()

    @property
    def picture_png(self) -> bytes | None:
        """The last picture that the program took, with the detected features drawn over it, as a PNG file; None if
        the program has not taken a picture.
        """
        name = last_picture(self._runner)
        return None if name is None else annotated_png(self._runner.system, name)

    @property
    def ended(self) -> bool:
        """True if the run can continue only after an answer of the operator, or after `back`."""
        return self._runner.ended

    @property
    def out(self) -> Path | None:
        """The folder that holds the run; None if the run has no folder."""
        return None if self._keeping.folder is None else self._keeping.folder.path

    @property
    def trace(self) -> Trace:
        """The trace of the closed run.

        Raises:
            InvalidInput: the run has no folder, or is not closed.
        """
        if self.out is None:
            raise Refused("the run has no folder, and so no trace; begin the run with out=...")
        if self._closed is None:
            raise Refused(
                "the trace is complete only after the run is closed: leave the `with` block, or call close()"
            )
        return read_trace_as(Trace, self.out / TRACE)

    @property
    def result(self) -> Result:
        """The result of the run so far. The referee judges the run only if the program has ended."""
        if self._closed is not None:
            return self._closed
        happened = len(self._runner.events)
        if self._outcome is None or self._outcome[0] != happened:
            self._outcome = happened, self._ended(outcome)
        return self._outcome[1]

    @property
    def completed(self) -> bool:
        """True if the program ended, or if the arm has undone all the steps that it was asked to undo."""
        return self.result.completed

    @property
    def assembled(self) -> bool | None:
        """True if the referee accepts the work, False if not; None if the referee has not judged the work."""
        return self.result.assembled

    # -- keeping --------------------------------------------------------------------------------------

    def checkpoint(self, path: str | os.PathLike[str] | None = None) -> Path:
        """Save the present state as a checkpoint, from which `handeye.begin` and `handeye resume` can continue.

        Args:
            path: the file to write; by default a new one in the folder of the run.

        Returns:
            the file.

        Raises:
            InvalidInput: the file cannot be written, the run is closed, or no file is given for a run without a
                folder.
        """
        self._check_open()
        kept = self._runner.checkpoint()
        if path is None:
            folder = self._keeping.folder
            if folder is None:
                raise Refused("this run has no folder for checkpoints; name a file")
            return folder.kept.save(kept)
        file = given_file(path, "the destination of a checkpoint must be a file")
        check_place(file, CHECKPOINT)
        write_checkpoint(file, kept)
        return file

    def export(
        self, path: str | os.PathLike[str], *, part: str | None = None, overwrite: bool = False
    ) -> "Export":
        """Export the present state of the cell to other programs; the run may be open or closed.

        Args:
            path: a folder, to export a scene that plain MuJoCo can load; or a file name that ends in `.glb`, to
                export the solids as a 3D model.
            part: which solids to export: `cell` (the default) or `pump`.
            overwrite: replace an existing export.

        Returns:
            a record of the written files, with remarks; for an unfinished run, its `moment` is `unfinished`.

        Raises:
            InvalidInput: the export cannot be written at `path`, `part` is neither `cell` nor `pump`, or the run has
                no cell.

        >>> run = handeye.begin("OPEN 1\\n", camera="ray")
        >>> run.export(folder).moment
        'unfinished'
        """
        return exported(path, lambda: present_state(self._runner), part, overwrite=overwrite)

    def close(self) -> None:
        """End the run and complete its folder: trace, pictures, result and, if the run could continue, a
        checkpoint.
        """
        if self._closed is not None:
            return
        folder = self._keeping.folder
        try:
            if folder is not None and not self.ended:
                folder.checkpoint(self._runner.checkpoint())
            self._closed = self._ended(finished, folder=folder)
        finally:
            if folder is not None:
                folder.close()

    def _ended(self, make: Callable[..., Result], **more: Any) -> Result:
        """Make the result of the run in its present state."""
        keeping, pause = self._keeping, self._session.pause
        if self._broken is not None and pause.kind == "break":
            pause = msgspec.structs.replace(pause, met=self._broken)
        return make(
            self._runner,
            pause,
            keeping.meter,
            judged=keeping.judged,
            referee=keeping.referee,
            **more,
        )

    def _check_open(self) -> None:
        if self._closed is not None:
            raise Refused("the run is closed; begin another, or continue from one of its checkpoints")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is not None:
            self._broken = DriverFailure(exception=kind.__name__)
        self.close()

    # -- showing --------------------------------------------------------------------------------------

    def __repr__(self) -> str:
        setup = self._runner.setup
        return f"<Run {self._runner.listing.name}, {setup.world}: {self.state}>"

    def _repr_html_(self) -> str:
        name = last_picture(self._runner)
        webp = None if name is None else annotated_webp(self._runner.system, name)
        return run_page(self.result, self.state, name, webp)


def _too_many(steps: int, done: int, how: str) -> Refused:
    """Return the exception for a request to undo more steps than were executed. `how` is the verb in the message of
    the exception.
    """
    left = f"only {done} {'has' if done == 1 else 'have'}" if done else "none has"
    return Refused(f"{counted(steps, 'step')} cannot be undone: {left} been {how}")


def reason(pause: Pause) -> str:
    """Return the reason for a pause in words, as in `paused after 2 steps`."""
    if isinstance(pause.met, AfterSteps):
        return f"paused after {counted(pause.met.count, 'step')}"
    said = pause_sentence(pause)
    return f"the program called the operator: {said}" if pause.kind == "operator" else said
