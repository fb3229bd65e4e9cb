"""Key bindings of the screen, by what it waits for."""

from typing import TYPE_CHECKING, Final

from prompt_toolkit.application import get_app
from prompt_toolkit.filters import Condition
from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent

if TYPE_CHECKING:
    from handeye.systems.trig.cli.screen import Screen

JOGS: Final = {
    "left": (0, -1), "right": (0, 1), "down": (1, -1), "up": (1, 1), "pagedown": (2, -1), "pageup": (2, 1),
    "x": (0, -1), "X": (0, 1), "y": (1, -1), "Y": (1, 1), "z": (2, -1), "Z": (2, 1),
    "r": (3, -1), "R": (3, 1), "p": (4, -1), "P": (4, 1), "w": (5, -1), "W": (5, 1),
}  # fmt: skip
"""Axis and direction of each teach box key."""
BOX_HELP: Final = "xXyYzZrRpPwW or ←→↓↑PgDnPgUp: drive   Enter: record   k: kill   +-:"
LINE_HELP: Final = "HELP: commands   Tab: complete   Ctrl-C: drop the line   Q or Ctrl-D: leave"
BUSY_HELP: Final = "any key stops the arm"
PAGE_HELP: Final = "PgUp PgDn, then any line"
STEPS: Final = (0.1, 1.0, 5.0, 10.0, 50.0)  # mm or deg per teach box key


def bindings(screen: "Screen") -> KeyBindings:
    """Key bindings by mode."""
    keys = KeyBindings()
    _bind_box(keys, screen)
    _bind_line(keys, screen)

    @keys.add("<any>", filter=Condition(lambda: screen.mode == "busy"), eager=True)
    @keys.add("c-c", filter=Condition(lambda: screen.mode == "busy"), eager=True)
    def _(event: KeyPressEvent) -> None:
        screen.strike()

    return keys


def _bind_box(keys: KeyBindings, screen: "Screen") -> None:
    box = Condition(lambda: screen.mode == "box")
    for key, (axis, sign) in JOGS.items():
        keys.add(key, filter=box, eager=True)(lambda _, axis=axis, sign=sign: screen.jog(axis, sign))
    for key in ("enter", " "):
        keys.add(key, filter=box, eager=True)(lambda _: screen.put_button("record"))
    keys.add("k", filter=box, eager=True)(lambda _: screen.put_button("kill"))
    keys.add("c-c", filter=box, eager=True)(lambda _: screen.put_button(None))
    keys.add("+", filter=box, eager=True)(lambda _: screen.change_step(1))
    keys.add("-", filter=box, eager=True)(lambda _: screen.change_step(-1))
    keys.add("<any>", filter=box)(lambda _: None)


def _bind_line(keys: KeyBindings, screen: "Screen") -> None:
    line = Condition(lambda: screen.mode == "line")
    empty = Condition(lambda: not get_app().current_buffer.text)

    @keys.add("c-c", filter=line)
    def _(event: KeyPressEvent) -> None:
        event.current_buffer.reset()
        screen.drop_line()

    keys.add("c-d", filter=line & empty)(lambda _: screen.put_line(None))
    keys.add("pagedown", filter=line)(lambda _: screen.turn_page(1))
    keys.add("pageup", filter=line)(lambda _: screen.turn_page(-1))
