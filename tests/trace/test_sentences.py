"""Every event can be told in a sentence, in the units of the language."""

import typing

import pytest
from hypothesis import given
from hypothesis import strategies as st

from handeye.core.variation import LARGEST_SEED, Overrides, WorldSpec
from handeye.ports.camera import Renderer
from handeye.program import events as happened
from handeye.program.diagnosis.cause_record import JointName
from handeye.program.diagnosis.causes import ArmNames, BeyondArm
from handeye.program.diagnosis.reach import BelowTable, HeldJoint, JointLimit
from handeye.program.events import CommonEvent, Event
from handeye.trace.sentences import LEVELS, inches, sentence

KINDS = typing.get_args(CommonEvent)
overrides = st.builds(Overrides, without=st.just(("arm",)), set=st.dictionaries(st.text(), st.floats()))
arms = st.builds(ArmNames, joints=st.tuples(*[st.builds(JointName)] * 6))
placed = st.builds(JointLimit, joint=st.integers(0, 5)) | st.builds(HeldJoint, joint=st.integers(0, 5))
st.register_type_strategy(BeyondArm, st.builds(BeyondArm, arm=arms, reason=placed | st.builds(BelowTable)))
st.register_type_strategy(
    WorldSpec, st.builds(WorldSpec, seed=st.integers(0, LARGEST_SEED), overrides=overrides)
)


@pytest.mark.parametrize("kind", KINDS)
@given(data=st.data())
def test_every_event_has_a_sentence(kind: type[Event], data: st.DataObject) -> None:
    assert isinstance(sentence(data.draw(st.from_type(kind))), str)


@pytest.mark.parametrize(
    ("spec", "words"),
    [
        (WorldSpec(seed=3), "seed 3"),
        (WorldSpec(seed=3, level="high"), "seed 3, level high"),
        (
            WorldSpec(seed=3, overrides=Overrides(without=("arm", "camera"), set={"slip": 0.1, "wave": 0.0})),
            "seed 3, without arm, camera, slip, wave set",
        ),
    ],
)
def test_a_world_is_told_by_what_makes_it(spec: WorldSpec, words: str) -> None:
    assert str(spec) == words


def test_only_events_that_there_are_are_logged() -> None:
    assert set(LEVELS) <= set(KINDS)


@pytest.mark.parametrize(
    ("event", "said"),
    [
        (
            happened.RunStarted(
                time=0.0,
                program="first",
                steps=1,
                plan="",
                arm="stanford",
                arm_digest="",
                world=WorldSpec(seed=2),
                camera=Renderer(method="rays"),
                versions={},
            ),
            "first: 1 step on the stanford arm, the world of seed 2, pictures by ray casting",
        ),
        (
            happened.GuardTripped(time=0.0, guard="force", value=17.8, limit=16.680831),
            "stopped: the hand presses with 64.0 ounces, over 60.0",
        ),
        (
            happened.GuardTripped(time=0.0, guard="against", value=17.8, limit=16.680831),
            "stopped: the hand meets 64.0 ounces, over 60.0",
        ),
        (
            happened.GuardTripped(time=0.0, guard="torque", value=0.372432, limit=0.296585),
            "stopped: the driver holds 52.7 ounce-inches, over 42.0",
        ),
        (
            happened.GuardTripped(time=0.0, guard="moment", value=0.372432, limit=0.296585),
            "stopped: the hand turns with 52.7 ounce-inches, over 42.0",
        ),
        (happened.GuardTripped(time=0.0, guard="touch", value=1.0, limit=3.0), "stopped: finger 1 touches"),
        (happened.GuardTripped(time=0.0, guard="touch", value=3.0, limit=3.0), "stopped: both fingers touch"),
        (
            happened.SearchAdvanced(time=0.0, count=2, offset=(0.001778, -0.001778)),
            "the search tries place 3, (0.07, -0.07) in from the first",
        ),
        (
            happened.Restored(time=0.0, name="H", goal="T", difference=(0.0, 0.000127, -0.0000001)),
            "H shifts T by (0.000, 0.005, 0.000) in",
        ),
        (
            happened.PartSeen(time=0.0, part="BASE", x=1.0603406, y=0.7119221, yaw=1.2353517),
            "BASE lies at (41.75, 28.03) in, turned 70.8 degrees",
        ),
        (
            happened.ExperimentMade(
                time=0.0, what="position", name="T", value=(0.0254, 0.0508, 0.0, 0.0, 1.5707963, 0.0)
            ),
            "experiment: position T is set to (1.000, 2.000, 0.000) in, angles 0.0 90.0 0.0",
        ),
        (
            happened.PeriodsCommanded(time=0.0, by="mine.press", periods=()),
            "the controller mine.press commanded 0 servo periods",
        ),
        (
            happened.WentBack(time=0.0, events=12, why="back"),
            "back to event 12: later events are dropped",
        ),
    ],
)
def test_a_sentence_speaks_the_units_of_the_language(event: Event, said: str) -> None:
    assert sentence(event) == said


def test_a_vector_has_no_negative_zero() -> None:
    assert inches((-1e-9, 0.0254, -0.0254)) == "(0.00, 1.00, -1.00) in"
