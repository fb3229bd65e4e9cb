"""Commands that show a world: its quantities, a picture of it."""

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from handeye.cli.common import Json, WholeNumber, screen
from handeye.cli.world_options import ANY_WORLD, WorldOptions
from handeye.files import check_place, write_over
from handeye.tasks import task


def register(app: App) -> None:
    """Add the commands to the command line."""
    app.command(world)
    app.command(render)


def world(*, world: WorldOptions = ANY_WORLD, json: Json = False) -> int:
    """List every quantity in which worlds differ: what it is in this world, unit, spread and source."""
    from handeye.report.world_page import world_json, world_page

    spec = world.spec
    table = task().variation(spec.seed)
    drawn = table.draw(spec)
    if json:
        sys.stdout.buffer.write(world_json(table, drawn))
        sys.stdout.flush()
    else:
        screen.print(world_page(table, drawn, screen.width))
    return 0


def render(
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="The picture, PNG.")],
    camera: Annotated[str, Parameter(help="One of the scene's cameras.")] = "studio",
    width: WholeNumber = 1280,
    height: WholeNumber = 960,
    world: WorldOptions = ANY_WORLD,
) -> int:
    """Render a picture of the work cell."""
    from handeye.cell.photograph import PNG, photograph_png

    check_place(output, PNG)
    cell = task().cell(world.spec, "ray")
    write_over(output, photograph_png(cell.truth.model, cell.truth.data, camera, width, height), PNG)
    screen.print(f"{output}: {width} x {height}, camera {camera}", markup=False)
    return 0
