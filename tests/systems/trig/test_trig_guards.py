"""Guards of the way back: whatever has changed since a step was done stops it, in a sentence, and nothing is lost."""

import numpy as np
import pytest
from fakes import FakeAxes, FakeClock
from trig_bench import Bench, Ticking, low_palletiser
from trig_sessions import Typist

from handeye.core.pose import Array
from handeye.machines.purbrick import PURBRICK
from handeye.ports.axes import AxesReading
from handeye.systems.trig.language.axes_arm import AxesArm
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.trig_arm import (
    HoldOff,
    LeftBehind,
    MissingContact,
    MissingSupport,
    Obstacle,
    Resistance,
)
from handeye.systems.trig.language.trig_arm import told_obstacle as told
from handeye.touch.senses import as_before

AT_A_BLOCK = (
    "* STACK 2 X 100 Y 0\nGOGRASP\nM OVER\nX 100 Z 60 RECORD\nMG ON\nZ 2 RECORD\n2\n(0 0 1)\nGOPOS OVER\n"
)
GRASPED = "* STACK 2 X 100 Y 0\nM AT\nX 100 Z 18 RECORD\nGRASP\nMR UP\nZ BY 20 RECORD\nUNGRASP\n"


def stopped(typist: Typist, line: str) -> Obstacle | None:
    """What a run backwards has met, on the step that it leaves the cursor on."""
    count = -int(line.split()[1])
    ran = typist.session.runner.back(count)
    assert ran.end == ("stopped" if ran.obstacle else "count" if ran.steps == count else "beginning")
    return ran.obstacle


def test_a_block_that_was_taken_away_is_missed_by_the_fingers_and_what_was_right_can_go_on() -> None:
    typist = Typist(GRASPED)
    typist.type("* CLEAR")
    assert stopped(typist, "RUN -4") == HoldOff(gap=0.0, kept=0.03)
    assert (typist.active.type, len(typist.session.program.trail)) == ("ungrasp", 4)
    typist.type("GOUNGRASP\n* STACK 4 X 100 Y 0")
    assert stopped(typist, "RUN -4") is None


def test_a_block_that_has_fallen_out_of_the_hand_is_missed_before_it_opens() -> None:
    typist = Typist(GRASPED.replace("UNGRASP\n", ""))
    typist.type("GOUNGRASP")
    assert stopped(typist, "RUN -3") == HoldOff(gap=0.048, kept=0.03)
    assert typist.active.type == "grasp"


def test_what_a_guarded_step_has_met_must_still_be_there() -> None:
    typist = Typist(AT_A_BLOCK + "GOTO **TOP**\nRUN")
    typist.type("* CLEAR\nRUN -2")
    assert typist.told[-1] == (
        "0 steps undone; the arm stopped while undoing the next earlier step: on the way forward the finger met "
        "an object here, but now the finger meets nothing"
    )
    assert stopped(typist, "RUN -2") == MissingContact()
    typist.type("* STACK 2 X 100 Y 0")
    typist.type("RUN -2")
    assert typist.told[-1].startswith("2 steps undone")


class Hindered(FakeAxes):
    """Axes that are pushed, or held fast, at a place."""

    push, fast = 0.0, False

    def read(self) -> AxesReading:
        away = bool(np.any(self.goal[:-1]))
        self.felt = {"force_x": self.push * away, "force_y": 0.0, "force_z": 0.0}
        return super().read()

    def put(self, goal: Array) -> None:
        super().put(goal)
        self.elapse(0.0 if self.fast else self.period)


def test_a_force_on_the_finger_stops_the_way_back_whatever_its_direction() -> None:
    axes = Hindered(FakeClock(), *PURBRICK.specs)
    arm = AxesArm(axes, Ticking(), PURBRICK.limits)
    axes.push = PURBRICK.limits.resistance + 0.1
    met = arm.back(Place(x=0.05), lambda: False)
    assert met == Resistance(force=PURBRICK.limits.resistance + 0.1, limit=PURBRICK.limits.resistance)
    assert arm.here().x < 0.001
    assert told(met) == "the finger met a force of 3.1 N; the limit while going back is 3.0 N"
    axes.push = PURBRICK.limits.resistance - 0.1
    assert arm.back(Place(y=0.05), lambda: False) is None


@pytest.mark.parametrize(("push", "limit"), [(3.6, None), (5.5, 5.4)])
def test_half_as_much_again_as_a_move_met_is_no_obstacle_where_it_is_undone(
    push: float, limit: float | None
) -> None:
    axes = Hindered(FakeClock(), *PURBRICK.specs)
    arm = AxesArm(axes, Ticking(), PURBRICK.limits)
    axes.push = 3.6
    assert arm.go(Place(x=0.05), lambda: False)
    assert arm.met == pytest.approx(3.6)
    axes = Hindered(FakeClock(), *PURBRICK.specs)
    back, axes.push = AxesArm(axes, Ticking(), PURBRICK.limits), push
    found = back.back(Place(x=0.05), lambda: False, arm.met)
    assert found == (None if limit is None else Resistance(force=push, limit=limit))


def test_an_axis_that_does_not_follow_stops_the_way_back() -> None:
    axes = Hindered(FakeClock(), *PURBRICK.specs)
    arm = AxesArm(axes, Ticking(), PURBRICK.limits)
    axes.fast = True
    met = arm.back(Place(y=0.05), lambda: False)
    assert isinstance(met, LeftBehind)
    assert (met.axis, met.off < 0.01) == (1, True)
    assert told(met).startswith("Y is ")
    assert arm.here().y == 0.0


def test_what_is_held_is_not_let_go_where_there_is_nothing_to_set_it_down_on() -> None:
    bench = Bench(low_palletiser(2))
    bench.type("GOTO **TOP**\nRUN 13")  # the upper block is on the pallet, and the hand above it
    bench.table.bench.data.joint("block_1").qpos[1] += 0.1
    bench.type("RUN -1000")
    assert bench.told[-1] == (
        f"4 steps undone; the arm stopped while undoing the next earlier step: {told(MissingSupport())}"
    )
    assert bench.arm.closed
    assert bench.blocks[1][2] == pytest.approx(24 - 2, abs=0.3)  # 2 mm lower than it lay, and held
    assert bench.blocks[0] == pytest.approx((60, 100, 12), abs=0.1)


@pytest.mark.parametrize(("gap", "same"), [(0.0304, True), (0.0306, False), (0.0291, True), (0.0289, False)])
def test_fingers_hold_as_much_as_before_if_they_are_nearly_as_far_apart(gap: float, same: bool) -> None:
    assert as_before(gap, 0.030) is same
