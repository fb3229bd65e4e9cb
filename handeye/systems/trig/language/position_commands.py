"""Commands that define positions without a step."""

from handeye.core.errors import Refused
from handeye.systems.trig.language.given import Given
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.position import Position
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.step_commands import check_no_opposite


def here(session: Session, given: Given) -> None:
    """HERE and SA: a name for the place where the arm is."""
    _define(session, given.position or "", session.arm.here(), relative=False)


def here_relative(session: Session, given: Given) -> None:
    """SR: a name for the way from where the last step took the arm to where it is."""
    start = session.program.ended_at
    if start is None:
        raise Refused("no step has taken the arm anywhere yet; CALPOS and ENDCAL measure any way")
    _define(session, given.position or "", session.arm.here().seen_from(start), relative=True)


def begin_way(session: Session, given: Given) -> None:
    """CALPOS: remember where the arm is."""
    session.origin = session.arm.here()


def end_way(session: Session, given: Given) -> None:
    """ENDCAL: a name for the way from there to where the arm is."""
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
    """Go on if a position may be defined anew, and somebody wants it.

    Raises:
        InvalidInput: a step needs it as it is.
        Withdrawn: nobody wants it.
    """
    was = session.position(name).relative
    if relative and any(node.type == "savpos" for node in session.program.users(name)):
        raise Refused(f"a SAVPOS step sets {name}, so {name} stays absolute; D deletes the step")
    if not relative:
        check_no_opposite(session, name)
    kinds = {True: "relative", False: "absolute"}
    change = "" if was == relative else f", and {kinds[was]}"
    session.confirmed(f"{name} is defined already{change}. Replace it? ")
