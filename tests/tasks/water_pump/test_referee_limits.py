"""Each finding of the referee fails just over its limit and is right just under it.

A right finished pump is spoilt as little as a finding needs: parts are moved in the simulator's state until the
quantity that it measures has a given value. The referee looks at once, so that nothing falls back into its place.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Final

import msgspec
import mujoco
import numpy as np
import pytest
from finished import put, rested
from planted import figure, number, open_bond, pushed, state

from handeye.cell.threads import ThreadsState, holes_of
from handeye.cell.truth import Truth
from handeye.core.pose import Array, Pose, inverse, planar, pose, rotation_x, translated
from handeye.core.resources import scenes
from handeye.core.units import DEGREE
from handeye.judge.finding import Findings
from handeye.judge.measured import SettledState
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions
from handeye.tasks.water_pump.referee import limits, measure
from handeye.tasks.water_pump.referee.findings import judge, judge_apart
from handeye.tasks.water_pump.referee.measure import head_force

pytestmark = pytest.mark.slow

MM: Final = 1e-3
PUMP: Final = ("base", "gasket", "top")
NEAR: Final = 0.02
"""How near to its limit a quantity is brought on both sides, as a share of the limit."""


@pytest.fixture
def pump() -> Truth:
    """A finished pump that has come to rest."""
    return rested()


@pytest.fixture
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The referee lets no time pass, neither for parts to come to rest nor for the rotor to turn."""
    rested()
    monkeypatch.setattr(limits, "SETTLE", 0.0)
    monkeypatch.setattr(measure, "rotor_torque", lambda _: 0.0)


def wrong(findings: Findings) -> set[str]:
    return {name for name, finding in findings.items() if not finding.ok}


# -- moving parts -----------------------------------------------------------------------------------


def lie(truth: Truth, part: str) -> Pose:
    """`X_WP` of a part."""
    body = truth.data.body(part)
    return pose(body.xmat.reshape(3, 3).copy(), body.xpos.copy())


def first(truth: Truth, part: str) -> Array:
    """Where a part was before anything happened (m), shape (3,)."""
    data = mujoco.MjData(truth.model)
    mujoco.mj_kinematics(truth.model, data)
    return np.array(data.body(part).xpos)


def shift(truth: Truth, parts: tuple[str, ...], *by: float) -> None:
    """Move parts in W (m)."""
    for part in parts:
        put(truth, part, translated(lie(truth, part), by))


def swing(truth: Truth, parts: tuple[str, ...], R: Array) -> None:
    """Turn parts as one about the origin of the first."""
    about = pose(np.eye(3), lie(truth, parts[0])[:3, 3])
    turn = about @ pose(R, (0.0, 0.0, 0.0)) @ inverse(about)
    for part in parts:
        put(truth, part, turn @ lie(truth, part))


def gap(truth: Truth, side: str) -> float:
    """Between the base and a block, m; negative where they overlap."""
    return SettledState(truth).gap("plate", f"block_{side}")


def draw_screw(truth: Truth, hole: int, way: float) -> None:
    """Turn a screw out by a way (m)."""
    slide, turn = (int(truth.model.joint(f"thread_{kind}{hole}").qposadr[0]) for kind in ("slide", "turn"))
    truth.data.qpos[slide] += way
    truth.data.qpos[turn] += way * 2 * np.pi / dimensions()("screw.pitch")
    mujoco.mj_forward(truth.model, truth.data)


# -- one spoiling a finding: the quantity gets a value (mm, deg, N) -------------------------------


def base_gaps(truth: Truth, far: float, left: float) -> None:
    """Give the gaps between base and blocks these widths, mm."""
    shift(truth, PUMP, left * MM - gap(truth, "left"), gap(truth, "far") - far * MM, 0.0)


def base_yaw(truth: Truth, value: float) -> None:
    swing(truth, PUMP, planar(0.0, 0.0, 0.0, value * DEGREE)[:3, :3])
    base_gaps(truth, 0.1, 0.1)


def base_height(truth: Truth, value: float) -> None:
    shift(truth, PUMP, 0.0, 0.0, value * MM - lie(truth, "base")[2, 3])


def base_tilt(truth: Truth, value: float) -> None:
    """On an edge, and as high as a base may be."""
    swing(truth, PUMP, rotation_x(value * DEGREE))
    base_height(truth, 0.45)


def layer_height(truth: Truth, value: float, *, part: str) -> None:
    nominal = base_top() + (dimensions()("gasket.thickness") if part == "top" else 0.0)
    put(truth, part, lie(truth, "base") @ planar(0.0, 0.0, nominal + value * MM, 0.0))


def layer_place(truth: Truth, value: float, *, part: str) -> None:
    """Aside, towards an edge between two wedges of its bores, where a shank cuts in least."""
    X_WB = lie(truth, "base")
    height = (inverse(X_WB) @ lie(truth, part))[2, 3]
    edge = np.pi / 12
    put(truth, part, X_WB @ planar(value * MM * np.cos(edge), value * MM * np.sin(edge), height, 0.0))


def over_its_place(truth: Truth, value: float, *, part: str) -> None:
    put(truth, part, translated(pose(np.eye(3), first(truth, part)), (0.0, 0.0, value * MM)))


def leaning(truth: Truth, value: float, *, part: str) -> None:
    swing(truth, (part,), rotation_x(value * DEGREE))


def beneath(truth: Truth, value: float) -> None:
    """A pin beside the table."""
    put(truth, "pin0", planar(-0.2, 0.5, value * MM, 0.0))


def stray_screw(truth: Truth, value: float) -> Truth:
    """A screw that is in no thread, over its place in the dispenser."""
    over_its_place(truth, value, part="screw0")
    return thread(truth, screw=None)


def screw_height(truth: Truth, value: float) -> None:
    draw_screw(truth, 2, 0.15 * MM)  # farther than any head is pressed in
    draw_screw(truth, 2, (value - judge(truth)["screws_depth"].value) * MM)


def screw_thread(truth: Truth, value: float) -> None:
    draw_screw(truth, 2, measure.thread_length(SettledState(truth), 2) - value * MM)


def screw_lean(truth: Truth, value: float) -> None:
    """Leaning, and drawn out until the head's lower edge is where it was."""
    draw_screw(truth, 2, dimensions()("screw.head_radius") * value * DEGREE)
    carrier = truth.model.body("carrier2").id
    mujoco.mju_mat2Quat(truth.model.body_quat[carrier], rotation_x(value * DEGREE).ravel())
    mujoco.mj_forward(truth.model, truth.data)


def screw_aside(truth: Truth, value: float) -> None:
    """In a thread that was cut beside its hole."""
    truth.model.body("carrier2").pos[0] += value * MM
    mujoco.mj_forward(truth.model, truth.data)


def pin_in_wall(truth: Truth, value: float) -> None:
    """Drawn up out of the chamfer, and pushed into the side of the holder's bore."""
    play = dimensions()("pin_holder.hole_radius") - dimensions()("pin.nose_radius")
    put(truth, "pin0", translated(pose(np.eye(3), first(truth, "pin0")), (play + value * MM, 0.0, 0.001)))


def under_the_hand(truth: Truth, value: float) -> None:
    """A pin that stands in the air."""
    tool = truth.data.site("stanford/tool").xpos
    put(truth, "pin0", pose(np.eye(3), tool - [0.0, 0.0, 0.07]))
    for _ in range(5):  # the fingers are beside the line on which it moves
        shift(truth, ("pin0",), 0.0, 0.0, (judge(truth)["hand"].value - value) * MM)


def clamp(truth: Truth, value: float, *, hole: int = 2, low: float = 0.0) -> None:
    """Turn a screw out, from `low` (mm) on, until it clamps with a force, N."""
    low, high = low * MM, 0.1 * MM
    start = truth.data.qpos.copy()
    for _ in range(20):
        way = (low + high) / 2
        truth.data.qpos[:] = start
        draw_screw(truth, hole, way)
        low, high = (way, high) if head_force(SettledState(truth), hole) > value else (low, way)


def screw_short(truth: Truth, value: float) -> None:
    """The radius of a screw's shank off."""
    truth.model.geom("shank2").size[0] -= value * MM


def turned_home(truth: Truth, value: float) -> Truth:
    """A screw whose head pressed so much when it was last turned."""
    return thread(truth, clamp=value)


def held_back(truth: Truth, value: float) -> None:
    """A thread that rubs so little that a torque turns its screw back, N m."""
    friction = value - measure.loosening_torque(SettledState(truth), 2)
    truth.model.dof_frictionloss[truth.model.joint("thread_turn2").dofadr[0]] += friction


def rotor_aside(truth: Truth, value: float) -> None:
    truth.model.body("rotor").pos[0] += value * MM
    mujoco.mj_forward(truth.model, truth.data)


def rotor_lean(truth: Truth, value: float) -> None:
    rotor = truth.model.body("rotor").id
    mujoco.mju_mat2Quat(truth.model.body_quat[rotor], rotation_x(value * DEGREE).ravel())
    mujoco.mj_forward(truth.model, truth.data)


def off_the_tray(truth: Truth, value: float) -> None:
    at = truth.data.site("park3").xpos
    put(truth, "screw3", pose(np.eye(3), at + np.array([0.0, 0.0, value * MM])))


def going(truth: Truth, value: float, *, joint: str, body: str) -> None:
    """A joint that turns so fast that a point of its body goes at a speed, mm/s."""
    dof, number = truth.model.joint(joint).dofadr[0], truth.model.body(body).id
    truth.data.qvel[:], truth.data.qvel[dof] = 0.0, 1e-3
    mujoco.mj_forward(truth.model, truth.data)
    truth.data.qvel[dof] *= value * MM / SettledState(truth).speed(number)
    mujoco.mj_forward(truth.model, truth.data)


def thread(truth: Truth, **changed: object) -> Truth:
    """The truth with another first thread."""
    one, *others = holes_of(truth)
    holes = (msgspec.structs.replace(one, **changed), *others)
    return replace(truth, states={**truth.states, "threads": ThreadsState(holes=holes, driven=0)})


@dataclass(frozen=True, kw_only=True)
class Spoiling:
    """How a finding is made to fail."""

    limit: float
    """As it is meant to be, in the finding's unit."""
    by: Callable[[Truth, float], Truth | None]
    """Gives the quantity a value; a truth that is more than a state moved comes back."""
    also: frozenset[str] = frozenset()
    """Other findings that fail with it, on both sides of the limit: what cannot be parted from it."""
    sign: int = 1
    """-1 where less is wrong."""


ALTERED = frozenset({"as_drawn"})
"""What no cell can do is not as drawn either."""
PRESSED = frozenset({"screws_clamp"})
"""A layer out of its place is clamped otherwise."""
PRESSED_IN = PRESSED | {"overlap"}
"""... or is where its neighbours are."""
SPOILT: Final = {
    "base_far": Spoiling(limit=1.27, by=lambda truth, value: base_gaps(truth, value, 0.1)),
    "base_left": Spoiling(limit=1.27, by=lambda truth, value: base_gaps(truth, 0.1, value)),
    "base_yaw": Spoiling(limit=1.0, by=base_yaw),
    "base_height": Spoiling(limit=0.5, by=base_height),
    "base_tilt": Spoiling(limit=0.3, by=base_tilt),
    "gasket_height": Spoiling(limit=0.3, by=partial(layer_height, part="gasket"), also=PRESSED_IN),
    "gasket_place": Spoiling(limit=0.949, by=partial(layer_place, part="gasket")),
    "top_height": Spoiling(limit=0.3, by=partial(layer_height, part="top"), also=PRESSED_IN | {"screws_depth"}),
    "top_place": Spoiling(limit=0.752, by=partial(layer_place, part="top")),
    "screws_depth": Spoiling(limit=0.2, by=screw_height, also=PRESSED),
    "screws_thread": Spoiling(limit=6.35, by=screw_thread, also=PRESSED | {"screws_depth"}, sign=-1),
    "screws_place": Spoiling(limit=0.12, by=screw_aside),
    "screws_lean": Spoiling(limit=1.0, by=screw_lean),
    "screws_clamp": Spoiling(limit=40.0, by=clamp, sign=-1),
    "pins": Spoiling(limit=3.0, by=partial(over_its_place, part="pin0")),
    "pins_tilt": Spoiling(limit=10.0, by=partial(leaning, part="pin0"), also=frozenset({"overlap_bores"})),
    "rack": Spoiling(limit=3.0, by=partial(over_its_place, part="driver")),
    "rack_tilt": Spoiling(limit=5.0, by=partial(leaning, part="driver"), also=frozenset({"overlap"})),
    "dispenser": Spoiling(limit=3.0, by=stray_screw, also=frozenset({"screws", "as_drawn"})),
    "floor": Spoiling(limit=-5.0, by=beneath, also=frozenset({"pins"}), sign=-1),
    "hand": Spoiling(limit=25.0, by=under_the_hand, also=frozenset({"pins"}), sign=-1),
    "overlap_bores": Spoiling(limit=0.03, by=pin_in_wall),
    "screws_size": Spoiling(limit=0.35, by=screw_short, also=ALTERED),
    "screws_strain": Spoiling(limit=420.0, by=partial(clamp, hole=1, low=-0.1), also=PRESSED),
    "screws_turned": Spoiling(limit=400.0, by=turned_home),
    "screws_hold": Spoiling(limit=0.02, by=held_back, sign=-1),
    "rotor_place": Spoiling(limit=0.1, by=rotor_aside, also=ALTERED),
    "rotor_lean": Spoiling(limit=0.1, by=rotor_lean, also=ALTERED),
    "tray": Spoiling(limit=3.0, by=off_the_tray),
    "still": Spoiling(limit=1.0, by=partial(going, joint="rotor", body="rotor")),
    "arm_still": Spoiling(limit=1.0, by=partial(going, joint="stanford/j6", body="stanford/link6")),
    "overlap": Spoiling(limit=0.15, by=lambda truth, value: base_height(truth, -value)),
}  # fmt: skip
ABSOLUTE: Final = {
    "as_drawn": figure("body_mass", "top", 0.1), "bonds": open_bond, "held": pushed("top", 1e-3),
    "motor": state("screwdriver", command=1e-3), "numbers": number("time", np.nan),
}  # fmt: skip
"""Findings whose limit is zero: the least that is wrong."""
COUNTED: Final = {
    "screws": {"screw": None}, "screws_crossed": {"crossed": True}, "threads_scarred": {"scarred": True},
}  # fmt: skip
"""Findings that are counts: how the first of six threads is made wrong."""


@pytest.mark.parametrize("side", ["just over", "just under"])
@pytest.mark.parametrize("name", SPOILT)
@pytest.mark.usefixtures("at_once")
def test_a_finding_fails_just_over_its_limit_and_not_just_under_it(pump: Truth, name: str, side: str) -> None:
    spoiling, over = SPOILT[name], side == "just over"
    value = spoiling.limit + spoiling.sign * (NEAR if over else -NEAR) * abs(spoiling.limit)
    findings = judge(spoiling.by(pump, value) or pump)
    assert findings[name].value == pytest.approx(value, rel=0.8 * NEAR)
    assert findings[name].limit == spoiling.limit
    assert wrong(findings) == spoiling.also | ({name} if over else set())


@pytest.mark.parametrize("name", COUNTED)
@pytest.mark.usefixtures("at_once")
def test_one_wrong_screw_of_six_is_found(pump: Truth, name: str) -> None:
    findings = judge(thread(pump, **COUNTED[name]))
    assert name in wrong(findings)
    assert findings[name].value == {"screws": 5, "screws_crossed": 1, "threads_scarred": 1}[name]


@pytest.mark.parametrize("name", ABSOLUTE)
@pytest.mark.usefixtures("at_once")
def test_what_may_not_be_at_all_is_found(pump: Truth, name: str) -> None:
    assert wrong(judge(ABSOLUTE[name](pump))) - PRESSED == {name}


@pytest.mark.parametrize(("height", "right"), [(0.22, True), (0.3, False)])
def test_what_hangs_is_found_by_how_far_it_falls(pump: Truth, height: float, right: bool) -> None:
    shift(pump, ("pin1",), 0.0, 0.0, height * MM)
    assert judge(pump)["rest"].ok == right


@pytest.mark.parametrize(("friction", "right"), [(0.08, True), (0.1, False)])
def test_the_rotor_is_right_if_it_turns_before_its_limit(pump: Truth, friction: float, right: bool) -> None:
    pump.model.dof_frictionloss[pump.model.joint("rotor").dofadr[0]] = friction
    rotor = judge(pump)["rotor"]
    assert (rotor.ok, rotor.limit) == (right, 0.1)


@pytest.mark.usefixtures("at_once")
def test_every_finding_there_is_has_been_made_to_fail(pump: Truth) -> None:
    assert set(judge(pump)) == {*SPOILT, *COUNTED, *ABSOLUTE, "rotor", "rest"}


@pytest.mark.usefixtures("at_once")
def test_the_page_of_the_scene_tells_of_every_finding(pump: Truth) -> None:
    page = (scenes() / "water_pump" / "README.md").read_text(encoding="utf-8")
    assert {name for name in {**judge(pump), **judge_apart(pump)} if f"`{name}`" not in page} == set()


@pytest.mark.usefixtures("at_once")
def test_nothing_is_wrong_before_anything_is_spoilt(pump: Truth) -> None:
    assert wrong(judge(pump)) == set()
