"""Builds the section with the conditions of the run: world, plan, versions, and the command that repeats the
run."""

from collections.abc import Iterator

from handeye.core.errors import InvalidInput
from handeye.core.markup import (
    Content,
    Markup,
    cell,
    element,
    figure_cell,
    figure_heads,
    heads,
    joined,
    note,
    section,
    table,
)
from handeye.core.variation import World
from handeye.core.versions import HANDEYE
from handeye.program.events import ExperimentMade, LineTyped, OperatorAnswered, PeriodsCommanded
from handeye.program.senses import assumption
from handeye.report.facts.again import command
from handeye.report.recorded import RecordedRun, told_faults
from handeye.results.world_page import QuantityReport, report
from handeye.tasks import known_any
from handeye.trace.sentences import renderer_name


def record_section(run: RecordedRun) -> Markup:
    """Return the section with the conditions of the run."""
    return section(
        "record",
        "World, versions, and how to repeat the run",
        *_again(run),
        facts(run),
        *world_quantities(run),
    )


def _again(run: RecordedRun) -> Iterator[Markup]:
    typed = command(run)
    if typed is None:
        yield note(
            "This run used Python code of the calling program. To repeat the run, make the same call from Python."
        )
        return
    yield element("pre", element("code", typed), class_="command")
    given = OperatorAnswered | ExperimentMade | LineTyped | PeriodsCommanded
    if any(isinstance(event, given) for event in run.trace.events):
        yield note(
            "A user gave commands during this run; `handeye trace verify` repeats these commands as well."
        )
    if "plan.json" in typed:
        yield note("plan.json is in the folder of the run.")


def facts(run: RecordedRun) -> Markup:
    """Return the conditions of the run, one per line."""
    head = run.trace.head
    rows: list[tuple[str, Content]] = [*_overrides(run)]
    rows += [
        ("seed", str(head.world.seed)),
        ("errors", f"{head.world.level}, drawing {head.world.drawing}"),
        ("plan", element("code", head.plan)),
        *(
            ()
            if not head.arm
            else [("arm", element("span", f"{head.arm} ", element("code", head.arm_digest)))]
        ),
        *(() if head.camera.method == "none" else [("pictures by", renderer_name(head.camera))]),
        *((f"without {sense}", assumption(sense)) for sense in head.lacking),
        *((f"{part} by", name) for part, name in head.own_parts.items()),
        ("versions", ", ".join(f"{name} {version}" for name, version in head.versions.items())),
        ("trace", f"format {run.trace.version}{', thinned' if run.trace.thinned else ''}"),
        ("page", f"made by handeye {HANDEYE}"),
        *(("left out", remark) for remark in run.remarks),
    ]
    return element("dl", *(element("div", element("dt", name), element("dd", said)) for name, said in rows))


def _overrides(run: RecordedRun) -> Iterator[tuple[str, Content]]:
    """Yield the faults and overrides of the run's world."""
    world = run.trace.head.world
    for name, meaning in told_faults(run):
        yield "fault", joined([element("code", name), f" {meaning}"])
    for name in world.overrides.without:
        yield "without", name
    for name, value in world.overrides.set.items():
        yield "set", f"{name} = {value:g} (SI)"
    for name, factor in world.overrides.scale.items():
        yield "scaled", f"{name} by {factor:g}"


def world_quantities(run: RecordedRun) -> Iterator[Markup]:
    """Yield the quantities of the run's world, or a note on why they cannot be listed."""
    try:
        quantities = _quantities(run)
    except InvalidInput as fault:
        yield note(f"The quantities of this world cannot be listed: {fault}.")
        return
    if quantities:
        head = [
            *heads("quantity"),
            *figure_heads("value"),
            *heads("unit"),
            *figure_heads("nominal"),
            *heads("", "what it is"),
        ]
        listed = table(head, map(_quantity, quantities), label="quantities of the world")
        summary = element(
            "summary", f"All {len(quantities)} quantities of this world (unknown to the program)"
        )
        yield element("details", summary, listed)


def _quantities(run: RecordedRun) -> tuple[QuantityReport, ...]:
    """Return the quantities of the run's world. Quantities that the user set come first. Raises InvalidInput if this
    version of handeye generates a world that differs from the world of the run.
    """
    task, world = known_any(run.trace.head.task), run.trace.head.world
    if task is None:
        return ()
    variation = task.variation()
    drawn: World = variation.draw(world)
    return tuple(sorted(report(variation, drawn).quantities, key=lambda quantity: quantity.override is None))


def _quantity(quantity: QuantityReport) -> list[Markup]:
    return [
        element("th", quantity.name, scope="row"),
        figure_cell(f"{quantity.value:.4g}"),
        cell(quantity.unit),
        figure_cell(f"{quantity.nominal:g}"),
        cell("" if quantity.override is None else element("b", quantity.override)),
        cell(quantity.source),
    ]
