"""Steps a run in the browser: a page with buttons that send lines to the stepper, and the loop that executes
these lines.
"""

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any, Final

import msgspec

from handeye.core.markup import Markup, element
from handeye.debugger.formatting import MAX_STEPS_SHOWN, as_json, as_text
from handeye.debugger.live import LineInput, LiveJson
from handeye.debugger.reply import Reply
from handeye.debugger.stepper import Stepper
from handeye.report.page.source import listing, numbered_listing
from handeye.runs.advance import Pause
from handeye.runs.runner import Runner
from handeye.view.link import Link
from handeye.view.moment import Newest
from handeye.view.page import Face, buttons, live_page, source_region

_GO: Final = (("continue", "Run"), ("pause", "Pause"), ("step", "Step"), ("stage", "Next stage"))
_BUTTONS: Final = (*_GO, ("back", "Back"), ("back stage", "Back a stage"))
_ANSWERS: Final = (("proceed", "Proceed"), ("retry", "Retry"), ("skip", "Skip"), ("abort", "Abort"))
_PACES: Final = (("1x", "1 ×"), ("4x", "4 ×"), ("free", "as fast as possible"))


def stepping_page(runner: Runner, newest: Newest) -> bytes:
    """Return the page for stepping a run."""
    program: Any = runner.listing
    face = Face(
        title=program.name,
        controls=[_controls()],
        aside=source_region(
            "script",
            numbered_listing(program.numbered) if program.numbered else listing(program),
            id="script",
        ),
        listener="stepper",
        script="stepping.js",
        facts={"files": ["", *program.required]},
    )
    return live_page(runner, newest, face)


def _controls() -> Markup:
    paces = (element("option", shown, value=said, selected=said == "free") for said, shown in _PACES)
    pace = element("select", *paces, id="pace", aria_label="pace")
    panic = element("button", "Panic", id="panic", type="button")
    label = "answers for the operator"
    called = element("div", *buttons(_ANSWERS), id="answers", role="group", aria_label=label, hidden=True)
    return element("div", *buttons(_BUTTONS), pace, panic, called, class_="controls")


def drive(stepper: Stepper, link: Link, aside: Callable[[], AbstractContextManager[None]]) -> Pause:
    """Execute lines until the user leaves the run. Returns the last pause of the run, with its reason. The context
    `aside` is entered while the function waits for a line.
    """
    session = stepper.session
    session.output = LiveJson(session.runner, link.tell)
    session.input = LineInput(link.come, lambda line: link.tell(told(stepper, stepper.meanwhile(line))))
    link.tell(told(stepper, stepper.standing()))
    for line in filter(str.strip, link.lines(aside)):
        link.tell(told(stepper, stepper.do(line)))
        if stepper.over:
            break
    return stepper.pause


def told(stepper: Stepper, reply: Reply) -> str:
    """Encode a reply for the page: its record, and the text that the stepper would print at a terminal.

    Events and executed steps are left out of the record, because there may be thousands of them.
    """
    record = msgspec.Raw(as_json(msgspec.structs.replace(reply, events=(), did=())).encode())
    return msgspec.json.encode(
        {
            "reply": record,
            "shown": as_text(reply, MAX_STEPS_SHOWN),
            "called": stepper.session.runner.call is not None,
            "pace": stepper.session.pace.factor,
        }
    ).decode()
