"""The page in which a run is stepped: buttons that say lines to the stepper, and the script beside the cell."""

from typing import Any, Final

from handeye.core.markup import Markup
from handeye.program.program import Program
from handeye.report.page.elements import element
from handeye.report.page.source import listing
from handeye.runs.runner import Runner
from handeye.view.moment import Newest
from handeye.view.page import Face, buttons, live_page

_BUTTONS: Final = (
    ("continue", "Run"),
    ("pause", "Pause"),
    ("step", "Step"),
    ("stage", "Next stage"),
    ("back", "Back"),
    ("back stage", "Back a stage"),
)
_ANSWERS: Final = (("proceed", "Proceed"), ("retry", "Retry"), ("skip", "Skip"), ("abort", "Abort"))
_PACES: Final = (("1x", "1 ×"), ("4x", "4 ×"), ("free", "as fast as it goes"))


def stepping_page(runner: Runner, newest: Newest) -> bytes:
    """The page of a run in a cell.

    Raises:
        InvalidInput: the task shows no scene.
    """
    program: Any = runner.listing
    face = Face(
        title=program.name,
        controls=[_controls()],
        aside=_script(program),
        listener="stepper",
        script="stepping.js",
        facts={"files": ["", *program.required]},
    )
    return live_page(runner, newest, face)


def _controls() -> Markup:
    paces = (element("option", shown, value=said, selected=said == "free") for said, shown in _PACES)
    pace = element("select", *paces, id="pace", aria_label="pace")
    panic = element("button", "Panic", id="panic", type="button")
    called = element(
        "div",
        *buttons(_ANSWERS),
        id="answers",
        role="group",
        aria_label="answers for the operator",
        hidden=True,
    )
    return element("div", *buttons(_BUTTONS), pace, panic, called, class_="controls")


def _script(program: Program) -> Markup:
    return element(
        "div",
        listing(program),
        id="script",
        class_="source",
        tabindex="0",
        role="region",
        aria_label="script",
    )
