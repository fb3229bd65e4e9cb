"""Driving: the stepper carries out what is said in the browser, and everybody who looks on is told."""

from collections.abc import Callable
from contextlib import AbstractContextManager

import msgspec

from handeye.debugger.formatting import MOST, as_json, as_text
from handeye.debugger.live import Ear, LiveJson
from handeye.debugger.reply import Reply
from handeye.debugger.stepper import Stepper
from handeye.runs.advance import Pause
from handeye.view.link import Link


def drive(stepper: Stepper, link: Link, aside: Callable[[], AbstractContextManager[None]]) -> Pause:
    """Carry out what is said until somebody leaves the run.

    Args:
        aside: entered while a line is waited for.

    Returns:
        Why the run pauses.
    """
    hands = stepper.hands
    hands.face = LiveJson(hands.runner, link.tell)
    hands.ear = Ear(link.come, lambda line: link.tell(told(stepper, stepper.meanwhile(line))))
    link.tell(told(stepper, stepper.standing()))
    for line in filter(str.strip, link.lines(aside)):
        link.tell(told(stepper, stepper.do(line)))
        if stepper.over:
            break
    return stepper.pause


def told(stepper: Stepper, reply: Reply) -> str:
    """A reply as the page understands it: its record, and the text that the stepper shows at a terminal.

    Events and the steps that were done are left out of the record: a long way has thousands.
    """
    record = msgspec.Raw(as_json(msgspec.structs.replace(reply, events=(), did=())).encode())
    return msgspec.json.encode(
        {
            "reply": record,
            "shown": as_text(reply, MOST),
            "called": stepper.hands.runner.call is not None,
            "pace": stepper.hands.pace.factor,
        }
    ).decode()
