"""Quantities of a trace are told in words, in the units of the arm language, and never alike where they differ."""

import pytest

from handeye.program.diagnosis.cause_record import JointName
from handeye.program.events import (
    FrictionMeasured,
    GuardTripped,
    HandTold,
    JointFriction,
    PartSeen,
    PictureTaken,
)
from handeye.program.guards import GuardKind
from handeye.trace.quantities import QuantityDifference, Value, differing_events, quantity_text, values_text


@pytest.mark.parametrize(
    ("quantity", "said"),
    [
        (("joint", "wrist roll", "position"), "position of joint wrist roll"),
        (("body", "base", "place", "x"), "place x of body base"),
        (("hand", "force", "z"), "force z of the hand"),
        (("picture", "level", "31", "7"), "level of the picture in row 31, column 7"),
        (("GuardTripped", "value"), "value of the stop"),
        (("gap",), "gap"),
        (("body", "a\x1bb", "place", "x"), "place x of body a\N{REPLACEMENT CHARACTER}b"),
    ],
)
def test_a_quantity_is_told_in_words(quantity: tuple[str, ...], said: str) -> None:
    assert quantity_text(quantity) == said


def test_programs_are_told_its_name_as_one_word() -> None:
    found = QuantityDifference(quantity=("joint", "wrist roll", "position"), a=1.0, b=2.0)
    assert found.name == "joint.wrist_roll.position"


@pytest.mark.parametrize(
    ("unit", "a", "b", "said"),
    [
        ("m", 0.0254, 0.0508, ("1.000 in", "2.000 in")),
        ("rad", 0.0, 3.141592653589793, ("0.000 deg", "180.000 deg")),
        ("s", 1.0, 1.25, ("1.000 s", "1.250 s")),
        ("", 7, 8, ("7", "8")),
        ("m", 0.0254, 0.025400001, ("1.00000000 in", "1.00000004 in")),
        ("m", 0.5, 0.5000000000000001, ("0.5 m", "0.5000000000000001 m")),
        ("m", 0.0254, None, ("1.000 in", "none")),
        ("", True, False, ("True", "False")),
        ("", "force", "touch", ("force", "touch")),
    ],
)
def test_both_values_are_told_apart_to_the_last_bit(
    unit: str, a: Value, b: Value, said: tuple[str, str]
) -> None:
    assert values_text(QuantityDifference(quantity=("gap",), unit=unit, a=a, b=b)) == said


def friction(boom: float, column: float) -> FrictionMeasured:
    joints = (("column", "revolute", column), ("boom", "prismatic", boom))
    told = tuple(JointFriction(joint=JointName(name=n, kind=k), friction=f) for n, k, f in joints)  # type: ignore[arg-type]
    return FrictionMeasured(time=1.0, joints=told, seconds=3.3)


def trip(guard: GuardKind, value: float) -> GuardTripped:
    return GuardTripped(time=1.0, guard=guard, value=value, limit=8.0)


def seen(x: float, yaw: float | None) -> PartSeen:
    return PartSeen(time=1.0, part="BASE", x=x, y=0.5, yaw=yaw)


def told(*at: float) -> HandTold:
    x, y, z, o, a, t = at
    return HandTold(time=1.0, at=(x, y, z, o, a, t))


@pytest.mark.parametrize(
    ("a", "b", "name", "unit"),
    [
        (friction(2.0, 0.3), friction(2.1, 0.3), "joint.boom.friction", "N"),
        (friction(2.0, 0.3), friction(2.0, 0.4), "joint.column.friction", "N m"),
        (trip(GuardKind.FORCE, 9.0), trip(GuardKind.FORCE, 9.5), "GuardTripped.value", "N"),
        (trip(GuardKind.TORQUE, 9.0), trip(GuardKind.TORQUE, 9.5), "GuardTripped.value", "N m"),
        (trip(GuardKind.TOUCH, 1), trip(GuardKind.TOUCH, 2), "GuardTripped.value", ""),
        (seen(0.5, None), seen(0.6, 0.1), "PartSeen.x", "m"),
        (seen(0.5, None), seen(0.5, 0.1), "PartSeen.yaw", "rad"),
        (told(0, 0, 1, 0, 0, 0), told(0, 0, 2, 0, 0, 0), "HandTold.at.z", "m"),
        (told(0, 0, 1, 0, 1, 0), told(0, 0, 1, 0, 2, 0), "HandTold.at.A", "rad"),
    ],
)  # fmt: skip
def test_what_two_events_tell_differently_has_its_name_and_its_unit(a, b, name: str, unit: str) -> None:  # type: ignore[no-untyped-def]
    found = differing_events(a, b)
    assert found is not None
    assert (found.name, found.unit) == (name, unit)


def test_events_that_differ_in_their_time_alone_tell_the_same() -> None:
    a, b = (PictureTaken(time=time, picture="WIDE", lens=0.025) for time in (1.0, 2.0))
    assert differing_events(a, b) is None
