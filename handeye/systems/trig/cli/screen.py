"""The full-screen user interface: live displays, and keys for the teach box.

The session runs in a thread of its own, so that the screen can read keys while the arm moves. Only one thread at a
time may read the program and draw the displays: the screen's thread while the session waits, and the session's thread
while the session works.
"""

from collections import deque
from collections.abc import Callable
from queue import SimpleQueue
from threading import Event, Thread
from typing import Final, Literal

from prompt_toolkit.application import Application
from prompt_toolkit.buffer import Buffer
from prompt_toolkit.input import Input
from prompt_toolkit.output import Output

from handeye.core.errors import InvalidInput
from handeye.core.plain_text import folded
from handeye.systems.trig.cli.windows import STEPS, Picture, application, bindings, pictured
from handeye.systems.trig.language.command_input import hear
from handeye.systems.trig.language.desk import Button, Cancelled, Desk, Jog
from handeye.systems.trig.language.place import SIZES
from handeye.systems.trig.language.session import Session

PROMPT: Final = ">"
PACE: Final = 0.08  # s for which a step is shown if the arm has no clock, so that a user can see and stop it
LONG: Final = 4  # lines; longer answers get a page of their own
_KEPT: Final = 500  # lines of history

Mode = Literal["line", "box", "busy"]


class Screen(Desk):
    """Shows a session on the full screen, and reads the user's input."""

    def __init__(
        self,
        session: Session,
        *,
        pace: float = PACE,
        waits: Callable[[Mode], None] = lambda _: None,
        input: Input | None = None,
        output: Output | None = None,
    ) -> None:
        """Attach to a session. Each step is shown for `pace` seconds. `waits` is called when the session waits for
        input.
        """
        self.session, self.question = session, PROMPT
        self.mode: Mode = "busy"  # what input is awaited
        self.step = 3  # index of the teach box step
        self.told: deque[tuple[str, str]] = deque(maxlen=_KEPT)  # style and text of lines
        self.page: list[str] = []  # a long answer, shown instead of the partial display until the next line
        self.scroll = 0
        self._pace, self._waits = pace, waits
        self._lines, self._buttons = SimpleQueue[str | None](), SimpleQueue[Button | None]()
        self._struck, self._failed = Event(), list[BaseException]()
        session.desk = self
        self.app: Application[None] = application(self, bindings(self), input, output)
        self._picture = pictured(session, self.size)

    # -- the session's side ----------------------------------------------------------------------------

    def answer(self, question: str) -> str:
        line = self._line(question)
        if not line:
            raise Cancelled
        return line

    def press(self) -> Button:
        self._wait("box")
        button = self._buttons.get()
        if button is None:
            raise Cancelled
        return button

    def tell(self, sentence: str) -> None:
        if sentence.count("\n") > LONG:
            self.page, self.scroll = folded(sentence, self.size[0] - 2).split("\n"), 0
        else:
            self._say("told", sentence)

    def wrong(self, error: InvalidInput) -> None:
        self._say("wrong", str(error))

    def halted(self) -> bool:
        if self.mode == "box":
            return False
        struck = self._struck.wait(self._pace)
        self._struck.clear()
        return struck

    def refresh(self) -> None:
        self._picture = pictured(self.session, self.size)
        self.app.invalidate()

    def _work(self) -> None:
        try:
            while not self.session.over and (line := self._line(PROMPT)) is not None:
                self.page = []
                try:
                    hear(self.session, line)
                except InvalidInput as error:
                    self.wrong(error)
        except BaseException as error:  # raised again when the terminal has been restored
            self._failed.append(error)
        if self.app.loop is not None:
            self.app.loop.call_soon_threadsafe(self.app.exit)

    def _line(self, question: str) -> str | None:
        self.question = question
        self._wait("line")
        line = self._lines.get()
        if line is not None:
            self._say("typed", f"{question}{line}")
        return line

    def _wait(self, mode: Mode) -> None:
        self.refresh()
        self._struck.clear()
        self.mode = mode
        self.app.invalidate()
        self._waits(mode)

    def _say(self, style: str, text: str) -> None:
        self.told.extend((style, line) for line in folded(text, self.size[0]).split("\n"))

    # -- the terminal's side ---------------------------------------------------------------------------

    @property
    def size(self) -> tuple[int, int]:
        """Number of columns and rows of the terminal."""
        size = self.app.output.get_size()
        return size.columns, size.rows

    def run(self) -> None:
        """Show the session until it ends."""
        self.app.run(pre_run=Thread(target=self._work, daemon=True).start)
        if self._failed:
            raise self._failed[0]

    def picture(self) -> Picture:
        if self.mode != "busy":
            self._picture = pictured(self.session, self.size)
        return self._picture

    def accept(self, buffer: Buffer) -> bool:
        if self.mode == "line":
            self.put_line(buffer.text)
        return False

    def put_line(self, line: str | None) -> None:
        """Pass a line to the session, or None for the end of the input."""
        self.mode = "busy"
        self._lines.put(line)

    def put_button(self, button: Button | None) -> None:
        """Tell the session what the user has done on the teach box. `button` is None if the user has put the teach box
        down.
        """
        if not isinstance(button, Jog):
            self.mode = "busy"
        self._buttons.put(button)

    def jog(self, axis: int, sign: int) -> None:
        self.put_button(Jog(axis, sign * STEPS[self.step] * SIZES[axis]))

    def change_step(self, by: int) -> None:
        self.step = max(0, min(self.step + by, len(STEPS) - 1))

    def turn_page(self, by: int) -> None:
        self.scroll = max(0, min(self.scroll + 8 * by, len(self.page) - 1))

    def drop_line(self) -> None:
        """Discard the typed line. If a question is being asked, also cancel the question."""
        if self.question != PROMPT:
            self.put_line(None)

    def strike(self) -> None:
        """Stop the present motion or run."""
        self._struck.set()
