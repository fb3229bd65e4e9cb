"""Export runs and worlds to other programs."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from handeye.core.arguments import given_file
from handeye.core.errors import BadArgument, CannotWrite, Taken
from handeye.runs.exported_state import ExportedState

if TYPE_CHECKING:
    from handeye.results.export import Export


def exported(given: object, shown: Callable[[], ExportedState], part: object, *, overwrite: bool) -> "Export":
    """Write an export. `shown` is a function that returns the state to export. The other arguments are those of
    `Run.export`.
    """
    from handeye.results.export import export  # with libraries that take a while to load

    path = given_file(
        given, "the destination of an export must be a folder, or a file whose name ends in .glb"
    )
    if part is not None and not isinstance(part, str):
        raise BadArgument(f"give a part by its name, not by {part!r}")
    try:
        return export(path, shown, part=part, overwrite=overwrite)
    except Taken:
        raise CannotWrite(f"{path} already holds an export of handeye; overwrite=True replaces it") from None
