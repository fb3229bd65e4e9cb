"""The fuse of the work table: an interlock that opens under a load."""

import pytest
from station_bench import Arm

from handeye.systems.ml.bench.station import FUSE
from handeye.systems.ml.errors import MlError


@pytest.mark.slow
@pytest.mark.ml_row(55)
def test_a_load_of_200_newtons_on_the_table_opens_its_fuse_and_stops_the_arm() -> None:
    arm, loads = Arm(), [0.0]
    arm.station.bench.after_step.append(lambda: loads.append(float(arm.data.sensor("table_1").data[0])))
    arm.level.statement(288)
    assert arm.go(m2=10_000) == "emergency"
    arm.cycles(30)
    assert FUSE < max(loads) < 1.5 * FUSE
    assert loads[-1] == 0.0  # relaxed, the arm no longer presses
    assert [arm.level.read("EM", 1, word) for word in (2, 3)] == [3, 288]
    assert arm.level.stopped == "the fuse of work table 1 has blown"
    with pytest.raises(MlError, match=r"^M14: the pump stays off: the fuse of work table 1 has blown$"):
        arm.level.enable()
    arm.station.arm.signal("table_1", on=False)
    arm.level.enable()


@pytest.mark.slow
@pytest.mark.ml_row(55)
def test_a_force_that_the_fingers_may_press_with_leaves_the_fuse_closed() -> None:
    arm = Arm()
    arm.level.expect(4, -1000, 1000)
    arm.level.write("MT", 2, 8, 10)
    assert arm.go(m2=10_000) == "force"
    assert arm.level.enabled
