"""Commands that try things in many worlds and count."""

from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import Camera, Json, WholeNumber, note, positive, put_json, say
from handeye.cli.world_options import (
    ANY_WORLD,
    WorldOptions,
)
from handeye.core.diagnostics import quoted
from handeye.core.errors import NoSuchName
from handeye.tasks import planned
from handeye.tasks.trial import Known

Eye = Annotated[
    Known,
    Parameter(
        help="What the program knows of its camera: what its lamp shows it, what simulated sightings would "
        "(cheap, and too good), its drawing, or the truth."
    ),
]
Worlds = Annotated[
    WholeNumber | None, Parameter(help="Worlds to try in, from --seed on; by default as many as COUNT.")
]
Jobs = Annotated[WholeNumber, Parameter(help="Processes at a time.")]


def base_vision_trials(
    count: WholeNumber = 100,
    /,
    *,
    world: WorldOptions = ANY_WORLD,
    worlds: Worlds = None,
    eye: Eye = "lamp",
    camera: Camera = "auto",
    jobs: Jobs = 2,
    json: Json = False,
) -> int:
    """Find the base on the belt at many poses: how often, how exactly, and how often wrongly.

    In every world the arm carries its lamp through the camera's view first, as in a run. That is nearly all that a
    trial costs; `--worlds` has several poses share a world and its calibration.

    Exit code 0: no wrong pose was accepted; 3: one was.

    Parameters
    ----------
    count
        Poses to try: the one that a world has, then fresh ones.
    """
    return _vision_trial("base", count, world, worlds, eye, camera, jobs, json)


def gasket_vision_trials(
    count: WholeNumber = 50,
    /,
    *,
    world: WorldOptions = ANY_WORLD,
    worlds: Worlds = None,
    eye: Eye = "lamp",
    camera: Camera = "auto",
    jobs: Jobs = 2,
    json: Json = False,
) -> int:
    """Check gaskets of every kind by eye: on properly, shifted by .3 in, absent, and one on another.

    Two gaskets on each other look like one, and are counted for that: the hand finds them, by their height.

    Exit code 0: no shifted or absent gasket was accepted; 3: one was.

    Parameters
    ----------
    count
        Gaskets of each kind.
    """
    return _vision_trial("gasket", count, world, worlds, eye, camera, jobs, json)


def _vision_trial(
    name: str,
    count: int,
    world: WorldOptions,
    worlds: int | None,
    eye: Known,
    camera: str,
    jobs: int,
    json: bool,
) -> int:
    from msgspec.structs import replace

    from handeye.trials.eye import try_in

    worlds = count if worlds is None else worlds
    for each, what in ((count, "world"), (worlds, "world"), (jobs, "process")):
        positive(each, what)
    number, first, work = min(count, worlds), world.spec, planned(world.work)
    if name not in work.trials:
        raise NoSuchName(f"the task {quoted(work.name)} has no trial {quoted(name)}")
    specs = [replace(first, seed=seed) for seed in range(first.seed, first.seed + number)]
    trial, tell, tried = work.trials[name], note if json else say, []
    for its in try_in(work.name, name, specs, count, camera=camera, known=eye, jobs=jobs):
        tried.append(its)
        for attempt in its.attempts:
            tell(f"seed {attempt.seed:4}  {trial.sentence(attempt)}")
    attempts = sorted((a for its in tried for a in its.attempts), key=lambda a: (a.seed, a.number))
    counted, cpu_s = trial.count(attempts), sum(its.cpu_s for its in tried) / count
    if json:
        put_json({"trial": name, "worlds": number, "eye": eye, **counted.figures, "cpu_s_each": cpu_s,
                  "attempts": attempts})  # fmt: skip
    else:
        for line in (*counted.lines, f"{cpu_s:.1f} s of processor time each"):
            say(line)
    return 3 if counted.wrong else 0
