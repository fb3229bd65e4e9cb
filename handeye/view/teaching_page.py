"""The page in which positions are taught: buttons that move the arm, and the taught file beside the cell."""

from collections.abc import Iterable, Sequence
from typing import Final

from handeye.arm.model import ArmModel
from handeye.core.markup import Markup
from handeye.report.page.elements import element, text
from handeye.teaching.teach_commands import AXES
from handeye.teaching.teacher import Teacher
from handeye.view.moment import Newest
from handeye.view.page import Face, buttons, live_page

_FRAMES: Final = (("table", "the table"), ("hand", "the hand"))
_WAYS: Final = (".05", ".1", ".5", "1", "5")
"""Steps that a way can have, in."""
_USUAL_WAY: Final = ".5"
_ANGLES: Final = ("1", "5", "15", "45")
"""Steps of an angle, degrees."""
_USUAL_ANGLE: Final = "5"
_SIGNS: Final = (("-", "−"), ("+", "+"))
_GAPS: Final = (("open 1", "Open 1 in"), ("open 2", "Open 2 in"), ("open 3", "Open 3 in"), ("close", "Close"))
_WORDS: Final = (("undo", "Undo"), ("where", "Where"), ("float", "Float"), ("save", "Save"))


def teaching_page(teacher: Teacher, newest: Newest) -> bytes:
    """The page of a cell in which somebody teaches.

    Raises:
        InvalidInput: the task shows no scene.
    """
    workplace = teacher.workplace
    face = Face(
        title=teacher.file.name,
        controls=[_jogging(workplace.run.arm), _hand(), _naming(workplace.taught.parts)],
        aside=_file(teacher.file.name),
        listener="teacher",
        script="teaching.js",
    )
    return live_page(workplace.runner, newest, face)


def taught_markup(teacher: Teacher) -> Markup:
    """The taught file as it will be, with the lines marked that are not saved."""
    saved = set(teacher.saved.splitlines())
    lines = teacher.text.splitlines()
    if not lines:
        return element("p", "Nothing is taught yet.", class_="note")
    return element(
        "ol",
        *(element("li", element("code", line), class_=None if line in saved else "new") for line in lines),
    )


def _jogging(arm: ArmModel) -> Markup:
    """What moves the arm by a little: the hand along an axis, or about one, or a joint by itself."""
    steps = element(
        "div",
        _choice("frame", "along", _FRAMES, _FRAMES[0][0]),
        _choice("way", "step", [(way, f"{way} in") for way in _WAYS], _USUAL_WAY),
        _choice("angle", "turn", [(angle, f"{angle}°") for angle in _ANGLES], _USUAL_ANGLE),
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
    return element(
        "div",
        steps,
        _grid("hand, a step at a time", hand),
        _grid("joints, a step at a time", joints),
        id="jog",
    )


def _choice(name: str, label: str, options: Iterable[tuple[str, str]], usual: str) -> Markup:
    shown = (element("option", said, value=value, selected=value == usual) for value, said in options)
    return element("label", f"{label} ", element("select", *shown, id=name))


def _grid(label: str, pairs: Iterable[Markup]) -> Markup:
    return element("div", *pairs, class_="jogs", role="group", aria_label=label)


def _pair(line: str, shown: str, step: str) -> Markup:
    """Two buttons that move something one way and the other; the script puts frame and step in the line."""
    less, more = (
        element(
            "button",
            sign,
            type="button",
            value=f"{line} {typed}",
            data_step=step,
            aria_label=f"{shown} {sign}",
        )
        for typed, sign in _SIGNS
    )
    return element("span", less, element("span", text(shown)), more)


def _hand() -> Markup:
    return element("div", *buttons(_GAPS), *buttons(_WORDS), class_="controls")


def _naming(parts: Iterable[str]) -> Markup:
    """What records where the hand is."""
    name = element(
        "input", id="name", type="text", required=True, maxlength="60", pattern="[A-Za-z_][A-Za-z0-9_]*",
        placeholder="NAME", aria_label="name of the position", autocomplete="off",
    )  # fmt: skip
    of: Sequence[tuple[str, str]] = [("", "on the table"), *((part, f"on {part}") for part in parts)]
    again = element("label", element("input", id="again", type="checkbox"), " replace")
    return element(
        "form",
        name,
        element(
            "select",
            *(element("option", shown, value=part) for part, shown in of),
            id="part",
            aria_label="on",
        ),
        again,
        element("button", "Record", type="submit"),
        element("button", "Go to", id="go", type="button"),
        id="record",
        class_="controls",
    )


def _file(name: str) -> Markup:
    return element(
        "div",
        element("h3", name),
        element("div", id="taught"),
        class_="source",
        tabindex="0",
        role="region",
        aria_label="taught file",
    )
