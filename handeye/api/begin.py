"""Begin a run, resume one, or run it to its end."""

import warnings
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from handeye.api.parts import Camera, Vision, limits_of, parts_of, referee_of
from handeye.api.plans import FileName, Planned
from handeye.api.run import Place, Run, RunEnding
from handeye.api.starts import RunRequest, Start, start_of
from handeye.api.worlds import World
from handeye.core.arguments import given_file, given_place
from handeye.core.errors import BadArgument, CannotWrite, InvalidInput, Refused
from handeye.core.host_time import HostTimer
from handeye.core.plain_text import counted
from handeye.core.variation import WorldSpec
from handeye.debugger.breakpoints import stage_number
from handeye.debugger.session import DebugSession
from handeye.debugger.stepper import Stepper
from handeye.execution.servo import Halted
from handeye.program.events import AnyEvent
from handeye.results.cautions import cautions, losses
from handeye.results.judging import Limits, Referee, check_limits
from handeye.runs.folder import PICTURES, HoldsRun, RunFolder, open_new
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.operator import Operator, parse_policy
from handeye.runs.parts import Parts, name_of
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import listing_of
from handeye.touch.spiral import SearchPattern


def begin(
    script: FileName | Planned | None = None,
    seed: int | None = None,
    *,
    at: Place | None = None,
    world: World | WorldSpec | None = None,
    camera: Camera = "auto",
    search: SearchPattern | None = None,
    vision: Vision | None = None,
    referee: Referee | Limits | None = None,
    judge: bool | None = None,
    taught: FileName | None = None,
    task: str | None = None,
    out: FileName | None = None,
    overwrite: bool = False,
    halt: Callable[[], bool] | None = None,
) -> Run:
    """Begin a run, or resume one. The run pauses before its first step, or before the stage `at`.

    Args:
        script: a script or plan, as for `handeye.plan`; by default the script of the task. To resume a run, give a
            checkpoint. If you give the folder of the run instead, the run continues from its newest checkpoint.
        seed: seed from which the world is generated; 0 by default.
        at: the stage before which the run pauses: its name, a unique part of its name, or its number (the first is 1).
            Earlier stages are executed first. If `script` is the folder of a run, execution begins at the last
            checkpoint before the stage `at`.
        world: a world, instead of a seed.
        camera: renderer of the TV camera: `gl` (OpenGL), `ray` (ray casting, the same on every computer) or `auto`;
            or a class or function that takes a copy of the scene (`mujoco.MjModel`) and returns a renderer. The
            renderer's method `render(data, view)` returns the light that falls on the camera's light-sensitive
            plate: an array of shape (256, 333), in which 1 is a white surface in full light.
        search: a function that gives the places of a search, instead of the square spiral of `SEARCH`. The function
            takes the number of a place, counted from 0, and returns the x and y of that place in table coordinates, as
            multiples of the search step. The function is called once for each number. A resumed run calls the function
            again. For each number, the function must then return the same place as before. The search ends with error
            6 when the function returns None or raises StopIteration, or after the number of places that the `SEARCH`
            allows (49 by default). A search `ALONG` a line does not use the function. When the search goes on to
            another place, the run records an event `SearchAdvanced`. `run.state.memory.place` is the number of the
            current place.
        vision: functions in place of handeye's own vision, by instruction, such as `{"SPECIFIC": my_function}`.
            Pictures are arrays of shape (256, 333) with values from 0 to 15. `view` is the calibrated camera, in the
            position in which it took the picture: `view.project(points)` and `view.back_project(uv, z)` convert
            between points in W (m) and picture points. `part` is the drawing of the part: its planned place `at`, the
            height of its `face`, and its `holes`.
            `GENERAL`: (picture, view, part) returns the place (x, y) of the part's reference point in W, in m.
            `SPECIFIC`: (picture, view, part, (x, y)) returns the part's pose (x, y, yaw), in m and rad; the last
            argument is the place that `GENERAL` found. Both return None if they do not find the part.
            `INSPECT`: (before, after, view, part, (x, y, yaw)) returns True if the gasket on the part is right.
        referee: how to judge the finished work. Give a function that takes the true state of the cell and returns
            findings by name. Or keep the task's referee and give it other limits, such as `{"screws_clamp": 60}`;
            each limit has the unit of its finding. To judge a saved run again, use
            `handeye.begin(folder, referee=...).result`.
        judge: whether the referee judges the run when it ends; by default True if a referee is given, or if the
            resumed run was started with a referee.
        taught: taught positions, as for `handeye.plan`.
        task: name of the task; by default the task of the given plan, program, run or world, else the water pump.
        out: folder for plan, events, trace, checkpoints, pictures and result; without `out`, nothing is written. To
            resume a run in the same folder, give the folder here as well as in `script`.
        overwrite: replace a run that is already in the folder `out`.
        halt: the panic button, a function that handeye calls in every servo period and after every step. When it
            returns True, the brakes are set and the run pauses; the interrupted step is undone. If the function
            returns True while the cell is still being prepared, the run does not begin.

    Limits given as `referee` are saved with the run. Python code (`search`, `camera`, `vision`, `referee`) cannot be
    saved; checkpoints, trace and result hold only the name of the function or class. `handeye resume` and `handeye
    trace verify` refuse a run with such code. `handeye.begin` resumes the run if you give code with the same name.

    Raises:
        ScriptError: the script has errors.
        InvalidInput: an argument cannot be used, the run stopped before it reached the stage `at`, or `halt` returned
            True while the cell was being prepared.

    >>> run = handeye.begin("OPEN 1\\nOPEN 2\\n", seed=3, camera="ray")
    >>> run
    <Run script, seed 3: 0 steps done, 0.00 s, program, line 1: OPEN 1; ready>
    """
    timer = HostTimer()
    parts, own_referee, limits = parts_of(search, camera, vision), referee_of(referee), limits_of(referee)
    wanted = RunRequest(
        seed=seed,
        world=world,
        camera=camera if isinstance(camera, str) and camera != "auto" else None,
        task=task,
        judged=(referee is not None) if judge is None else judge,
        limits=limits,
        replaced=parts.names | ({} if own_referee is None else {"referee": name_of(own_referee)}),
    )
    stage = None if at is None else given_place(at)
    start = start_of(script, wanted, stage=stage, taught=taught, out=out)
    number = None if stage is None else stage_number(stage, listing_of(start.state.setup))
    folder = start.folder
    if folder is None and out is not None:
        folder = _new_folder(given_file(out, "out= must be a folder"), start.state, overwrite)
    judged = start.state.setup.judged if judge is None else judge
    spent = None if start.folder is None else start.folder.spent
    meter = Meter(timer=timer, planning_cpu_s=start.planning_cpu_s, before=spent)
    keeping = RunEnding(folder=folder, judged=judged, referee=own_referee, meter=meter)
    run = _built(start, parts, keeping, halt)
    if number is not None:
        run.reach(number)
    return run


def assemble(
    seed: int | None = None,
    *,
    script: FileName | Planned | None = None,
    world: World | WorldSpec | None = None,
    camera: Camera = "auto",
    search: SearchPattern | None = None,
    vision: Vision | None = None,
    referee: Referee | Limits | None = None,
    taught: FileName | None = None,
    task: str | None = None,
    out: FileName | None = None,
    overwrite: bool = False,
    on_stop: str = "abort",
) -> Run:
    """Run a script to its end and let the referee judge the result, like the command `handeye assemble`.

    Args:
        on_stop: what to do when the program calls the operator: `abort` ends the run; `retry:N` repeats the
            interrupted stage, at most N times; `unwind` first makes the arm undo its work in the interrupted stage,
            then repeats this stage, at most once per stage.

    The other arguments are those of `handeye.begin`.

    Returns:
        the closed run; `assembled`, `completed`, `result` and `events` give the outcome.

    Raises:
        ScriptError: the script has errors.
        InvalidInput: an argument cannot be used.

    >>> run = handeye.assemble(seed=3, script="OPEN 1\\nCLOSE 2\\n", camera="ray")
    >>> run.completed, run.result.error
    (False, 2)
    """
    operator = _rule(on_stop)
    run = begin(
        script,
        seed,
        world=world,
        camera=camera,
        search=search,
        vision=vision,
        referee=referee,
        judge=True,
        taught=taught,
        task=task,
        out=out,
        overwrite=overwrite,
    )
    with run:
        run.attend(operator)
    return run


def _rule(on_stop: object) -> Operator:
    """Return the operator that follows the rule `on_stop`. Raises InvalidInput if `on_stop` is not a rule, or if the
    rule needs a person to answer.
    """
    operator = None
    with suppress(InvalidInput):  # the message of that error is about the command line
        operator = parse_policy(on_stop, ()) if isinstance(on_stop, str) else None
    if operator is None:
        raise BadArgument(
            f"on_stop must be `abort`, `retry:N` (N is at least 1) or `unwind`, not {on_stop!r}"
        )
    return operator


def _new_folder(path: Path, state: Checkpoint, overwrite: bool) -> RunFolder:
    """Create the folder for a run that begins in state `state`. Raises InvalidInput if the folder cannot be used."""
    try:
        return open_new(path, state, overwrite=overwrite)
    except HoldsRun:
        name = repr(str(path))
        raise CannotWrite(
            f"{path} holds a run: handeye.begin({name}, out={name}) continues it, overwrite=True replaces it; to keep "
            "it, choose another folder"
        ) from None


@dataclass(eq=False)
class _PauseOnRequest(Observer):
    """Pauses a run after the present step if the panic button is pressed. This observer is needed for steps that take
    no simulated time, because such steps have no servo period in which the button is polled.
    """

    session: DebugSession
    halt: Callable[[], bool]

    def event(self, event: AnyEvent) -> None:
        if self.session.going == "on" and self.halt():
            self.session.ask_pause()


def _built(start: Start, parts: Parts, keeping: RunEnding, halt: Callable[[], bool] | None) -> Run:
    """Build the run, ready for its first step. If the cell cannot be built, delete the folder that was created for
    the run. Raises Refused if `halt` returned True while the cell was being built.
    """
    folder, state = keeping.folder, start.state

    def looking(runner: Runner) -> Sequence[Observer]:
        check_limits(runner)
        again = start.folder is not None
        return [] if folder is None else [folder.watch(runner, state, again=again, meter=keeping.meter)]

    try:
        runner = Runner(state, observers=looking, parts=parts, halt=halt or (lambda: False))
    except BaseException as error:
        if folder is not None:
            folder.close()
            folder.discard()
        if isinstance(error, Halted):
            raise Refused(
                "the run was halted while its cell was being prepared, so the run did not begin"
            ) from None
        raise
    doubts = cautions(runner, judged=keeping.judged and keeping.referee is None)
    lost = () if folder is None else losses(folder, runner)
    for sentence in (*doubts, *lost):
        warnings.warn(sentence, stacklevel=3)
    stepper = Stepper(
        runner,
        kept=(lambda _: None) if folder is None else folder.kept.at_or_before,
        keep=(lambda _: None) if folder is None else folder.kept.save,
        pictures=None if folder is None else folder.path / PICTURES,
    )
    if halt is not None:
        stepper.session.input = _PauseOnRequest(stepper.session, halt)
    why = "ready" if state.position < 1 else f"resumed after {counted(state.position, 'step')}"
    return Run(stepper, keeping, why)
