"""Commands that define positions without a step."""

from handeye.core.errors import Refused
from handeye.systems.trig.language.given import Arguments
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.position import Position
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.step_commands import check_no_opposite


def here(session: Session, given: Arguments) -> None:
    """HERE and SA: name the arm's present place."""
    _define(session, given.position or "", session.arm.here(), relative=False)


def here_relative(session: Session, given: Arguments) -> None:
    """SR: name the offset from the end of the last step to the arm's present place."""
    start = session.program.ended_at
    if start is None:
        raise Refused("no step has taken the arm anywhere yet; CALPOS and ENDCAL measure any way")
    _define(session, given.position or "", session.arm.here().seen_from(start), relative=True)


def begin_way(session: Session, given: Arguments) -> None:
    """CALPOS: remember the arm's place."""
    session.origin = session.arm.here()


def end_way(session: Session, given: Arguments) -> None:
    """ENDCAL: name the offset from there to the arm's present place."""
    if session.origin is None:
        raise Refused("CALPOS comes first: it remembers where the way begins")
    _define(session, given.position or "", session.arm.here().seen_from(session.origin), relative=True)
    session.origin = None


def _define(session: Session, name: str, place: Place, *, relative: bool) -> None:
    positions = session.program.positions
    if name in positions:
        _check_redefinition(session, name, relative)
    positions[name] = Position(relative=relative, init=place, data=place)
    session.program.changed = True


def _check_redefinition(session: Session, name: str, relative: bool) -> None:
    """Return if a position may be redefined and the user agrees."""
    was = session.position(name).relative
    if relative and any(node.type == "savpos" for node in session.program.users(name)):
        raise Refused(f"a SAVPOS step sets {name}, so {name} stays absolute; D deletes the step")
    if not relative:
        check_no_opposite(session, name)
    kinds = {True: "relative", False: "absolute"}
    change = "" if was == relative else f", and {kinds[was]}"
    session.confirmed(f"{name} is defined already{change}. Replace it? ")
