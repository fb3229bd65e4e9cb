"""Windows of the screen: full display, partial display, program editor, and arm status."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from prompt_toolkit.application import Application
from prompt_toolkit.completion import WordCompleter
from prompt_toolkit.formatted_text import StyleAndTextTuples
from prompt_toolkit.history import InMemoryHistory
from prompt_toolkit.input import Input
from prompt_toolkit.key_binding import KeyBindings
from prompt_toolkit.layout import Container, Dimension, HSplit, Layout, Window
from prompt_toolkit.layout.controls import FormattedTextControl
from prompt_toolkit.output import Output
from prompt_toolkit.styles import Style
from prompt_toolkit.widgets import TextArea

from handeye.core.plain_text import counted, printable
from handeye.systems.trig.cli.keys import BOX_HELP, BUSY_HELP, LINE_HELP, PAGE_HELP, STEPS
from handeye.systems.trig.language.command_table import COMMANDS
from handeye.systems.trig.language.display import full_display, partial_display
from handeye.systems.trig.language.place import is_named, told_place
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.styled import Line, symbols_for

if TYPE_CHECKING:
    from handeye.systems.trig.cli.screen import Screen

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """The displays of a program, and its arm's status."""

    full: list[Line]
    partial: list[Line]
    count: int
    arm: str


def pictured(session: Session, size: tuple[int, int]) -> Picture:
    """Draw both displays for a terminal of this many columns and rows."""
    columns, rows = size
    symbols = symbols_for("utf-8")
    full = full_display(session.program, columns - 2, FULL_ROWS, symbols)
    room = max(1, rows - len(full) - editor_rows(rows) - 6)
    hand = "closed" if session.arm.closed else "open"
    return Picture(
        full=full,
        partial=partial_display(session.program, columns - 2, room, symbols),
        count=sum(node.shown for node in session.program.graph.nodes.values()),
        arm=f"arm {told_place(session.arm.here())}   hand {hand}",
    )


def editor_rows(rows: int) -> int:
    """Terminal rows for input and answers."""
    return max(1, min(EDITOR_ROWS, rows // 4 - 1))


def application(
    screen: "Screen", keys: KeyBindings, input: Input | None, output: Output | None
) -> Application[None]:
    """The application that fills the terminal."""
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
        _text(lambda: _page(screen) if screen.page else _drawn(screen.picture().partial), height=None),
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
    """The latest input and answers."""
    room = editor_rows(screen.size[1])
    last = list(screen.told)[-room:]
    lines = [("", "")] * (room - len(last)) + last
    return [piece for style, text in lines for piece in ((f"class:{style}", text), ("", "\n"))]


def _text(text: Callable[[], StyleAndTextTuples], height: Callable[[], int] | None = lambda: 1) -> Window:
    """A text window; without a height it takes the remaining rows."""
    rows = Dimension(weight=1) if height is None else lambda: Dimension.exact(height())
    return Window(FormattedTextControl(text), height=rows)


def _rule(title: str, beside: str, screen: "Screen") -> StyleAndTextTuples:
    """A rule with a title."""
    end = f" {beside} ─" if beside else ""
    room = screen.size[0] - len(title) - len(end) - 4
    return [("class:rule", "── "), ("class:title", title), ("class:rule", f" {'─' * max(0, room)}{end}")]


def _drawn(lines: list[Line]) -> StyleAndTextTuples:
    """A display, indented by a blank."""
    drawn: StyleAndTextTuples = []
    for line in lines:
        drawn += [("", " "), *((f"class:{style}", text) for style, text in line), ("", "\n")]
    return drawn


def _page(screen: "Screen") -> StyleAndTextTuples:
    """A long answer from its scroll position."""
    return [("", "\n".join(f" {line}" for line in screen.page[screen.scroll :]))]


def _help(screen: "Screen") -> str:
    """Help for the present input."""
    if screen.mode == "box":
        return f"{BOX_HELP}   step {STEPS[screen.step]:g}"
    return LINE_HELP if screen.mode == "line" else BUSY_HELP


def _file(session: Session) -> str:
    """The file name, starred if there are unsaved changes."""
    star = "*" if session.program.changed else ""
    return f"{printable(str(session.file))}{star}" if session.file else "not written" if star else ""


def _words(session: Session) -> list[str]:
    """Completions of a word."""
    steps = [node.name for node in session.program.graph.nodes.values() if node.name]
    return sorted({*COMMANDS, "HELP", *steps, *filter(is_named, session.program.positions)})
