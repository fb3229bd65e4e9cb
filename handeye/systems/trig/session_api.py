"""A session of TRIG from Python: lines are typed, and both displays show what has come of them."""

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
    """A session at TRIG's editor, with a teach box: each line typed is executed, and the program grows.

    It shows itself as its steps; in notebooks in miniature, too.

    >>> session = handeye.TrigSession()
    >>> session.type("M CENTER\\nX 0 Y 0 Z 150 RECORD\\nM BLOCK\\nX 60 Z 6 RECORD\\nGRASP")
    ()
    >>> session
       ***  CENTER
       ***  BLOCK
    ▶  ***  (grasp)
    >>> session.type("RUN -1000")
    ('3 steps undone; nothing before this can be undone',)
    """

    def __init__(self, arm: ArmName = "none") -> None:
        """Sit down at an arm, to write a new program.

        Args:
            arm: `none` is one that is imagined, `purbrick` that of the paper, with physics.

        Raises:
            InvalidInput: there is no such arm.
        """
        if arm not in get_args(ArmName):
            raise NoSuchName(f"there is no arm {quoted(str(arm))}; there are `none` and `purbrick`")
        self._session = new_session(arm)

    def type(self, text: str) -> tuple[str, ...]:
        """Type lines, as a script has them: commands, the teach box, answers, and what the user does with the table.

                Returns:
        The messages, a sentence each.

                Raises:
                    InvalidInput: a line cannot be executed; those before it have been.
        """
        told: list[str] = []
        script = Script(text.splitlines(), told.append)
        self._session.desk, self._session.over = script, False
        type_script(self._session, script, "what was typed")
        return tuple(told)

    @property
    def hand(self) -> tuple[float, float, float]:
        """Commanded position of the hand: X, Y and Z of the paper's arm, mm."""
        x, y, z, *_ = self._session.arm.here().measures()
        return x, y, z

    def photograph(self, *, width: int = 640, height: int = 480) -> Photograph:
        """Arm and table as seen by a person in front of them, shape (height, width, 3), red, green and blue.

        Raises:
            InvalidInput: the arm is imagined, there is no OpenGL on this machine, or the size is none of a picture.
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
