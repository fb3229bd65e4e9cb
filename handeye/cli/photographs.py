"""Options and progress of commands that photograph the cell."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import Group, Parameter

from handeye.cli.common import WholeNumber, notes

if TYPE_CHECKING:
    from handeye.cell.photograph import Photograph
    from handeye.cell.posed import Posed

_GROUP: Final = Group("Fine photographs", sort_key=2)


@Parameter(name="*", group=_GROUP)
@dataclass(frozen=True, slots=True, kw_only=True)
class FineOptions:
    """Whether a photograph is a fine one, and how that is made."""

    fine: Annotated[
        bool,
        Parameter(
            negative="",
            help="Average many exposures in a light of their own: soft shadows, depth of field, smooth edges.",
        ),
    ] = False
    film: Annotated[
        Literal["colour", "1973"] | None,
        Parameter(
            help="Colour, or black and white as in the paper of 1973, in hard light from the side. It implies `--fine`."
        ),
    ] = None
    exposures: Annotated[
        WholeNumber | None, Parameter(help="How many are averaged, by default 24. It implies `--fine`.")
    ] = None

    def take(self, posed: "Posed", camera: str, width: int, height: int) -> "Photograph":
        """The photograph, and its progress on the terminal; raises InvalidInput if camera or size cannot be."""
        from handeye.cell.exposures import exposing, photographed

        how = exposing(fine=self.fine, film=self.film, exposures=self.exposures)
        with notes.status("photographing") as status:
            return photographed(
                *posed, camera=camera, width=width, height=height, how=how,
                told=lambda number, of: status.update(f"exposure {number} of {of}"),
            )  # fmt: skip


PLAIN: Final = FineOptions()
