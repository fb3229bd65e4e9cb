"""TRIG with an arm that has mass, and blocks that fall: what needs physics."""

from collections.abc import Callable

import numpy as np
import pytest
from fakes import FakeAxes, FakeClock
from trig_sessions import BUCKET, PALLETISE, typed

from handeye.ports.axes import AxesReading
from handeye.ports.clock import Clock
from handeye.tasks.blocks.bench import purbrick
from handeye.tasks.blocks.machine import SPECS
from handeye.trig.axes_arm import GUARDED, AxesArm
from handeye.trig.hearing import hear
from handeye.trig.place import Place
from handeye.trig.script import Script
from handeye.trig.session import Session
from handeye.units import OUNCE_FORCE

pytestmark = pytest.mark.slow


class Bench:
    """A session with the Purbrick arm."""

    def __init__(self, text: str = "") -> None:
        self.arm, self.table = purbrick()
        self.told: list[str] = []
        self.session = Session(arm=self.arm, table=self.table, desk=Script(()))
        self.halted: Callable[[], bool] = lambda: False
        self.type(text)

    def type(self, text: str) -> None:
        """Type lines."""
        script = Script(text.splitlines(), self.told.append, lambda: self.halted())
        self.session.desk = script
        while (line := script.next_line()) is not None:
            hear(self.session, line)

    @property
    def at(self) -> tuple[float, ...]:
        """Where the arm really is, mm."""
        return tuple(1000 * value for value in self.arm._axes.read().q[:3])

    @property
    def blocks(self) -> list[tuple[float, ...]]:
        """Where the blocks are, mm."""
        return [tuple(1000 * value for value in at) for at in self.table.tops().values()]


def near(place: tuple[float, ...], within: float = 3.0) -> object:
    """A place, to a distance in mm along each axis."""
    return pytest.approx(place, abs=within)


def taught(text: str, table: str) -> Bench:
    """A bench with a program that was taught to an arm without physics, the table laid as before it was taught."""
    bench = Bench()
    bench.session.program = typed(text).program
    bench.type(f"* CLEAR\n{table}\nGOPOS CENTER")
    return bench


@pytest.mark.trig_row(5)
def test_one_block_falls_into_the_bucket_and_the_other_lies_where_it_was() -> None:
    bench = taught(BUCKET, "* STACK 1 X -120 Y 60\n* STACK 1 X -120 Y -60\n* BUCKET X 140 Y 0")
    bench.type("RUN")
    a, b = bench.blocks
    assert a == near((140, 0, 12), 10)
    assert b == near((-120, 60, 12))
    assert bench.at == near((0, 0, 150), 0.5)
    bench.type("RUN -1000")
    a, b = bench.blocks
    assert a == near((140, 0, 12), 10)  # what was dropped stays there
    assert b == near((-120, -60, 12))


class Ticking(Clock):
    """A clock that lets any time pass."""

    now = 0.0

    def advance(self, seconds: float) -> None:
        self.now += seconds


class Pressed(FakeAxes):
    """Axes whose finger is pressed upwards as soon as they leave their zero, and whose gauge has a bias."""

    force, bias = 0.0, 0.0
    """N"""

    def read(self) -> AxesReading:
        self.channels = {
            "force_x": 0.0,
            "force_y": 0.0,
            "force_z": self.bias - self.force * bool(np.any(self.goal)),
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
    axes = Pressed(FakeClock(), *SPECS)
    arm = AxesArm(axes, Ticking())
    axes.force = ounces * OUNCE_FORCE
    arrival = arm.feel(Place(x=0.003), (0, 0, weight), 2 * OUNCE_FORCE, lambda: False)
    assert arrival.kind == kind


@pytest.mark.parametrize(("ounces", "kind"), [(1.9, "reached"), (2.1, "tripped")])
def test_what_the_finger_tells_when_nothing_touches_it_is_no_force(ounces: float, kind: str) -> None:
    axes = Pressed(FakeClock(), *SPECS)
    axes.bias, axes.force = 3.0, ounces * OUNCE_FORCE
    arm = AxesArm(axes, Ticking())
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
    assert np.max(speeds) < 1.1 * GUARDED[0]
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


def test_two_blocks_are_put_on_a_pallet_and_back_on_their_stack() -> None:
    low = PALLETISE.replace("Z 260", "Z 45").replace("Z 270 X", "Z 55 X").replace("Z 270", "Z 60")
    bench = taught(low.replace("STACK 20", "STACK 2"), "* STACK 2 X 150 Y 0")
    before = bench.blocks
    bench.type("RUN")
    assert sorted(bench.blocks) == [near((-50, -90, 12)), near((0, -90, 12))]
    assert bench.session.program.active.name == "FINISH"
    bench.type("RUN -1000")
    assert bench.blocks == [near(place) for place in before]
