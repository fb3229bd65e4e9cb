"""Commands that drive the arm without adding to the program."""

from handeye.core.units import OUNCE_FORCE
from handeye.systems.trig.language.given import Arguments
from handeye.systems.trig.language.node import Node
from handeye.systems.trig.language.place import told_place
from handeye.systems.trig.language.session import Session


def free(session: Session, given: Arguments) -> None:
    """FREE: move the arm with the teach box until its save button is pressed."""
    session.taught()


def go(session: Session, given: Arguments) -> None:
    """GOPOS: go to a position."""
    if not session.arm.go(session.runner.goal(_move(session, given)), session.desk.halted):
        session.desk.tell(f"stopped at {told_place(session.arm.here())}")


def feel(session: Session, given: Arguments) -> None:
    """GOGPOS: go to a position until a force stops the arm, and report the end."""
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
    """A move outside the program."""
    session.position(given.position, negate=given.negate)
    node = session.program.graph.new("normal")
    node.position, node.negate = given.position, given.negate
    return node
