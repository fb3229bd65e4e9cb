"""Teaching in the browser: what is said there is done with the arm, and everybody who looks on is told."""

from collections.abc import Callable
from contextlib import AbstractContextManager

import msgspec

from handeye.debugger.live import Ear
from handeye.debugger.pace import Pace
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.teaching.answers import Answer, text
from handeye.teaching.teach_commands import TeachSession
from handeye.view.link import Link
from handeye.view.moment import Newest
from handeye.view.teaching_page import taught_markup


class Watch:
    """Those who look on while a workplace goes from plan to plan, each of which has a runner of its own."""

    def __init__(self, link: Link, pace: Pace) -> None:
        self.newest: Newest | None = None
        """None: no cell was built yet."""
        self._pace = pace
        self._ear = Ear(link.come, lambda line: link.tell(_refused(line)))

    def __call__(self, runner: Runner) -> list[Observer]:
        """Look on at a runner, the first or that which takes the place of the last."""
        if self.newest is None:
            self.newest = Newest(runner)
        else:
            self.newest.follow(runner)
        return [self.newest, self._pace, self._ear]


def teach(session: TeachSession, link: Link, aside: Callable[[], AbstractContextManager[None]]) -> None:
    """Do what is said until somebody leaves.

    Args:
        aside: entered while a line is waited for.
    """
    link.tell(_told(session, None))
    for line in filter(str.strip, link.lines(aside)):
        link.tell(msgspec.json.encode({"begun": line.strip()}).decode())
        link.tell(_told(session, session.hear(line)))
        if session.over:
            break


def _told(session: TeachSession, answer: Answer | None) -> str:
    """An answer as the page understands it, with what the taught file then is; None: nothing was said yet."""
    teacher = session.teacher
    return msgspec.json.encode(
        {
            "answer": "`help` lists the commands" if answer is None else text(answer),
            "afloat": teacher.afloat,
            "unsaved": teacher.unsaved,
            "taught": str(taught_markup(teacher)),
        }
    ).decode()


def _refused(line: str) -> str:
    sentence = f"`{line.strip()}` was not carried out: while the arm moves, only the panic button works"
    return msgspec.json.encode({"refused": sentence}).decode()
