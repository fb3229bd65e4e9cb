"""Commands that show a world: its quantities, or a picture of its cell; and the options for photographs."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import Group, Parameter

from handeye.cli.common import (
    Json,
    Overwrite,
    PictureFile,
    SceneCamera,
    Size,
    WholeNumber,
    notes,
    put,
    say,
    screen,
    width_and_height,
)
from handeye.cli.world_options import ANY_WORLD, Faults, WorldOptions, broken
from handeye.core.files import check_place, write_over

if TYPE_CHECKING:
    from handeye.cell.photograph import Photograph
    from handeye.cell.posed import Posed

_GROUP: Final = Group("Fine photographs", sort_key=2)


@Parameter(name="*", group=_GROUP)
@dataclass(frozen=True, slots=True, kw_only=True)
class FineOptions:
    """Options for a fine photograph."""

    fine: Annotated[
        bool,
        Parameter(
            negative="",
            help="Average many exposures. The picture then has soft shadows, depth of field and smooth edges.",
        ),
    ] = False
    film: Annotated[
        Literal["colour", "1973"] | None,
        Parameter(
            help="Colour, or black and white in hard side light, like the photographs of the 1973 paper. Implies "
            "`--fine`."
        ),
    ] = None
    exposures: Annotated[
        WholeNumber | None, Parameter(help="Number of exposures. Default: 48. Implies `--fine`.")
    ] = None

    def take(self, posed: "Posed", camera: str, width: int, height: int) -> "Photograph":
        """Take the photograph, and show the progress on the terminal; raises InvalidInput if the camera does not
        exist, or the size is impossible.
        """
        from handeye.cell.exposures import exposing, photographed

        how = exposing(fine=self.fine, film=self.film, exposures=self.exposures)
        with notes.status("photographing") as status:
            return photographed(
                *posed, camera=camera, width=width, height=height, how=how,
                told=lambda number, of: status.update(f"exposure {number} of {of}"),
            )  # fmt: skip


PLAIN: Final = FineOptions()


def world(*, world: WorldOptions = ANY_WORLD, json: Json = False) -> int:
    """List every quantity that varies between worlds: its value in this world, unit, spread and source."""
    from handeye.results.world_page import world_json, world_page

    spec = world.spec
    table = world.work.variation()
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
    overwrite: Overwrite = False,
    size: Size = "1280x960",
    how: FineOptions = PLAIN,
    world: WorldOptions = ANY_WORLD,
    fault: Faults = None,
) -> int:
    """Render a picture of the work cell."""
    from handeye.cell.photograph import PNG, check_size, png
    from handeye.cell.posed import as_it_stands
    from handeye.cell.posed import posed as drawn
    from handeye.tasks.interface import Task

    width, height = width_and_height(size)
    check_place(output, PNG, overwrite=overwrite)
    check_size(width, height)
    work = world.work
    spec = broken(world.spec, fault, work)
    shown = work.shown(spec)
    posed = as_it_stands(shown, work.cell(spec, "ray").truth) if isinstance(work, Task) else drawn(shown, {})
    write_over(output, png(how.take(posed, camera or work.camera, width, height)), PNG)
    say(f"{output}: {width} x {height}, camera {camera or work.camera}")
    return 0
