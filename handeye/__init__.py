"""The Stanford hand-eye pump assembly of 1973: a script becomes a plan, a plan and a work cell become a pump.

>>> import handeye
>>> plan = handeye.plan("plans/water_pump.al")
>>> result = handeye.assemble(seed=3)
>>> trace = handeye.open("out/trace.mcap")
"""

from pathlib import Path
from typing import TYPE_CHECKING

from handeye.versions import HANDEYE

if TYPE_CHECKING:  # what a function needs is imported when it is called
    from handeye.planfile.plan import Plan
    from handeye.report.result import Result
    from handeye.trace.trace import Trace
    from handeye.variation import WorldSpec

__all__ = ["__version__", "assemble", "open", "plan"]
__version__ = HANDEYE


def plan(script: "str | Path") -> "Plan":
    """Compile and plan the script in a file; what is taught stands beside it (.toml).

    Raises:
        InvalidInput: it cannot be read, or has mistakes; the message tells each of them.
    """
    from handeye.diagnostics import has_errors, render
    from handeye.errors import InvalidInput
    from handeye.runs.scripts import plan_script

    made = plan_script(Path(script))
    if made.plan is None or has_errors(made.diagnostics):
        raise InvalidInput("\n\n".join(render(found, made.source) for found in made.diagnostics))
    return made.plan


def assemble(
    seed: int = 0,
    *,
    script: "str | Path | None" = None,
    world: "WorldSpec | None" = None,
    camera: str = "auto",
    out: "str | Path | None" = None,
) -> "Result":
    """Carry out a script in a work cell, with no operator there, and have the result judged.

    Args:
        seed: draws the world, where no `world` is given.
        script: by default that of the water pump.
        world: seed, level and overrides of the world.
        camera: how to make pictures: `auto`, `gl` or `ray`.
        out: a new folder that keeps plan, events, trace, checkpoints, pictures and result.

    Raises:
        InvalidInput: the script has mistakes, the camera cannot work so, the folder cannot be had, or seed or world
            are none.
    """
    from handeye.errors import InvalidInput
    from handeye.runs.scripts import default_script
    from handeye.trials.assembly import run_plan
    from handeye.variation import WorldSpec

    drawn = WorldSpec(seed=seed) if world is None else world
    if not isinstance(drawn, WorldSpec):
        raise InvalidInput(f"the world must be a WorldSpec, not {drawn!r}")
    if not isinstance(drawn.seed, int) or drawn.seed < 0:
        raise InvalidInput(f"the seed must be a whole number from 0 on, not {drawn.seed!r}")
    made = plan(default_script() if script is None else script)
    folder = None if out is None else Path(out)
    return run_plan(made, world=drawn, camera=camera, folder=folder).result


def open(path: "str | Path") -> "Trace":
    """Read the trace of a run: a trace.mcap, or the folder of a run that has ended.

    Raises:
        InvalidInput: it cannot be read, or is not a sound trace.
    """
    from handeye.runs.folder import TRACE
    from handeye.trace.reading import read_trace

    file = Path(path)
    return read_trace(file / TRACE if file.is_dir() else file)
