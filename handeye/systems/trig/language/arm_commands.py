"""Commands that drive the arm, and add nothing to the program."""

from handeye.core.units import OUNCE_FORCE
from handeye.systems.trig.language.given import Given
from handeye.systems.trig.language.node import Node
from handeye.systems.trig.language.place import told_place
from handeye.systems.trig.language.session import Session


def free(session: Session, given: Given) -> None:
    """FREE: the teach box has the arm until its save button is pressed."""
    session.taught()


def go(session: Session, given: Given) -> None:
    """GOPOS: go to a position."""
    if not session.arm.go(session.runner.goal(_move(session, given)), session.desk.halted):
        session.desk.tell(f"stopped at {told_place(session.arm.here())}")


def feel(session: Session, given: Given) -> None:
    """GOGPOS: go to a position until a force stops the arm, and tell how it ended."""
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


def close(session: Session, given: Given) -> None:
    """GOGRASP: close the hand."""
    session.arm.hand(True)


def open(session: Session, given: Given) -> None:
    """GOUNGRASP: open the hand."""
    session.arm.hand(False)


def _move(session: Session, given: Given) -> Node:
    """A move that is no step."""
    session.position(given.position, negate=given.negate)
    node = session.program.graph.new("normal")
    node.position, node.negate = given.position, given.negate
    return node
