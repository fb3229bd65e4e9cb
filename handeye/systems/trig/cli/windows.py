"""Defines the windows of the screen (full display, partial display, program editor, arm status), and the keys of the
editor.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from prompt_toolkit.application import Application, get_app
from prompt_toolkit.completion import WordCompleter
from prompt_toolkit.filters import Condition
from prompt_toolkit.formatted_text import StyleAndTextTuples
from prompt_toolkit.history import InMemoryHistory
from prompt_toolkit.input import Input
from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
from prompt_toolkit.layout import ConditionalContainer, Container, Dimension, HSplit, Layout, VSplit, Window
from prompt_toolkit.layout.controls import FormattedTextControl
from prompt_toolkit.output import Output
from prompt_toolkit.styles import Style
from prompt_toolkit.widgets import TextArea

from handeye.core.plain_text import counted, printable
from handeye.systems.trig.cli.table_view import WIDTH, table_view
from handeye.systems.trig.language.command_table import COMMANDS
from handeye.systems.trig.language.display import full_display, partial_display
from handeye.systems.trig.language.place import is_named, told_place
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.styled import Line, Symbols, fitted, symbols_for

if TYPE_CHECKING:
    from handeye.systems.trig.cli.screen import Screen


JOGS: Final = {
    "left": (0, -1), "right": (0, 1), "down": (1, -1), "up": (1, 1), "pagedown": (2, -1), "pageup": (2, 1),
    "x": (0, -1), "X": (0, 1), "y": (1, -1), "Y": (1, 1), "z": (2, -1), "Z": (2, 1),
    "r": (3, -1), "R": (3, 1), "p": (4, -1), "P": (4, 1), "w": (5, -1), "W": (5, 1),
}  # fmt: skip
BOX_HELP: Final = "xXyYzZrRpPwW or ←→↓↑PgDnPgUp: drive   Enter: record   k: kill   + -: step"
LINE_HELP: Final = "HELP: commands   Tab: complete   Ctrl-C: clear the line   Q or Ctrl-D: leave"
BUSY_HELP: Final = "any key stops the arm"
PAGE_HELP: Final = "PgUp PgDn: scroll   any line: close"
STEPS: Final = (0.1, 1.0, 5.0, 10.0, 50.0)  # mm or deg per teach box key


def bindings(screen: "Screen") -> KeyBindings:
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


STYLE: Final = Style.from_dict(
    {
        "rule": "ansibrightblack",
        "title": "bold",
        "active": "reverse bold",
        "branch": "ansimagenta bold",
        "name": "",
        "position": "ansicyan",
        "hand": "ansiyellow",
        "guarded": "ansimagenta",
        "loop": "ansigreen",
        "link": "ansiblue bold",
        "line": "ansibrightblack",
        "typed": "",
        "told": "ansigreen",
        "wrong": "ansired",
        "status": "reverse",
        "help": "ansibrightblack",
    }
)
FULL_ROWS: Final = 5  # of the full display, at most
EDITOR_ROWS: Final = 5  # of input and answers, at most
DRIVE: Final = "Drive the arm to the place, and record it. "
WIDE: Final = 110  # columns from which the arm and its table are drawn beside the partial display
HINTS: Final = (
    ("M CENTER", "drive the arm to a place, and record it"),
    ("GRASP", "close the hand on a block; UNGRASP opens it"),
    ("RUN -1", "undo the last step; RUN 1 runs it again"),
    ("HELP", "list all commands; HELP M explains M"),
)
"""What to type into an empty program, and what it does."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """The displays of a program, and the status of its arm."""

    full: list[Line]
    partial: list[Line]
    count: int
    arm: str
    table: list[Line]
    """Drawing of the arm and its table; no lines if the terminal is too narrow for the drawing."""


def pictured(session: Session, size: tuple[int, int]) -> Picture:
    """Draw both displays for a terminal of this size (columns, rows)."""
    columns, rows = size
    symbols = symbols_for("utf-8")
    full = full_display(session.program, columns - 2, FULL_ROWS, symbols)
    room = max(1, rows - len(full) - editor_rows(rows) - 6)
    here, closed = session.arm.here(), session.arm.closed
    table = (
        table_view(here, session.program.positions, symbols, room, closed=closed) if columns >= WIDE else []
    )
    free = columns - 2 - (WIDTH + 1 if table else 0)
    count = sum(node.shown for node in session.program.graph.nodes.values())
    partial = partial_display(session.program, free, room, symbols)
    return Picture(
        full=full,
        partial=partial if count else [*partial, *_hints(free, room - len(partial), symbols)],
        count=count,
        arm=f"arm {told_place(here)}   hand {'closed' if closed else 'open'}",
        table=table,
    )


def _hints(columns: int, rows: int, symbols: Symbols) -> list[Line]:
    """Return lines that fit this space: what a user can type first, and what the signs of the displays mean."""
    hints: list[Line] = [[], [("", "The program is empty. Type the first step below. For example:")]]
    hints += [[("title", f"  {typed:<10}"), ("", told)] for typed, told in HINTS]
    hints += [
        [],
        [
            ("active", symbols.cursor),
            ("", " active step   "),
            ("title", "***"),
            ("", " step without a name   "),
        ],
        [("branch", "n g"), ("", " branch of a guarded step: not tripped, or tripped")],
    ]
    return [fitted(line, columns) for line in hints[: max(rows, 0)]]


def editor_rows(rows: int) -> int:
    """Return the number of terminal rows for input and answers."""
    return max(1, min(EDITOR_ROWS, rows // 4 - 1))


def application(
    screen: "Screen", keys: KeyBindings, input: Input | None, output: Output | None
) -> Application[None]:
    line = TextArea(
        multiline=False,
        height=1,
        prompt=lambda: [("class:title", {"line": screen.question, "box": DRIVE, "busy": ""}[screen.mode])],
        accept_handler=screen.accept,
        history=InMemoryHistory(),
        completer=WordCompleter(lambda: _words(screen.session), ignore_case=True),
        complete_while_typing=False,
    )
    windows: list[Container | TextArea] = [
        _text(lambda: _rule("Full Display", counted(screen.picture().count, "step"), screen)),
        _text(lambda: _drawn(screen.picture().full), height=lambda: len(screen.picture().full)),
        _text(
            lambda: _rule("Help", PAGE_HELP, screen) if screen.page else _rule("Partial Display", "", screen),
        ),
        VSplit(
            [
                _text(
                    lambda: _page(screen) if screen.page else _drawn(screen.picture().partial), height=None
                ),
                ConditionalContainer(
                    Window(FormattedTextControl(lambda: _drawn(screen.picture().table)), width=WIDTH),
                    filter=Condition(lambda: bool(screen.picture().table) and not screen.page),
                ),
            ]
        ),
        _text(lambda: _rule("Program Editor", _file(screen.session), screen)),
        _text(lambda: _told(screen), height=lambda: editor_rows(screen.size[1])),
        line,
        _text(lambda: [("class:status", f" {screen.picture().arm} ".ljust(screen.size[0]))]),
        _text(lambda: [("class:help", f" {_help(screen)}")]),
    ]
    return Application(
        layout=Layout(HSplit(windows), focused_element=line),
        key_bindings=keys,
        style=STYLE,
        full_screen=True,
        input=input,
        output=output,
    )


def _told(screen: "Screen") -> StyleAndTextTuples:
    room = editor_rows(screen.size[1])
    last = list(screen.told)[-room:]
    lines = [("", "")] * (room - len(last)) + last
    return [piece for style, text in lines for piece in ((f"class:{style}", text), ("", "\n"))]


def _text(text: Callable[[], StyleAndTextTuples], height: Callable[[], int] | None = lambda: 1) -> Window:
    """Return a text window. If no height is given, the window gets the remaining rows."""
    rows = Dimension(weight=1) if height is None else lambda: Dimension.exact(height())
    return Window(FormattedTextControl(text), height=rows)


def _rule(title: str, beside: str, screen: "Screen") -> StyleAndTextTuples:
    end = f" {beside} ─" if beside else ""
    room = screen.size[0] - len(title) - len(end) - 4
    return [("class:rule", "── "), ("class:title", title), ("class:rule", f" {'─' * max(0, room)}{end}")]


def _drawn(lines: list[Line]) -> StyleAndTextTuples:
    """Return a display, indented by one blank."""
    drawn: StyleAndTextTuples = []
    for line in lines:
        drawn += [("", " "), *((f"class:{style}", text) for style, text in line), ("", "\n")]
    return drawn


def _page(screen: "Screen") -> StyleAndTextTuples:
    """Return the part of a long answer that begins at the present scroll position."""
    return [("", "\n".join(f" {line}" for line in screen.page[screen.scroll :]))]


def _help(screen: "Screen") -> str:
    if screen.mode == "box":
        return f"{BOX_HELP} {STEPS[screen.step]:g}"
    return LINE_HELP if screen.mode == "line" else BUSY_HELP


def _file(session: Session) -> str:
    """Return the name of the program's file. A star marks unsaved changes."""
    star = "*" if session.program.changed else ""
    return f"{printable(str(session.file))}{star}" if session.file else "not written" if star else ""


def _words(session: Session) -> list[str]:
    steps = [node.name for node in session.program.graph.nodes.values() if node.name]
    return sorted({*COMMANDS, "HELP", *steps, *filter(is_named, session.program.positions)})
