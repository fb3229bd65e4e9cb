"""A TRIG session for use from Python. Python code types lines into the session. Both of TRIG's displays show the TRIG
program that these lines make.
"""

from typing import Final, get_args

from handeye.cell.photograph import Photograph, check_size
from handeye.core.diagnostics import quoted
from handeye.core.errors import NoSuchName, Refused
from handeye.core.notebook import frame, page
from handeye.systems.trig.jobs.benches import ArmName, SeenTable, new_session
from handeye.systems.trig.language.command_input import Script, type_script
from handeye.systems.trig.language.display import full_display, partial_display
from handeye.systems.trig.language.styled import plain

_WIDE: Final = 100  # characters of a line of the displays


class TrigSession:
    """A session at TRIG's editor, with a teach box, whose controls move the arm. Each typed line is executed, and most
    commands add a step to the program.

    The session is displayed as the steps of its program; notebooks also show the program in miniature.

    >>> session = handeye.TrigSession()
    >>> session.type("M CENTER\\nX 0 Y 0 Z 150 RECORD\\nM BLOCK\\nX 60 Z 6 RECORD\\nGRASP")
    ()
    >>> session
       ***  CENTER
       ***  BLOCK
    ▶  ***  (grasp)
    >>> session.type("RUN -1000")
    ('3 steps undone; no earlier steps can be undone',)
    """

    def __init__(self, arm: ArmName = "none") -> None:
        """Start a session with an arm and an empty program.

        Args:
            arm: `none` for an imaginary arm, or `purbrick` for the arm of the paper, with physics.

        Raises:
            InvalidInput: there is no such arm.
        """
        if arm not in get_args(ArmName):
            raise NoSuchName(f"there is no arm {quoted(str(arm))}; the arms are `purbrick` and `none`")
        self._session = new_session(arm)

    def type(self, text: str) -> tuple[str, ...]:
        """Execute lines, as in a script: commands, teach box actions, answers, and lines about the table.

        Returns:
            the messages, one sentence each.

        Raises:
            InvalidInput: a line cannot be executed. The lines before the refused line have been executed.
        """
        told: list[str] = []
        script = Script(text.splitlines(), told.append)
        self._session.desk, self._session.over = script, False
        type_script(self._session, script, "what was typed")
        return tuple(told)

    @property
    def hand(self) -> tuple[float, float, float]:
        """Commanded position of the hand: X, Y and Z of the arm (mm)."""
        x, y, z, *_ = self._session.arm.here().measures()
        return x, y, z

    def photograph(self, *, width: int = 640, height: int = 480) -> Photograph:
        """Return a photograph of the arm and the table from the front, as red, green and blue values of shape (height,
        width, 3).

        Raises:
            InvalidInput: the arm is `none` (it has no physics), or OpenGL is missing, or the size is outside the
                limits of a photograph.
        """
        table = self._session.table
        if not isinstance(table, SeenTable):
            raise Refused("an arm without physics cannot be shown; use TrigSession('purbrick')")
        check_size(width, height)
        return table.photograph(width, height)

    def __repr__(self) -> str:
        program = self._session.program
        return plain(partial_display(program, _WIDE, self._rows))

    def _repr_html_(self) -> str:
        return page(frame(plain(full_display(self._session.program, _WIDE, self._rows))), frame(repr(self)))

    @property
    def _rows(self) -> int:
        return max(1, len(self._session.program.graph.nodes))
