"""Commands that move the arm or define positions, but add no step to the program."""

from handeye.core.errors import Refused
from handeye.core.units import OUNCE_FORCE
from handeye.systems.trig.language.arguments import Arguments
from handeye.systems.trig.language.graph import Node
from handeye.systems.trig.language.place import Place, Position, told_place
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.step_commands import check_no_opposite


def free(session: Session, given: Arguments) -> None:
    """FREE: let the user move the arm with the teach box, until the user presses its record button."""
    session.taught()


def go(session: Session, given: Arguments) -> None:
    """GOPOS: go to a position."""
    if not session.arm.go(session.runner.goal(_move(session, given)), session.desk.halted):
        session.desk.tell(f"stopped at {told_place(session.arm.here())}")


def feel(session: Session, given: Arguments) -> None:
    """GOGPOS: move towards a position until a force stops the arm, and report where the arm stopped."""
    goal = session.runner.goal(_move(session, given))
    threshold, vector = session.threshold(), session.vector()
    arrival = session.arm.feel(goal, vector, threshold, session.desk.halted)
    at = told_place(session.arm.here())
    session.desk.tell(
        {
            "reached": f"reached {at}",
            "tripped": f"stopped by a force of {arrival.force / OUNCE_FORCE:.3g} oz at {at}",
            "halted": f"stopped at {at}",
        }[arrival.kind]
    )


def close(session: Session, given: Arguments) -> None:
    """GOGRASP: close the hand."""
    session.arm.hand(True)


def open(session: Session, given: Arguments) -> None:
    """GOUNGRASP: open the hand."""
    session.arm.hand(False)


def _move(session: Session, given: Arguments) -> Node:
    """Return a move that is not part of the program."""
    session.position(given.position, negate=given.negate)
    node = session.program.graph.new("normal")
    node.position, node.negate = given.position, given.negate
    return node


def here(session: Session, given: Arguments) -> None:
    """HERE and SA: store the arm's present place under a name."""
    _define(session, given.position or "", session.arm.here(), relative=False)


def here_relative(session: Session, given: Arguments) -> None:
    """SR: measure the offset of the arm's present place from the place where the last step ended, and store this
    offset under a name.
    """
    start = session.program.ended_at
    if start is None:
        raise Refused("no step has moved the arm yet; to measure a distance, use CALPOS and ENDCAL")
    _define(session, given.position or "", session.arm.here().seen_from(start), relative=True)


def begin_way(session: Session, given: Arguments) -> None:
    """CALPOS: remember the arm's present place."""
    session.origin = session.arm.here()


def end_way(session: Session, given: Arguments) -> None:
    """ENDCAL: measure the offset of the arm's present place from the place that CALPOS remembered, and store this
    offset under a name.
    """
    if session.origin is None:
        raise Refused("type CALPOS first, to record the start")
    _define(session, given.position or "", session.arm.here().seen_from(session.origin), relative=True)
    session.origin = None


def _define(session: Session, name: str, place: Place, *, relative: bool) -> None:
    positions = session.program.positions
    if name in positions:
        _check_redefinition(session, name, relative)
    positions[name] = Position(relative=relative, init=place, data=place)
    session.program.changed = True


def _check_redefinition(session: Session, name: str, relative: bool) -> None:
    """Raise an exception if a position may not be redefined, or if the user does not agree to the redefinition."""
    was = session.position(name).relative
    if relative and any(node.type == "savpos" for node in session.program.users(name)):
        raise Refused(f"{name} cannot become relative, because a SAVPOS step sets it; D deletes the step")
    if not relative:
        check_no_opposite(session, name)
    kinds = {True: "relative", False: "absolute"}
    change = "" if was == relative else f", and {kinds[was]}"
    session.confirmed(f"{name} is already defined{change}. Replace it? ")
