"""Pages about TRIG whose sessions are executed: the lines typed in a page are executed, and the page shows the results.

A block `trig` is typed into the session of the page; a block `begin` begins a new session instead. The blocks after it
show the output since then (`told`) and the display: the steps (`partial`), or the whole program (`full`).
"""

import re
from collections.abc import Callable
from typing import Final

from handeye.core.errors import InvalidInput
from handeye.systems.trig.language.command_input import Script, hear
from handeye.systems.trig.language.display import full_display, partial_display
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.styled import plain

WIDTH: Final = 78
_BLOCK: Final = re.compile(r"^```(trig|begin|told|partial|full)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class Page:
    """A page whose sessions are executed from its beginning."""

    def __init__(self) -> None:
        self._begin()

    def carried_out(self, text: str) -> str:
        """Return the page with the true output."""
        return _BLOCK.sub(self._block, text)

    def _begin(self) -> None:
        self._told: list[str] = []
        self._session = Session(arm=(arm := NoArm()), table=arm, desk=Script(()))

    def _block(self, found: re.Match[str]) -> str:
        kind, lines = found.groups()
        if kind in ("trig", "begin"):
            if kind == "begin":
                self._begin()
            self._type(lines)
            return found[0]
        shown: dict[str, Callable[[], str]] = {
            "told": lambda: "\n".join(self._told),
            "partial": lambda: plain(partial_display(self._session.program, WIDTH, 40)),
            "full": lambda: plain(full_display(self._session.program, WIDTH, 8)),
        }
        return f"```{kind}\n{shown[kind]()}\n```"

    def _type(self, lines: str) -> None:
        script = Script(lines.splitlines(), lambda sentence: self._told.append(sentence))
        self._session.desk, self._told = script, []
        while not self._session.over and (line := script.next_line()) is not None:
            try:
                hear(self._session, line)
            except InvalidInput as error:
                self._told.append(str(error))
