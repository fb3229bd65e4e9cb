"""TRIG with an arm that has mass, and blocks that fall: what needs physics."""

import numpy as np
import pytest
from fakes import FakeAxes, FakeClock
from trig_bench import Bench, Ticking, taught
from trig_sessions import BUCKET, PALLETISE

from handeye.core.units import OUNCE_FORCE
from handeye.machines.purbrick import PURBRICK
from handeye.ports.axes import AxesReading
from handeye.systems.trig.language.axes_arm import AxesArm
from handeye.systems.trig.language.place import Place

pytestmark = pytest.mark.slow


def near(place: tuple[float, ...], within: float = 3.0) -> object:
    """A place, to a distance in mm along each axis."""
    return pytest.approx(place, abs=within)


@pytest.mark.trig_row(5)
def test_one_block_falls_into_the_bucket_and_the_other_lies_where_it_was() -> None:
    bench = taught(BUCKET, "* STACK 1 X -120 Y 60\n* STACK 1 X -120 Y -60\n* BUCKET X 140 Y 0")
    bench.type("RUN")
    a, b = bench.blocks
    assert a == near((140, 0, 12), 10)
    assert b == near((-120, 60, 12))
    assert bench.at == near((0, 0, 150), 0.5)
    bench.type("RUN -1000")
    told = "5 steps undone; the arm stopped while undoing the next earlier step: the fingers are 0.0 mm apart; on"
    assert bench.told[-1].startswith(told)
    a, b = bench.blocks
    assert a == near((140, 0, 12), 10)  # what was dropped stays there
    assert b == near((-120, -60, 12))


class Pressed(FakeAxes):
    """Axes whose finger is pressed upwards as soon as they leave their zero, and whose gauge has a bias."""

    force, bias = 0.0, 0.0
    """N"""

    def read(self) -> AxesReading:
        self.felt = {
            "force_x": 0.0,
            "force_y": 0.0,
            "force_z": self.bias - self.force * bool(np.any(self.goal[:-1])),
        }
        return super().read()


@pytest.mark.trig_row(12)
@pytest.mark.parametrize(
    ("ounces", "weight", "kind"),
    [
        (2.0, 1, "reached"),
        (2.01, 1, "tripped"),
        (1.0, 2, "reached"),
        (1.01, 2, "tripped"),
        (2.01, -1, "reached"),
    ],
)
def test_a_guarded_move_stops_beyond_its_threshold_and_not_at_it(
    ounces: float, weight: float, kind: str
) -> None:
    axes = Pressed(FakeClock(), *PURBRICK.specs)
    arm = AxesArm(axes, Ticking(), PURBRICK.limits)
    axes.force = ounces * OUNCE_FORCE
    arrival = arm.feel(Place(x=0.003), (0, 0, weight), 2 * OUNCE_FORCE, lambda: False)
    assert arrival.kind == kind


@pytest.mark.parametrize(("ounces", "kind"), [(1.9, "reached"), (2.1, "tripped")])
def test_what_the_finger_tells_when_nothing_touches_it_is_no_force(ounces: float, kind: str) -> None:
    axes = Pressed(FakeClock(), *PURBRICK.specs)
    axes.bias, axes.force = 3.0, ounces * OUNCE_FORCE
    arm = AxesArm(axes, Ticking(), PURBRICK.limits)
    assert arm.feel(Place(x=0.003), (0, 0, 1), 2 * OUNCE_FORCE, lambda: False).kind == kind


@pytest.mark.trig_row(13)
def test_a_guarded_move_in_free_air_is_slow_and_straight(monkeypatch: pytest.MonkeyPatch) -> None:
    bench = Bench()
    seen: list[np.ndarray] = []
    advance = bench.table.bench.advance

    def watched(seconds: float) -> None:
        advance(seconds)
        seen.append(bench.arm._axes.read().q[:3])

    monkeypatch.setattr(bench.table.bench, "advance", watched)
    goal = Place(x=0.02, y=-0.01, z=0.27)
    assert bench.arm.feel(goal, (0, 0, 1), 2 * OUNCE_FORCE, lambda: False).kind == "reached"
    way = np.array(seen)
    speeds = np.abs(np.diff(way, axis=0)) / bench.arm._axes.period
    assert np.max(speeds) < 1.1 * PURBRICK.limits.guarded_speed[0]
    along = np.array(goal[:3]) - way[0]
    along /= np.linalg.norm(along)
    off = (way - way[0]) - np.outer((way - way[0]) @ along, along)
    assert np.max(np.linalg.norm(off, axis=1)) < 0.001
    assert bench.at == near((20, -10, 270), 0.5)


GUARDED_MOVE = "M UP\nX 0 Y 0 Z 60 RECORD\nMG DOWN\nZ 2 RECORD\n2\n(0 0 1)\nGOPOS UP\n* STACK 2 X 0 Y 0\n"


@pytest.mark.trig_row(14)
def test_a_force_where_there_is_no_guarded_son_ends_the_program() -> None:
    bench = Bench(f"{GUARDED_MOVE}GOGRASP\nRUN")
    assert bench.told[-1] == "2 steps done; the program has ended"
    assert bench.session.program.active.type == "guarded"
    assert bench.at == near((0, 0, 24), 1.0)


LOW = PALLETISE[: PALLETISE.index("* STACK")].replace("Z 260", "Z 50") + "* STACK 2 X 150 Y 0\n"
"""The palletiser as far as line 7, with the arm no higher than it takes two blocks."""


@pytest.mark.trig_row(30)
def test_gopos_and_run_1_touch_the_block() -> None:
    bench = Bench(f"{LOW}GOPOS STACK\nP\nRUN 1")
    assert bench.session.program.active.type == "guarded"
    assert bench.at == near((150, 0, 24), 1.0)


@pytest.mark.trig_row(31)
@pytest.mark.parametrize(
    ("lines", "height"), [("RUN -2\n* STACK 2 X 150 Y 0\nRUN 2", 24), ("RUN -1\nRUN 1", 2)]
)
def test_undoing_two_steps_touches_the_block_from_above_and_one_does_not(lines: str, height: float) -> None:
    """Undoing FINISH takes the arm to the bottom, so the blocks come behind that, and with one step never."""
    bench = Bench(LOW.replace("* STACK 2 X 150 Y 0\n", "") + lines)
    assert bench.session.program.active.type == "guarded"
    assert bench.at == near((150, 0, height), 1.0)


@pytest.mark.trig_row(37)
def test_a_relative_loop_comes_back_within_half_a_millimetre() -> None:
    bench = Bench("MR DX\nX BY 20 RECORD\nCN A\nLOOP A 4\nFREE\nX 0 RECORD\nRUN")
    assert bench.at == near((100, 0, 300), 0.5)
    bench.type("RUN -1000")
    assert bench.at == near((0, 0, 300), 0.5)


@pytest.mark.trig_row(38)
def test_a_key_in_mid_move_stops_the_arm_and_a_run_goes_on_or_back() -> None:
    bench = Bench("M A\nX 0 RECORD\nM B\nX 100 RECORD\nCN B\nGOPOS A\n")
    periods = 0

    def struck() -> bool:
        nonlocal periods
        periods += 1
        return periods == 60

    bench.halted = struck
    bench.type("RUN")
    assert bench.session.program.active.name == "B"
    stopped = bench.at[0]
    assert 5 < stopped < 95
    bench.table.bench.advance(0.5)
    assert bench.at[0] == pytest.approx(stopped, abs=0.5)
    bench.type("RUN 1")
    assert bench.at == near((100, 0, 300), 0.5)
    bench.type("RUN -1000")
    assert bench.at == near((0, 0, 300), 0.5)
