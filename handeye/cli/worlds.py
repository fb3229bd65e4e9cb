"""Commands that show a world: its quantities, a picture of it."""

from handeye.cli.common import Height, Json, PictureFile, SceneCamera, Width, put, say, screen
from handeye.cli.photographs import PLAIN, FineOptions
from handeye.cli.world_options import ANY_WORLD, Faults, WorldOptions, broken
from handeye.core.files import check_place, write_over


def world(*, world: WorldOptions = ANY_WORLD, json: Json = False) -> int:
    """List every quantity in which worlds differ: what it is in this world, unit, spread and source."""
    from handeye.results.world_page import world_json, world_page

    spec = world.spec
    table = world.work.variation(spec.seed)
    drawn = table.draw(spec)
    if json:
        put(world_json(table, drawn))
    else:
        screen.print(world_page(table, drawn, screen.width))
    return 0


def render(
    *,
    output: PictureFile,
    camera: SceneCamera = None,
    width: Width = 1280,
    height: Height = 960,
    how: FineOptions = PLAIN,
    world: WorldOptions = ANY_WORLD,
    fault: Faults = None,
) -> int:
    """Render a picture of the work cell."""
    from handeye.cell.photograph import PNG, check_size, png
    from handeye.cell.posed import as_it_stands
    from handeye.cell.posed import posed as drawn
    from handeye.tasks.interface import Task

    check_place(output, PNG)
    check_size(width, height)
    work = world.work
    spec = broken(world.spec, fault, work)
    shown = work.shown(spec)
    posed = as_it_stands(shown, work.cell(spec, "ray").truth) if isinstance(work, Task) else drawn(shown, {})
    write_over(output, png(how.take(posed, camera or work.camera, width, height)), PNG)
    say(f"{output}: {width} x {height}, camera {camera or work.camera}")
    return 0
