"""Teaches positions in the browser: a page with buttons that send lines to move the arm, and the loop that
executes these lines.
"""

from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager
from typing import Final

import msgspec

from handeye.arm.model import ArmModel
from handeye.core.markup import Markup, element
from handeye.debugger.live import LineInput, Pace
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.teaching.answers import Answer, text
from handeye.teaching.teach_commands import AXES, TeachSession
from handeye.teaching.teacher import Teacher
from handeye.view.link import Link
from handeye.view.moment import Newest
from handeye.view.page import Face, buttons, live_page, source_region

_FRAMES: Final = (("table", "the table"), ("hand", "the hand"))
_STEPS_IN, _USUAL_STEP_IN = (".05", ".1", ".5", "1", "5"), ".5"
_STEPS_DEG, _USUAL_STEP_DEG = ("1", "5", "15", "45"), "5"
_SIGNS: Final = (("-", "−"), ("+", "+"))
_GAPS: Final = (("open 1", "Open 1 in"), ("open 2", "Open 2 in"), ("open 3", "Open 3 in"), ("close", "Close"))
_WORDS: Final = (("undo", "Undo"), ("where", "Where"), ("float", "Float"), ("save", "Save"))


def teaching_page(teacher: Teacher, newest: Newest) -> bytes:
    """Return the page for teaching in a cell. Raises InvalidInput if the task has no scene."""
    workplace = teacher.workplace
    hand = element("div", *buttons(_GAPS), *buttons(_WORDS), class_="controls")
    face = Face(
        title=teacher.file.name,
        controls=[_jogging(workplace.run.arm), hand, _naming(workplace.taught.parts)],
        aside=source_region("taught file", element("h2", teacher.file.name), element("div", id="taught")),
        listener="teacher",
        script="teaching.js",
    )
    return live_page(workplace.runner, newest, face)


def taught_markup(teacher: Teacher) -> Markup:
    """Return the taught file with all changes. Lines that are not saved yet are marked."""
    saved = set(teacher.saved.splitlines())
    lines = teacher.text.splitlines()
    if not lines:
        return element("p", "Nothing is taught yet.", class_="note")
    shown = (element("li", element("code", line), class_=None if line in saved else "new") for line in lines)
    return element("ol", *shown)


def _jogging(arm: ArmModel) -> Markup:
    """Return controls that move the hand along or about an axis, or move one joint."""
    steps = element(
        "div",
        _choice("frame", "along", _FRAMES, _FRAMES[0][0]),
        _choice("way", "step", [(step, f"{step} in") for step in _STEPS_IN], _USUAL_STEP_IN),
        _choice("angle", "turn", [(step, f"{step}°") for step in _STEPS_DEG], _USUAL_STEP_DEG),
        element("button", "Panic", id="panic", type="button"),
        class_="controls",
    )
    hand = [
        *(_pair(f"FRAME {axis}", axis, "way") for axis in AXES),
        *(_pair(f"FRAME turn {axis}", f"turn {axis}", "angle") for axis in AXES),
    ]
    joints = (
        _pair(f"j{number}", joint.name, "way" if joint.kind == "prismatic" else "angle")
        for number, joint in enumerate(arm.joints, 1)
    )
    grids = _grid("move the hand step by step", hand), _grid("move the joints step by step", joints)
    return element("div", steps, *grids, id="jog")


def _choice(name: str, label: str, options: Iterable[tuple[str, str]], usual: str) -> Markup:
    shown = (element("option", said, value=value, selected=value == usual) for value, said in options)
    return element("label", f"{label} ", element("select", *shown, id=name))


def _grid(label: str, pairs: Iterable[Markup]) -> Markup:
    return element("div", *pairs, class_="jogs", role="group", aria_label=label)


def _pair(line: str, shown: str, step: str) -> Markup:
    """Return two buttons for opposite movements. The page's script inserts frame and step into the line that a
    button sends."""
    less, more = (
        element("button", sign, type="button", value=f"{line} {typed}", data_step=step, aria_label=f"{shown} {sign}")
        for typed, sign in _SIGNS
    )  # fmt: skip
    return element("span", less, element("span", shown), more)


def _naming(parts: Iterable[str]) -> Markup:
    """Return the form that stores the hand's position under a name."""
    name = element(
        "input", id="name", type="text", required=True, maxlength="60", pattern="[A-Za-z_][A-Za-z0-9_]*",
        placeholder="NAME", aria_label="name of the position", autocomplete="off",
    )  # fmt: skip
    of: Sequence[tuple[str, str]] = [("", "on the table"), *((part, f"on {part}") for part in parts)]
    again = element("label", element("input", id="again", type="checkbox"), " replace")
    options = (element("option", shown, value=part) for part, shown in of)
    part = element("select", *options, id="part", aria_label="on")
    record = element("button", "Record", type="submit")
    go = element("button", "Go to", id="go", type="button")
    return element("form", name, part, again, record, go, id="record", class_="controls")


class Watch:
    """The observers of a workplace. Each plan has a new runner, but all runners have the same observers."""

    def __init__(self, link: Link, pace: Pace) -> None:
        self.newest: Newest | None = None  # None: no cell was built yet
        self._pace = pace
        self._ear = LineInput(link.come, lambda line: link.tell(_refused(line)))

    def __call__(self, runner: Runner) -> list[Observer]:
        """Return the observers for the first runner or for a later runner."""
        if self.newest is None:
            self.newest = Newest(runner)
        else:
            self.newest.follow(runner)
        return [self.newest, self._pace, self._ear]


def teach(session: TeachSession, link: Link, aside: Callable[[], AbstractContextManager[None]]) -> None:
    """Execute lines until the user leaves. The context `aside` is entered while the function waits for a line."""
    link.tell(_told(session, None))
    for line in filter(str.strip, link.lines(aside)):
        link.tell(msgspec.json.encode({"begun": line.strip()}).decode())
        link.tell(_told(session, session.hear(line)))
        if session.over:
            break


def _told(session: TeachSession, answer: Answer | None) -> str:
    """Encode an answer for the page, with the taught file as it is now. `answer` is None before the first line."""
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
    sentence = f"`{line.strip()}` was refused: while the arm moves, only the panic button works"
    return msgspec.json.encode({"refused": sentence}).decode()
