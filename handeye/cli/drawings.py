"""Writes the flow of control of a program, as text or as a drawing, to a file or to standard output."""

from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

from handeye.cli.common import put
from handeye.core.files import Kind, check_place, write_over

if TYPE_CHECKING:
    from handeye.inspection.flow import Flow

Drawing = Literal["svg", "dot"]
DRAWINGS: Final[dict[Drawing, Kind]] = {
    "svg": Kind("SVG drawing", rb"<svg ", ending=".svg"),
    "dot": Kind("graph", rb"digraph "),
}


def write_drawing(flow: "Flow", form: Drawing, output: Path | None, *, overwrite: bool) -> None:
    """Draw a flow."""
    from handeye.inspection.drawing import flow_svg
    from handeye.inspection.flow import flow_dot

    write_text(
        flow_svg(flow) if form == "svg" else flow_dot(flow), output, DRAWINGS[form], overwrite=overwrite
    )


def write_text(text: str, output: Path | None, kind: Kind, *, overwrite: bool) -> None:
    """Write a text to a file of the given kind, or to standard output."""
    if output is None:
        put(text.encode())
    else:
        check_place(output, kind, overwrite=overwrite)
        write_over(output, text.encode(), kind)
