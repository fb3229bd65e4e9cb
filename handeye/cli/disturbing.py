"""The command that disturbs what the arm has built, and has it undone."""

from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import Camera, Json, WholeNumber, note, positive, put_json, say
from handeye.cli.programs import plan_or_own
from handeye.cli.tally import Tally
from handeye.cli.world_options import ANY_WORLD, WorldOptions
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import NoSuchName
from handeye.core.plain_text import counted
from handeye.tasks import planned

if TYPE_CHECKING:
    from collections.abc import Sequence

    from handeye.tasks.interface import Disturbance
    from handeye.trials.disturbing import Disturbed


def disturbed_trials(
    *,
    only: Annotated[
        list[str] | None, Parameter(help="This disturbance alone. May be repeated.", consume_multiple=False)
    ] = None,
    listed: Annotated[
        bool, Parameter(name="--list", help="List the disturbances; nothing is carried out.")
    ] = False,
    world: WorldOptions = ANY_WORLD,
    workers: Annotated[WholeNumber, Parameter(help="Processes at a time.")] = 2,
    camera: Camera = "auto",
    json: Json = False,
) -> int:
    """Build a pump, change something behind the arm's back, and have the arm undo it: is it stopped before harm?

    In time is: a guard stops the arm, no part has moved by more than 2 mm in a step that the hand did not hold, and
    the hand has felt no more than 60 N. Each builds the pump first, which takes a minute of a processor.

    Exit code 0: every one was stopped in time; 3: one was not; 2: bad input; 130: interrupted.
    """
    from handeye.trials.disturbing import Disturbed, disturbances_of, try_disturbances

    chosen = _chosen(planned(world.work).disturbances(), only)
    positive(workers, "process")
    if listed:
        for each in chosen:
            say(f"{each.name:16} {each.meaning}")
        return 0
    tried: list[Disturbed] = []
    names, plan = [each.name for each in chosen], plan_or_own(None, world.task)
    ended = try_disturbances(plan, world.spec, names, camera=camera, workers=workers)
    try:
        for found in Tally(len(chosen), "disturbances").counting(ended, None if json else _tell):
            tried.append(found)
    finally:
        figures = disturbances_of(tried, planned(world.work))
        if json:
            put_json(figures)
        elif tried:
            note(f"{figures.harmless} of {counted(figures.n, 'disturbance')} stopped in time")
    return 0 if figures.harmless == figures.n else 3


def _chosen(known: "Sequence[Disturbance]", only: "list[str] | None") -> "list[Disturbance]":
    """The disturbances of some names; all, if there are none."""
    names = [each.name for each in known]
    for name in only or ():
        if name not in names:
            near = suggestion(name, names) or "--list lists them"
            raise NoSuchName(f"there is no disturbance {quoted(name)}; {near}")
    return [each for each in known if not only or each.name in only]


def _tell(found: "Disturbed") -> None:
    if not found.built:
        say(f"{found.name:16} not tried: the pump was not built")
        return
    how = "stopped in time" if found.harmless else "stopped" if found.stopped else "NOT STOPPED"
    where = f", line {found.line}, {' '.join(found.at.split())}" if found.stopped else ""
    met = f"felt {found.felt:.1f} N, moved {found.moved:.2f} mm"
    say(f"{found.name:16} {how}{where}: {found.message}; {met}")
