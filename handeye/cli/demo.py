"""The command that shows a recorded run. It is the first command to try."""

import os
import sys
from pathlib import Path
from typing import Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import CALLED, Overwrite, note, say
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import NoSuchName

PAGE: Final = "demo.html"


def demo(
    name: Annotated[
        str | None,
        Parameter(help="Name of a recorded run: `chess`, for example. Default: the assembly of the pump."),
    ] = None,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--out", "-o"], help="File for the page (.html).")] = Path(PAGE),
    overwrite: Overwrite = False,
    no_browser: Annotated[bool, Parameter(help="Write the page without opening it.")] = False,
) -> int:
    """Show a recorded assembly of the pump: a 3D replay beside its program, with the camera pictures and the forces.

    Writes the report of a run included with handeye, as `report --demo` does, and prints the path of the page. If
    standard output is a terminal, the page opens in a browser. Nothing is simulated, and the page needs no network.

    `handeye demo chess` shows another recorded run: an arm of 1981 sorts chess pieces with a single light beam as its
    sensor. Its page lists each statement of the program and each command on the bus. `handeye demo follow` shows the
    curve follower of 1975: an arm feels the outline of a plate. Its page draws two outlines, the one that the arm has
    felt over the true one, and shows all tables of the machine in each cycle of 10 ms.

    Exit code 0: the page is written; 2: bad input.
    """
    from handeye.cli.reports import page_of
    from handeye.core import resources
    from handeye.core.files import check_place, write_over
    from handeye.report.page.document import REPORT

    if name is not None and name not in resources.recorded():
        hint = suggestion(name, resources.recorded())
        raise NoSuchName(f"there is no recorded run {quoted(name)}" + (f"; {hint}" if hint else ""))
    check_place(output, REPORT)
    note("Writing the page of a recorded run; this takes a few seconds.")
    page = page_of(resources.demo() / (name or ""))
    if not (output.exists() and output.read_bytes() == page):
        check_place(output, REPORT, overwrite=overwrite)
        write_over(output, page, REPORT)
    say(str(output), whole=True)
    shown = not no_browser and sys.stdout.isatty() and opened(output)
    note(f"{'Opened' if shown else 'Open'} {output} in a browser.")
    note(
        f"Step through a short run in the browser: {CALLED} view --demo. Assemble a pump: {CALLED} assemble."
    )
    return 0


def opened(page: Path) -> bool:
    """Open a page in a graphical browser. Returns False if there is no such browser. The environment variable BROWSER,
    if set, selects the browser.
    """
    import webbrowser

    named = os.environ.get("BROWSER")
    displays = ("DISPLAY", "WAYLAND_DISPLAY")
    if sys.platform.startswith("linux") and not (named or any(map(os.environ.get, displays))):
        return False
    try:
        found = webbrowser.get()
        if type(found) is webbrowser.GenericBrowser and not named:  # a text browser takes over the terminal
            return False
        return found.open(page.resolve().as_uri())
    except (webbrowser.Error, OSError):
        return False
