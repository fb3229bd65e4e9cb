"""A cause travels as a fact and is put into words by whoever shows it."""

import math
from typing import get_args

import msgspec
import pytest

from handeye.core import errors
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE, OUNCE_INCH
from handeye.program.diagnosis import causes as c
from handeye.program.diagnosis import sense_causes as s
from handeye.program.diagnosis.cause_record import JointName
from handeye.program.diagnosis.cause_text import (
    call_sentence,
    cause_sentence,
    error_sentence,
    inspection_sentence,
)
from handeye.program.diagnosis.reach import HeldJoint, InnerCylinder, JointLimit, ReachFailure
from handeye.program.guards import GuardKind

ARM = c.ArmNames(
    name="toy",
    joints=(JointName(name="rail", kind="prismatic"), JointName(name="wrist", kind="revolute")),
)
WORDS: list[tuple[c.Cause, str]] = [
    (
        c.BeyondArm(goal="OVER", reason=InnerCylinder(4 * INCH, 6 * INCH), arm=ARM),
        "OVER: the wrist would have to be 4.0 in from the axis of joint 1; the minimum is 6.0 in",
    ),
    (
        c.BeyondArm(reason=JointLimit(1, 100 * DEGREE, 90 * DEGREE), arm=ARM),
        "joint 2 (wrist) would have to be at 100.0 degrees; its limit is 90.0 degrees",
    ),
    (c.JointBehind(joint="boom"), "boom lags behind its set-point"),
    (
        c.JointBehind(joint="boom", swings=True, of="PUMP"),
        "boom swings about its set-point: its drive or the computer is late, or its tachometer fails",
    ),
    (c.HandAstray(distance=0.2 * INCH), "the hand is 0.20 in from its set-point"),
    (
        c.HandAstray(distance=0.2 * INCH, joint="boom", of="BASE"),
        "the hand is 0.20 in from its set-point; boom lags most",
    ),
    (
        c.HandPushed(distance=0.2 * INCH, joint="boom"),
        "the hand is 0.20 in from its set-point; a turning screw may have pushed it; boom lags most",
    ),
    (s.PictureNoisy(picture="A", noise=2.23, most=1.6), "picture A has noise of 2.2 levels; allowed: 1.6"),
    (c.HandStuck(moved=0.5 * INCH), "the hand stopped after 0.50 in"),
    (c.GuardsUnmet(guards=(GuardKind.FORCE,)), ""),
    (c.GuardsUnmet(guards=(GuardKind.FORCE, GuardKind.MOMENT)), "or the moment"),
    (
        c.TravelOutside(travel=0.3 * INCH, minimum=0.1 * INCH, maximum=0.2 * INCH),
        "the hand moved 0.30 in; allowed: 0.10 to 0.20 in",
    ),
    (
        c.HeightOutside(name="BARE", height=0.12 * INCH, minimum=0.04 * INCH, maximum=0.08 * INCH),
        "the hand is 0.120 in above BARE; allowed: 0.040 to 0.080 in",
    ),
    (c.HeightUnknown(name="BARE"), "no place was saved as BARE"),
    (c.GapTooSmall(gap=0.02 * INCH, minimum=0.1 * INCH), "gap 0.02 in, minimum 0.10 in"),
    (
        c.GapTooSmall(gap=-0.002 * INCH, minimum=0.0, of="PUMP"),
        "gap -0.002 in, minimum 0.000 in",
    ),
    (c.GapTooLarge(gap=0.4 * INCH, maximum=0.3 * INCH), "gap 0.40 in, maximum 0.30 in"),
    (c.NothingBetween(gap=0.1 * INCH), "at most one finger touches; the gap is 0.10 in"),
    (
        s.SwitchesClosed(fingers=(True, False)),
        "the switch of the +y finger is closed although the fingers are open",
    ),
    (
        s.SwitchesOpen(fingers=(True, True), gap=0.3 * INCH, fits=True),
        "the switches of both fingers are open although something 0.30 in thick holds the fingers apart: the "
        "switches have failed, or the fingers' motor is weak",
    ),
    (
        s.SwitchesOpen(fingers=(True, False), gap=0.3 * INCH),
        "the switch of the +y finger is open although something 0.30 in thick holds the fingers apart: the switch "
        "has failed, or something stands between the fingers beside their tips",
    ),
    (
        s.RateScatters(joint=ARM.joints[1], scatter=1.7 * DEGREE, limit=0.6 * DEGREE),
        "the tachometer reading of the wrist scatters by 1.7 degrees/s while the arm holds still; allowed: 0.6 "
        "degrees/s; the cause is a failing tachometer, an unsteady drive of the joint, or something outside that "
        "shakes the arm",
    ),
    (
        s.RateScatters(joint=ARM.joints[0], scatter=1.0 * INCH, limit=0.25 * INCH),
        "the tachometer reading of the rail scatters by 1.00 in/s while the arm holds still; allowed: 0.25 in/s; "
        "the cause is a failing tachometer, an unsteady drive of the joint, or something outside that shakes the "
        "arm",
    ),
    (
        s.SwitchesCrossed(fingers=(True, False), moved=0.06 * INCH),
        "the switch of the +y finger is still closed after the hand moved 0.06 in towards the side of this finger, "
        "away from the part: the two switches are swapped, or the switch of the other finger stays open",
    ),
    (
        s.SwitchesHard(fingers=(True, True), force=10 * OUNCE_FORCE),
        "the switches of both fingers are open although the fingers are pressed together with 10 oz: the "
        "switches have failed, or the fingers' motor is weak",
    ),
    (
        s.GapJumped(gap=2.3 * INCH, before=2.0 * INCH, held=False),
        "the gap reading jumped from 2.00 in to 2.30 in: no finger can move so fast",
    ),
    (
        s.GapJumped(gap=1.29 * INCH, before=1.39 * INCH, held=True),
        "the gap reading jumped from 1.39 in to 1.29 in: the held part has slipped, or the gap's potentiometer fails",
    ),
    (
        s.GapJumped(gap=1.32 * INCH, before=1.0 * INCH, held=True),
        "the gap reading jumped from 1.00 in to 1.32 in: the held part has been pushed and has forced the "
        "fingers apart, or the gap's potentiometer fails",
    ),
    (
        s.CurrentShort(torque=30 * OUNCE_INCH, asked=42 * OUNCE_INCH),
        "the sensor shows only 30.0 of the commanded 42.0 oz-in while the motor is stalled: the current "
        "sensor reads no higher, or the motor is weak",
    ),
    (
        s.MotorFast(times=1.5),
        "the motor was still speeding up after 1.5 times the usual time, so it turns too fast",
    ),
    (
        s.ScrewHard(torque=38 * OUNCE_INCH, limit=12.6 * OUNCE_INCH),
        "the sensor shows 38.0 oz-in while the screw advances; allowed: 12.6 oz-in; "
        "either the thread is hard to turn, or the current sensor fails",
    ),
    (
        s.GapUnlike(gap=1.15 * INCH, thickness=1.0 * INCH, held="PIN"),
        "the gap reads 1.15 in, but the fingers hold PIN, which is 1.00 in thick; the reading is 1.15 times the "
        "thickness",
    ),
    (
        s.CurrentUnlike(torque=3.5 * OUNCE_INCH, known=7 * OUNCE_INCH),
        "the sensor shows 3.5 oz-in, but the torque of the motor is 7.0 oz-in; the reading is 0.5 times this torque",
    ),
    (
        s.DrivesUnlike(joints=(ARM.joints[1],), factors=(1.3,)),
        "to the drives, the weights of the links seem to have changed: either a drive gives more or less torque "
        "than commanded (the drive of the wrist gives 1.30 times as much), or the arm no longer stands upright",
    ),
    (
        s.MotorSlow(share=0.4),
        "the motor stopped speeding up after only 0.4 times the usual time, so it turns too slowly",
    ),
    (
        s.GapAstray(gap=0.5 * INCH, goal=1.8 * INCH),
        "the gap reads 0.50 in; the fingers were driven to 1.80 in",
    ),
    (
        s.GapStill(gap=1.0 * INCH, driven=0.7 * INCH),
        "the gap still reads 1.00 in; the fingers were driven 0.70 in closer together",
    ),
    (
        s.ForceInAir(force=(0.0, -1.0 * OUNCE_FORCE, 70.0 * OUNCE_FORCE), limit=25 * OUNCE_FORCE, load=0.0),
        "0 oz in x, -1 oz in y, 70 oz in z; allowed: 25 oz; declared load: 0 oz",
    ),
    (
        s.JointSensesApart(joint=ARM.joints[0], potentiometer=1.0 * INCH, tachometer=0.0),
        "rail has moved 1.00 in by its potentiometer and 0.00 in by its tachometer",
    ),
    (
        s.JointSensesApart(joint=ARM.joints[1], potentiometer=2 * DEGREE, tachometer=-1 * DEGREE),
        "wrist has moved 2.0 degrees by its potentiometer and -1.0 degrees by its tachometer",
    ),
    (
        s.JointSensesApart(joint=ARM.joints[1], potentiometer=2 * DEGREE, tachometer=0.0, braked=True),
        "wrist has moved 2.0 degrees by its potentiometer and 0.0 degrees by its tachometer, although its brake "
        "is set: a sensor fails, or the brake slips",
    ),
    (
        s.JointAlone(joint=ARM.joints[1], torque=150 * OUNCE_INCH, friction=30 * OUNCE_INCH),
        "wrist takes 150 oz-in to move; at the start it took 30 oz-in",
    ),
    (
        s.JointAlone(joint=ARM.joints[1], torque=9 * OUNCE_INCH, friction=3 * OUNCE_INCH, one_way=True),
        "wrist takes 9 oz-in to move; at the start it took 3 oz-in; perhaps the arm no longer stands upright",
    ),
    (s.JointAlone(joint=ARM.joints[0], torque=-80 * OUNCE_FORCE), "rail does not move with 80 oz"),
    (s.CurrentSilent(torque=0.0), "the sensor showed at most 0.0 oz-in, less than the motor needs to start"),
    (
        s.PictureRepeated(picture="AFTER", earlier="BEFORE"),
        "picture AFTER is the same as BEFORE, pixel by pixel",
    ),
    (s.PictureBlank(picture="WIDE"), "picture WIDE has the same intensity everywhere"),
    (c.NoPicture(picture="WIDE"), "no picture WIDE was taken"),
    (c.NoGeneral(), "no earlier GENERAL found the part"),
    (c.NoOutline(), "no object of the part's size stands out from the background where the part should be"),
    (c.OutsidePicture(), "the part is not in the field of the close picture: is the camera aimed at it?"),
    (
        c.FaintPicture(contrast=1.734, least=3.3),
        "the earlier picture is too faint to compare: its contrast on the part is 1.7 grey levels, but at least "
        "3.3 are needed; check camera and light",
    ),
    (
        c.DarkPart(brightness=4.93, least=7.6),
        "the part is too dark in the earlier picture to compare: its brightness is 4.9 grey levels, but at least 7.6 "
        "are needed; does a shadow lie on it?",
    ),
    (c.NoHoles(blobs=0), "found no hole: is the picture in focus, and is the part in it?"),
    (
        c.NoHoles(blobs=1),
        "found only one hole, which cannot locate the part: is the picture in focus?",
    ),
    (
        c.NoHoles(blobs=3),
        "3 dark blobs are found, but no two are the part's largest holes: is the picture in focus?",
    ),
    (
        c.CallersVision(by="mine.look"),
        "the calling program's own vision, mine.look, does not accept what it sees",
    ),
    (c.NoGasket(), "no gasket: the later picture shows nothing new where the gasket should be"),
    (
        c.GasketWrong(
            faults=(c.GasketHoleOff(hole="largest", off=0.3 * INCH), c.GasketHoleUnseen(hole="second"))
        ),
        "the largest hole of the gasket is displaced by about 0.30 in; the second hole of the gasket was not found",
    ),
    (
        c.GasketWrong(faults=(c.BaseHoleUnseen(hole="second"),)),
        "the second hole of the base was not found in the earlier picture",
    ),
    (
        c.GasketWrong(faults=(c.GasketTorn(bare=0.25 * INCH**2),)),
        "the gasket leaves 0.25 sq in of the base's face bare: it is torn, or a piece of it is missing",
    ),
    (
        c.PartAstray(off=0.2 * INCH, unlike=0.034),
        "moved by 0.20 in relative to its surroundings; 3.4 % of the part looks different",
    ),
    (c.NoSearch(), "no SEARCH was executed"),
    (c.PlacesTried(places=9), "9 places tried"),
    (c.PlacesTried(places=9, around="T1"), "9 places tried around T1"),
    (c.Looping(place="pins.al:12"), "the program loops at line pins.al:12 while nothing moves"),
    (
        c.UndoResisted(force=30.0, limit=20.0),
        "something resists as the step is undone: the hand feels 107.9 oz; allowed: 71.9 oz",
    ),
    (
        c.HoldOff(gap=0.0, kept=0.0075, holding=True),
        "the gap is 0.00 in; when the step was executed, the gap was 0.30 in, with an object between the fingers",
    ),
    (
        c.HoldOff(gap=0.0, kept=0.0254, holding=False),
        "the gap is 0.00 in; when the step was executed, the gap was 1.00 in",
    ),
    (
        c.MetEarly(fingers=(True, False), gap=1.8 * INCH, kept=1.4 * INCH, holding=True),
        "the +y finger touches an object early, at a gap of 1.80 in; when the step was executed, the fingers "
        "held an object at 1.40 in: the object lies 0.20 in off the centre of the hand",
    ),
    (
        c.MetEarly(fingers=(True, True), gap=1.8 * INCH, kept=1.4 * INCH, holding=True),
        "both fingers touch an object early, at a gap of 1.80 in; when the step was executed, the fingers held "
        "an object at 1.40 in",
    ),
    (
        c.MetEarly(fingers=(False, True), gap=0.5 * INCH, kept=0.0, holding=False),
        "the -y finger touches an object early, at a gap of 0.50 in; when the step was executed, the fingers stood "
        "at 0.00 in",
    ),
    (
        c.ScrewFast(torque=0.5, risen=0.0),
        "the screw does not come out: it has risen by 0.00 in, and the driver's motor gives 71 oz-in",
    ),
    (
        c.ScrewLost(way=0.002, force=6.0),
        "the hand has lost the screw: the hand went down 0.08 in and felt less than 22 oz",
    ),
    (c.BackingOut(), "the step drove a screw out, which cannot be undone"),
    (c.UndoUnknown(), "the record for undoing this step cannot be used"),
]


@pytest.mark.parametrize(("cause", "words"), WORDS)
def test_a_cause_is_put_into_words(cause: c.Cause, words: str) -> None:
    assert cause_sentence(cause) == words


def test_no_kind_of_cause_is_left_out_here() -> None:
    assert {type(cause) for cause, _ in WORDS} == set(get_args(c.Cause))


@pytest.mark.parametrize("cause", [cause for cause, _ in WORDS])
def test_a_cause_goes_to_disk_and_comes_back(cause: c.Cause) -> None:
    assert msgspec.json.decode(msgspec.json.encode(cause), type=c.Cause) == cause
    assert msgspec.msgpack.decode(msgspec.msgpack.encode(cause), type=c.Cause) == cause


@pytest.mark.parametrize("kind", get_args(ReachFailure))
def test_every_reason_has_a_tag_of_its_own(kind: type[ReachFailure]) -> None:
    assert kind.__struct_config__.tag == kind.__name__


@pytest.mark.parametrize("reason", [HeldJoint(2, 0.1), HeldJoint(-1, 0.1), JointLimit(7, math.pi, 1.0)])
def test_a_cause_tells_of_no_joint_that_its_arm_lacks(reason: ReachFailure) -> None:
    with pytest.raises(ValueError, match=r"^the toy arm has 2 joints$"):
        c.BeyondArm(reason=reason, arm=ARM)


def test_an_error_is_told_with_what_led_to_it() -> None:
    meaning = errors.ERRORS[errors.NO_FORCE]
    assert error_sentence(errors.NO_FORCE, None) == meaning
    assert error_sentence(errors.NO_FORCE, c.GuardsUnmet(guards=(GuardKind.FORCE,))) == meaning
    assert error_sentence(errors.SEARCH_EXHAUSTED, c.PlacesTried(places=9)).endswith(" (9 places tried)")
    moved = c.GapTooSmall(gap=0.0, minimum=0.1 * INCH, of="the base")
    assert error_sentence(errors.NOTHING_HELD, moved).endswith(
        "or the object is too thin, or the base has moved (gap 0.00 in, minimum 0.10 in)"
    )


def test_a_call_of_the_operator_is_told_by_its_message_its_error_or_its_cause() -> None:
    assert call_sentence("NO PIN", None, None) == "NO PIN"
    assert call_sentence("", errors.WATCHDOG, None) == errors.ERRORS[errors.WATCHDOG]
    assert call_sentence("", None, c.Looping(place="3")) == "the program loops at line 3 while nothing moves"


def test_an_inspection_without_a_cause_went_well() -> None:
    assert inspection_sentence(None) == "the gasket is in place"
