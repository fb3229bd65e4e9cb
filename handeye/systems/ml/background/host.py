"""The host, a larger computer behind a link, and the commands that need the host. Without a host, MOS works alone."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadFile
from handeye.core.source import Source
from handeye.systems.ml.background.hand_frame import MOTORS, rotated, translated
from handeye.systems.ml.background.motion import dhand, go_line, go_mean, start
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.language.parser import parsed

if TYPE_CHECKING:
    from handeye.systems.ml.background.interpreter import Interpreter

Procedure = Callable[..., None]  # its parameters are the interpreter and the values of the statement


class Host:
    """A host that keeps programs in its memory.

    The keys of `procedures` are the names of commands, from `UPROCA` to `UPROCD`. The values are the user's functions
    that these commands call.
    """

    def __init__(self, procedures: Mapping[str, Procedure] | None = None) -> None:
        self.procedures = dict(procedures or {})
        self.texts: dict[str, str] = {}

    def read(self, name: str) -> str:
        """Return the text of a program. Raises InvalidInput if the host has no program of that name."""
        if name not in self.texts:
            raise MlError("M16", f"the host has no program {quoted(name)}")
        return self.texts[name]

    def write(self, name: str, text: str) -> None:
        """Store the text of a program. Raises InvalidInput if the program cannot be stored."""
        self.texts[name] = text

    def interpreter(self) -> None:
        """Start the interpreter of the arm language. Raises InvalidInput if the interpreter cannot be started."""
        raise MlError("M16", "this host has no interpreter of the arm language")


def _host(mos: "Interpreter") -> Host:
    if mos.host is None:
        raise MlError("M16", "there is no host")
    if mos.memory.closed:
        raise MlError("M16", "the session with the host is closed")
    mos.memory.sent += 1
    return mos.host


def load_program(mos: "Interpreter", name: str) -> None:
    replace_program(mos, Source(name=name, text=_host(mos).read(name)))
    mos.memory.received += 1


def replace_program(mos: "Interpreter", source: Source) -> None:
    """Replace the stored program by the program of `source`. If a program is running, end it. Raises BadFile if the new
    program has mistakes.
    """
    lines, found = parsed(source)
    if found:
        row, _ = source.position(found[0].primary.span.start)
        raise BadFile(f"{source.name}:{row}: {found[0].message}; `handeye check` shows all mistakes")
    mos.end()
    mos.program.clear()
    for line in lines:
        if line.number is not None:
            mos.program.store(line.number, line.statement)


def dump_program(mos: "Interpreter", name: str) -> None:
    _host(mos).write(name, "".join(f"{line}\n" for line in mos.program.listing()))


def close(mos: "Interpreter") -> None:
    _host(mos)
    mos.memory.closed = True


def control(mos: "Interpreter") -> None:
    _host(mos).interpreter()


def call(name: str, mos: "Interpreter", *values: int) -> None:
    procedure = _host(mos).procedures.get(name)
    if procedure is None:
        raise MlError("M16", f"the host has no procedure {name}")
    procedure(mos, *values)


def rotate(mos: "Interpreter", yaw: int, pitch: int = 0, roll: int = 0) -> None:
    start(mos, rotated(_goals(mos), yaw, pitch, roll))


def translate(mos: "Interpreter", x: int, y: int = 0, z: int = 0) -> None:
    start(mos, translated(_goals(mos), (x, y, z)))


def _goals(mos: "Interpreter") -> dict[int, int]:
    _host(mos)
    if mos.memory.side != "right":
        raise MlError("M16", "commands along the axes of the gripper work only for the right arm")
    return {motor: mos.level.goal(motor) for motor in MOTORS}


def _by_host(behave: Callable[..., None]) -> Callable[..., None]:
    def move(mos: "Interpreter", *values: int) -> None:
        _host(mos)
        behave(mos, *values)

    return move


HOST: Final[dict[str, Callable[..., None]]] = {
    "GROT": rotate, "GTRANS": translate, "GOLINE": _by_host(go_line), "GOMEAN": _by_host(go_mean),
    "DHAND": _by_host(dhand), "CMSLOAD": load_program, "CMSDUMP": dump_program, "QUIT": close, "VMCNTL": control,
    **{name: partial(call, name) for name in ("UPROCA", "UPROCB", "UPROCC", "UPROCD")},
}  # fmt: skip
