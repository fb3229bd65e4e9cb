"""Pumps planted for the referee: wrong ones, each wrong in one way, and right ones as different as they may be.

A finished pump is changed in the simulator's state; no run is needed.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import msgspec
import mujoco
import numpy as np
from finished import finished_cell, put

from handeye.arm.ik import solve
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.threads import ThreadsState, holes_of
from handeye.cell.truth import Truth
from handeye.core.pose import Pose, hand, inverse, planar, pose, rotation, rotation_x, translated
from handeye.core.units import DEGREE
from handeye.tasks.stanford_cell.dimensions import PARK, dimensions, screw_holes, standard
from handeye.tasks.water_pump.clamping import WELDS, Clamping, ClampingState, lands_of

MM = 1e-3
PUMP = ("base", "gasket", "top")
Planting = Callable[[Truth], Truth]


def lie(truth: Truth, body: str) -> Pose:
    """`X_WP` of a part."""
    found = truth.data.body(body)
    return pose(found.xmat.reshape(3, 3).copy(), found.xpos.copy())


def clearance(layer: str) -> float:
    """Of a screw in its hole in a layer, m."""
    return dimensions()(f"{layer}.screw_hole_radius") - dimensions()("screw.shank_radius")


# -- one change a function: everything in m and rad ------------------------------------------------


def shifted(*parts: str, by: tuple[float, float, float]) -> Planting:
    def change(truth: Truth) -> Truth:
        for part in parts:
            put(truth, part, translated(lie(truth, part), by))
        return truth

    return change


def turned(*parts: str, by: np.ndarray, lift: float = 0.0) -> Planting:
    """Parts turned as one about the origin of the first."""

    def change(truth: Truth) -> Truth:
        about = pose(np.eye(3), lie(truth, parts[0])[:3, 3])
        turn = translated(about, (0.0, 0.0, lift)) @ pose(by, (0.0, 0.0, 0.0)) @ inverse(about)
        for part in parts:
            put(truth, part, turn @ lie(truth, part))
        return truth

    return change


def laid(layer: str, *, x: float = 0.0, y: float = 0.0, turn: float = 0.0) -> Planting:
    """A layer at its height on the base, off its nominal place."""

    def change(truth: Truth) -> Truth:
        X_WB = lie(truth, "base")
        height = (inverse(X_WB) @ lie(truth, layer))[2, 3]
        put(truth, layer, X_WB @ planar(x, y, height, turn))
        return truth

    return change


def stood(part: str, X_WP: Pose) -> Planting:
    def change(truth: Truth) -> Truth:
        put(truth, part, X_WP)
        return truth

    return change


def hole_off(layer: str, hole: int, way: float) -> Planting:
    """One hole of a layer drilled aside, in a direction in which two wedges of the bore meet."""

    def change(truth: Truth) -> Truth:
        site = truth.model.site(f"{layer}_hole{hole}")
        site.pos += [way * np.cos(np.pi / 12), way * np.sin(np.pi / 12), 0.0]
        mujoco.mj_forward(truth.model, truth.data)
        return truth

    return change


def thread(hole: int, **changed: object) -> Planting:
    def change(truth: Truth) -> Truth:
        holes = list(holes_of(truth))
        holes[hole] = msgspec.structs.replace(holes[hole], **changed)
        return replace(truth, states={**truth.states, "threads": ThreadsState(holes=tuple(holes), driven=0)})

    return change


def drawn(hole: int, way: float) -> Planting:
    """A screw turned out, its thread stiff so that it stays there."""

    def change(truth: Truth) -> Truth:
        model, data = truth.model, truth.data
        slide, turn = (model.joint(f"thread_{kind}{hole}") for kind in ("slide", "turn"))
        data.qpos[slide.qposadr[0]] += way
        data.qpos[turn.qposadr[0]] += way * 2 * np.pi / dimensions()("screw.pitch")
        model.dof_frictionloss[turn.dofadr[0]] = 5.0
        mujoco.mj_forward(model, data)
        return truth

    return change


def cut_aside(hole: int, way: float) -> Planting:
    """A screw in a thread that was cut beside its hole."""

    def change(truth: Truth) -> Truth:
        truth.model.body(f"carrier{hole}").pos[0] += way
        mujoco.mj_forward(truth.model, truth.data)
        return truth

    return change


def narrow(layer: str, hole: int, radius: float) -> Planting:
    """A hole of a layer bored so wide, and no wider."""

    def change(truth: Truth) -> Truth:
        truth.model.site(f"{layer}_hole{hole}").size[0] = radius
        return truth

    return change


def leant(hole: int, angle: float) -> Planting:
    def change(truth: Truth) -> Truth:
        body = truth.model.body(f"carrier{hole}").id
        mujoco.mju_mat2Quat(truth.model.body_quat[body], rotation_x(angle).ravel())
        mujoco.mj_forward(truth.model, truth.data)
        return truth

    return change


def rotor(**fields: object) -> Planting:
    """Something about the rotor's joint: its friction (N m), damping (N m s/rad), range or place (rad)."""

    def change(truth: Truth) -> Truth:
        joint = truth.model.joint("rotor")
        if "friction" in fields:
            truth.model.dof_frictionloss[joint.dofadr[0]] = fields["friction"]
        if "damping" in fields:
            truth.model.dof_damping[joint.dofadr[0]] = fields["damping"]
        if "stops" in fields:
            truth.model.jnt_limited[joint.id], truth.model.jnt_range[joint.id] = 1, fields["stops"]
        if "at" in fields:
            truth.data.qpos[joint.qposadr[0]] = fields["at"]
        mujoco.mj_forward(truth.model, truth.data)
        return truth

    return change


_NUMBERS = {
    "body": lambda model, name: [model.body(name).id],
    "geom": lambda model, name: shapes(model, name),
    "site": lambda model, name: [model.site(name).id],
    "jnt": lambda model, name: [model.joint(name).id],
    "dof": lambda model, name: [model.joint(name).dofadr[0]],
    "actuator": lambda model, name: [model.actuator(name).id],
    "eq": lambda model, name: [model.equality(name).id],
}  # fmt: skip


def shapes(model: mujoco.MjModel, name: str) -> list[int]:
    """The shape of a name, or the solid shapes of a body."""
    named = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, name)
    solid = (model.geom_contype | model.geom_conaffinity) != 0
    return (
        [named] if named >= 0 else np.flatnonzero((model.geom_bodyid == model.body(name).id) & solid).tolist()
    )


def figure(field: str, name: str, value: object, which: int | None = None) -> Planting:
    """A figure of the scene altered behind its back, of all shapes of a body or of one."""

    def change(truth: Truth) -> Truth:
        rows = _NUMBERS[field.partition("_")[0]](truth.model, name)
        getattr(truth.model, field)[rows if which is None else rows[which]] = value
        mujoco.mj_forward(truth.model, truth.data)
        return truth

    return change


def moved_on(field: str, name: str, by: object, which: int | None = None) -> Planting:
    """The same, by so much."""

    def change(truth: Truth) -> Truth:
        rows = _NUMBERS[field.partition("_")[0]](truth.model, name)
        getattr(truth.model, field)[rows if which is None else rows[which]] += by
        mujoco.mj_forward(truth.model, truth.data)
        return truth

    return change


def going(joint: str, rate: float, way: int = 0) -> Planting:
    """A joint that moves, rad/s or m/s."""

    def change(truth: Truth) -> Truth:
        truth.data.qvel[truth.model.joint(joint).dofadr[0] + way] = rate
        mujoco.mj_forward(truth.model, truth.data)
        return truth

    return change


def in_the_way(truth: Truth) -> Truth:
    """A pin on the far side of the hub."""
    put(truth, "pin0", lie(truth, "rotor") @ planar(dimensions()("rotor.crank_radius"), 0.0, 0.03, 0.0))
    return truth


def bored(name: str, wider: float) -> Planting:
    """The wedges around a hole drawn outward, m."""

    def change(truth: Truth) -> Truth:
        mesh = truth.model.mesh(name)
        corners = truth.model.mesh_vert[int(mesh.vertadr[0]) :][: int(mesh.vertnum[0])]
        corners[:, :2] += wider * np.sign(corners[:, :2].mean(axis=0))
        return truth

    return change


def pushed(body: str, force: float) -> Planting:
    def change(truth: Truth) -> Truth:
        truth.data.xfrc_applied[truth.model.body(body).id, 2] = force
        return truth

    return change


def weightless(truth: Truth) -> Truth:
    truth.model.opt.gravity[:] = 0.0
    return truth


def glued(truth: Truth) -> Truth:
    truth = replace(truth, states={**truth.states, "clamping": ClampingState(clamped=False)})
    truth.data.eq_active[truth.model.equality("merge_top").id] = 1
    return truth


def clamped(truth: Truth) -> Truth:
    """Its layers held by welds, as the cell has left them."""
    live, lands = finished_cell().truth, lands_of(truth.drawn)
    for field, rows in (("eq_data", merges(truth)), ("geom_contype", lands), ("geom_conaffinity", lands)):
        getattr(truth.model, field)[rows] = getattr(live.model, field)[rows]
    truth.data.eq_active[merges(truth)] = 1
    return replace(truth, states={**truth.states, Clamping.name: ClampingState(clamped=True)})


def in_touch(truth: Truth) -> Truth:
    lands = lands_of(truth.drawn)
    for field in ("geom_contype", "geom_conaffinity"):
        getattr(truth.model, field)[lands] = getattr(truth.drawn, field)[lands]
    return truth


def merges(truth: Truth) -> list[int]:
    return [truth.model.equality(name).id for name in WELDS]


def weld(number: int, **fields: object) -> Planting:
    """Clamped, with one weld open, or somewhere else: moved in its layer or in the base (m), or turned (rad)."""

    def change(truth: Truth) -> Truth:
        truth = clamped(truth)
        row = merges(truth)[number]
        figures = truth.model.eq_data[row]
        figures[:3] += fields.get("anchor", 0.0)
        figures[3:6] += fields.get("by", 0.0)
        turn = np.array([1.0, 0.0, 0.0, 0.0])
        mujoco.mju_axisAngle2Quat(turn, np.array([0.0, 0.0, 1.0]), fields.get("turn", 0.0))
        mujoco.mju_mulQuat(figures[6:10], figures[6:10].copy(), turn)
        truth.data.eq_active[row] = not fields.get("open", False)
        return truth

    return change


def state(device: str, **changed: object) -> Planting:
    """The state of a device, other than it was left."""

    def change(truth: Truth) -> Truth:
        other = msgspec.structs.replace(truth.states[device], **changed)
        return replace(truth, states={**truth.states, device: other})

    return change


def put_out(motor: str, value: float, gain: float | None = None) -> Planting:
    """A control that a motor has been left with, and a gain."""

    def change(truth: Truth) -> Truth:
        number = truth.model.actuator(motor).id
        truth.data.ctrl[number] = value
        if gain is not None:
            truth.model.actuator_gainprm[number, 0] = gain
            truth.model.actuator_biasprm[number, 2] = -gain
        return truth

    return change


def pushed_joint(joint: str, force: float) -> Planting:
    def change(truth: Truth) -> Truth:
        truth.data.qfrc_applied[truth.model.joint(joint).dofadr[0]] = force
        return truth

    return change


def number(field: str, value: float, at: int = 0) -> Planting:
    """A number of the simulator's state, nothing worked out from it."""

    def change(truth: Truth) -> Truth:
        if field == "time":
            truth.data.time = value
        else:
            getattr(truth.data, field)[at] = value
        return truth

    return change


def entry(field: str, row: int, value: float) -> Planting:
    """A figure of the scene that belongs to no one body."""

    def change(truth: Truth) -> Truth:
        getattr(truth.model, field)[row] = value
        return truth

    return change


def reaching(x: float, y: float, z: float) -> Planting:
    """The hand at a place of the table frame."""

    def change(truth: Truth) -> Truth:
        q = solve(STANFORD, hand(x, y, z, np.pi / 2, np.pi / 2, 0.0), PARK).q
        truth.data.qpos[:6] = q
        mujoco.mj_forward(truth.model, truth.data)
        return truth

    return change


def both(*changes: Planting) -> Planting:
    def change(truth: Truth) -> Truth:
        for one in changes:
            truth = one(truth)
        return truth

    return change


def beside(part: str, other: str, way: tuple[float, float, float]) -> Planting:
    """A part put where another is, and a way on."""

    def change(truth: Truth) -> Truth:
        put(truth, part, translated(lie(truth, other), way))
        return truth

    return change


def held(truth: Truth) -> Truth:
    """A pin between the fingers."""
    tool = truth.data.site("stanford/tool").xpos
    put(truth, "pin0", pose(np.eye(3), tool - [0.0, 0.0, 0.03]))
    return truth


# -- wrong pumps ------------------------------------------------------------------------------------


def wrong() -> Iterator[tuple[str, str, Planting]]:
    """What is wrong, a finding that must tell of it, and how it is planted."""
    for layer in ("gasket", "top"):
        for hole in range(6):
            name = f"screw {hole + 1} cuts .05 mm into the {layer}"
            yield name, f"{layer}_place", hole_off(layer, hole, clearance(layer) + 0.05 * MM)
    yield from _layers()
    yield from _bases()
    yield from _screws()
    yield from _rotors()
    yield from _around()
    yield from _parts()
    yield from _going()


def _layers() -> Iterator[tuple[str, str, Planting]]:
    cut, thickness = clearance("top") + 0.35 * MM, dimensions()("gasket.thickness")
    for name, direction in (("x", 0.0), ("y", 90.0), ("-x", 180.0), ("aslant", 225.0)):
        x, y = cut * np.cos(direction * DEGREE), cut * np.sin(direction * DEGREE)
        what = f"top {cut / MM:.2f} mm off along {name}, all shanks in metal"
        yield what, "top_place", laid("top", x=float(x), y=float(y))
    yield "top .05 mm into all shanks", "top_place", laid("top", y=clearance("top") + 0.05 * MM)
    yield "top turned until four shanks cut", "top_place", laid("top", turn=1.2 * DEGREE)
    yield "gasket 1.28 mm off", "gasket_place", laid("gasket", x=clearance("gasket") + 0.36 * MM)
    yield "gasket turned", "gasket_place", laid("gasket", turn=1.5 * DEGREE)
    yield "gasket upside down", "gasket_height", turned("gasket", by=rotation_x(np.pi), lift=thickness)
    yield "top end for end", "top_place", turned("top", by=planar(0, 0, 0, np.pi)[:3, :3])
    bored = both(laid("top", x=0.5 * MM), narrow("top", 3, dimensions()("screw.shank_radius") + 0.45 * MM))
    yield "shank .05 mm in a hole of the top that was bored narrow", "top_place", bored
    yield "gasket on its stand", "gasket_place", stood("gasket", planar(0.4, 1.1, 0.0445, 0.0))
    yield "top on its stand", "top_place", stood("top", planar(0.8, 1.1, 0.0445, 0.0))
    raised = [drawn(hole, thickness) for hole in range(6)]
    yield "doubled gasket", "top_height", both(shifted("top", by=(0.0, 0.0, thickness)), *raised)
    raised = [drawn(hole, 0.5 * MM) for hole in range(6)]
    yield "chip under the top", "top_height", both(shifted("top", by=(0.0, 0.0, 0.5 * MM)), *raised)
    yield "top .2 mm into the gasket", "overlap", shifted("top", by=(0.0, 0.0, -0.2 * MM))
    yield "gasket .2 mm into the casting", "overlap", shifted("gasket", by=(0.0, 0.0, -0.2 * MM))
    yield "top .5 mm into the gasket", "top_height", shifted("top", by=(0.0, 0.0, -0.5 * MM))
    yield "top with one edge up", "top_height", turned("top", by=rotation_x(0.7 * DEGREE), lift=0.2 * MM)
    yield (
        "gasket bent up to an edge",
        "gasket_height",
        turned("gasket", by=rotation(np.array([0.0, 0.5 * DEGREE, 0.0]))),
    )


def _bases() -> Iterator[tuple[str, str, Planting]]:
    yield "base 1.5 mm from the far block", "base_far", shifted(*PUMP, by=(0.0, -1.5 * MM, 0.0))
    yield "base 1.5 mm from the left block", "base_left", shifted(*PUMP, by=(1.5 * MM, 0.0, 0.0))
    yield "base .5 mm into a block", "overlap", shifted(*PUMP, by=(0.0, 0.6 * MM, 0.0))
    yield "base in the air", "base_height", shifted(*PUMP, by=(0.0, 0.0, 1.0 * MM))
    yield "base on an edge", "base_tilt", turned(*PUMP, by=rotation_x(0.4 * DEGREE), lift=0.4 * MM)
    yield "base turned", "base_yaw", turned(*PUMP, by=planar(0, 0, 0, 1.2 * DEGREE)[:3, :3])
    yield "base reversed", "base_yaw", turned(*PUMP, by=planar(0, 0, 0, np.pi)[:3, :3])


def _screws() -> Iterator[tuple[str, str, Planting]]:
    for hole in (0, 5):
        yield f"screw {hole + 1} missing", "screws", thread(hole, screw=None)
    yield "one screw counted twice", "screws", thread(0, screw=1)
    for way in (0.35, 0.8, 3.0, -0.3):
        yield f"screw {way} mm high", "screws_depth", drawn(2, way * MM)
    yield "screw loose at its depth", "screws_clamp", drawn(3, 0.15 * MM)
    yield "screw crossed and leaning", "screws_lean", both(thread(1, crossed=True), leant(1, 3.5 * DEGREE))
    yield "screw leaning 1.2 degrees", "screws_lean", leant(4, 1.2 * DEGREE)
    yield "screw crossed", "screws_crossed", thread(1, crossed=True)
    yield "screw .2 mm beside its tapped hole", "screws_place", cut_aside(3, 0.2 * MM)
    yield "screw short of its thread", "screws_thread", drawn(2, 1.0 * MM)


def _rotors() -> Iterator[tuple[str, str, Planting]]:
    yield "rotor jammed", "rotor", rotor(friction=5.0)
    yield "rotor stiff", "rotor", rotor(friction=0.4)
    yield "rotor that moves 6 degrees and jams", "rotor", rotor(stops=(-6 * DEGREE, 6 * DEGREE))
    for low, high in ((-50, 180), (-400, 61), (-400, 70), (-100, 400), (-300, 400), (-400, 350)):
        name = f"rotor that turns from {low} to {high} degrees"
        yield name, "rotor", rotor(stops=(low * DEGREE, high * DEGREE))
    yield "rotor as stiff as the check of 1973 lets pass", "rotor", rotor(friction=0.25)
    yield "rotor that springs back", "rotor", figure("jnt_stiffness", "rotor", 0.28)
    yield "rotor that springs back gently", "rotor", figure("jnt_stiffness", "rotor", 0.02)
    yield "rotor in hardened grease", "rotor", rotor(damping=0.03)
    yield "pin in the way of the crank", "rotor", in_the_way


def _around() -> Iterator[tuple[str, str, Planting]]:
    yield "both pins in one hole of the holder", "pins", beside("pin0", "pin1", (1.0 * MM, 0.0, 0.0))
    yield "pin in the pump", "pins", beside("pin0", "carrier1", (0.0, 0.0, 0.03))
    yield "pin on the table", "pins", stood("pin0", pose(rotation_x(np.pi / 2), (0.3, 0.3, 0.0037)))
    yield "pin that leans", "pins_tilt", turned("pin1", by=rotation_x(12 * DEGREE))
    yield (
        "pin .05 mm in the side of its hole",
        "overlap_bores",
        shifted("pin0", by=(0.35 * MM, 0.0, 1.0 * MM)),
    )
    yield "driver beside its rack", "rack", shifted("driver", by=(0.1, 0.0, 0.0))
    yield "driver on the floor", "floor", shifted("driver", by=(0.0, -1.0, -0.7))
    yield "driver upside down", "rack_tilt", turned("driver", by=rotation_x(np.pi))
    yield "driver in a guide of its rack", "overlap", shifted("driver", by=(0.8 * MM, 0.0, 0.0))
    yield (
        "screw on the table",
        "dispenser",
        both(thread(0, screw=None), stood("screw0", planar(0.3, 0.3, 0.03, 0))),
    )
    yield "hand holding a pin", "hand", held
    for where, x, y, z in (
        ("table", 0.9, 0.6, -0.01),
        ("belt", 1.12, 0.7, dimensions()("belt.height") - 0.01),
        ("rack", *dimensions().all("rack.place"), 0.05),
    ):
        yield f"hand in the {where}", "overlap", reaching(x, y, z)
    x, y = standard()[:2, 3]
    yield "hand on the pump", "hand", reaching(x, y, 0.09)


def _parts() -> Iterator[tuple[str, str, Planting]]:
    """Parts that are not as this world has them."""
    yield "rotor 10 mm out of its bearing", "rotor_place", moved_on("body_pos", "rotor", (0.0, 0.0, 10 * MM))
    yield "rotor 5 mm beside its bearing", "rotor_place", moved_on("body_pos", "rotor", (5 * MM, 0.0, 0.0))
    lean = np.zeros(4)
    mujoco.mju_mat2Quat(lean, rotation_x(2 * DEGREE).ravel())
    yield "rotor that leans in its bearing", "rotor_lean", figure("body_quat", "rotor", lean)
    yield "crank pin bent", "rotor_place", moved_on("geom_pos", "crank", (0.0, 2 * MM, 0.0))
    yield "crank pin broken short", "rotor_place", figure("geom_size", "crank", (5 * MM, 4 * MM, 0.0))
    yield "crank pin gone", "as_drawn", figure("geom_conaffinity", "crank", 0)
    yield "gasket torn off at its narrow end", "as_drawn", figure("geom_size", "gasket_lands", 1e-6, 4)
    yield "gasket torn at hole 3", "as_drawn", moved_on("geom_pos", "gasket_bores", (0.0, 0.0, 0.1), 20)
    yield "land missing at hole 4", "as_drawn", figure("geom_contype", "gasket_lands", 0, 3)
    yield "gasket without its web", "as_drawn", figure("geom_size", "gasket_web", (1e-6, 1e-6, 1e-6))
    yield "gasket of lead", "as_drawn", figure("body_mass", "gasket", 0.5)
    yield "top hollow", "as_drawn", figure("body_mass", "top", 0.1)
    yield "top on another centre of mass", "as_drawn", moved_on("body_ipos", "top", (0.01, 0.0, 0.0))
    yield "top oiled", "as_drawn", figure("geom_friction", "top_lands", 0.0)
    yield "hole of the top bored wide", "as_drawn", figure("site_size", "top_hole2", 4.5 * MM)
    yield "tapped holes bored to 3.2 mm", "as_drawn", bored("tap", 0.65 * MM)
    yield "tapped hole without thread", "as_drawn", figure("eq_active0", "thread3", 0)
    yield "coarse thread", "as_drawn", figure("eq_data", "thread3", 2e-4, 0)
    yield "thread without friction", "screws_hold", figure("dof_frictionloss", "thread_turn2", 0.0)
    yield "screw turned home with 1 N m", "screws_turned", thread(2, clamp=856.0)
    half = (dimensions()("screw.length") - dimensions()("screw.point_length")) / 2
    for what, longer in (("5 mm short", -5 * MM), ("4 mm long", 4 * MM)):
        size = (dimensions()("screw.shank_radius"), half + longer / 2, 0.0)
        yield f"screw {what}", "screws_size", figure("geom_size", "shank3", size)
        yield f"screw {what} before it was driven", "screws_size", figure("geom_size", "screw3", size, 0)
    yield (
        "screw with a head of another kind",
        "screws_size",
        figure("geom_size", "head1", (4 * MM, 2 * MM, 0.0)),
    )
    yield (
        "screw with a burr on its point",
        "screws_size",
        figure("geom_size", "screw1", (2.7 * MM, 1.5 * MM, 0.0), 1),
    )
    yield "soft screw", "as_drawn", figure("geom_solref", "head1", (0.05, 1.0))
    yield "base without its left half", "as_drawn", figure("geom_size", "plate", (0.01, 0.05, 0.01))
    yield (
        "blocks moved with the pump",
        "as_drawn",
        both(moved_on("body_pos", "blocks", 0.01), shifted(*PUMP, by=(0.01,) * 3)),
    )
    yield "pin holder moved with its pins", "as_drawn", moved_on("body_pos", "pin_holder", (0.001, 0.0, 0.0))
    yield "pin thinner than it was", "as_drawn", figure("geom_size", "pin1", (1 * MM, 1 * MM, 1 * MM))
    yield "bit worn away", "as_drawn", figure("geom_size", "bit", (1 * MM, 1 * MM, 0.0))
    yield "table oiled", "as_drawn", figure("geom_friction", "table", 0.01)
    yield "no weight", "as_drawn", weightless
    yield "top glued", "bonds", glued
    yield "thread torn out of the base", "bonds", open_bond
    yield "top pressed down by an unseen hand", "held", pushed("top", -30.0)
    yield "link of the arm pushed", "held", pushed("stanford/link6", 10.0)
    yield "finger pushed", "held", pushed_joint("stanford/finger_a", 5.0)
    for layer, name in enumerate(("gasket", "top")):
        yield f"clamped {name} let go", "bonds", weld(layer, open=True)
        yield f"weld of the {name} 5 mm aside", "bonds", weld(layer, by=(5 * MM, 0.0, 0.0))
        yield f"weld of the {name} 2 mm up", "bonds", weld(layer, by=(0.0, 0.0, 2 * MM))
        yield f"weld of the {name} elsewhere in it", "bonds", weld(layer, anchor=(0.0, 0.2 * MM, 0.0))
        yield f"weld of the {name} 3 degrees aside", "bonds", weld(layer, turn=3 * DEGREE)
    yield "layers clamped and their lands in touch", "as_drawn", both(clamped, in_touch)
    for field, at, value in (
        ("qpos", 0, np.nan),
        ("ctrl", 0, np.inf),
        ("time", 0, np.nan),
        ("qvel", -1, np.nan),
    ):
        yield f"{field} {value}", "numbers", number(field, value, at)
    yield "force of a clamp that is no number", "numbers", thread(5, clamp=np.nan)
    yield (
        "friction of a thread that is no number",
        "numbers",
        figure("dof_frictionloss", "thread_turn5", np.nan),
    )
    yield "box around a shape shrunk", "as_drawn", entry("bvh_aabb", 3, 0.0)
    yield "corner of a face elsewhere", "as_drawn", entry("mesh_face", 7, 0)
    for part, other in (("screw2", "dispenser"), ("screw2", "base")):
        yield f"screw both in its thread and at the {other}", "tray", beside(part, other, (0.0, 0.0, 0.1))
    yield "magnet of the bit dead", "as_drawn", figure("actuator_gainprm", "magnet", 0.0)
    yield "finger broken off", "as_drawn", figure("geom_contype", "stanford/finger_a", 0)
    yield "link of the arm bent", "as_drawn", moved_on("body_pos", "stanford/link4", 0.01)


def open_bond(truth: Truth) -> Truth:
    truth.data.eq_active[truth.model.equality("thread4").id] = 0
    return truth


def _going() -> Iterator[tuple[str, str, Planting]]:
    """Cells that are not at rest."""
    for joint in ("j1", "j4", "j6"):
        yield f"arm under way in {joint}", "arm_still", going(f"stanford/{joint}", 2.0)
    yield "arm creeping", "arm_still", going("stanford/j1", 0.02)
    yield "boom running out", "arm_still", going("stanford/j3", 0.05)
    yield "rotor spinning", "still", going("rotor", 3.0)
    yield "spindle spinning", "still", going("spindle", 2.0)
    yield "screwdriver switched on", "motor", state("screwdriver", command=20.0)
    yield "screwdriver coupled to a screw", "motor", put_out("drive", 0.0, 0.032)
    yield "screwdriver with a control left", "motor", put_out("drive", 5.0)
    yield "spindle with a control left", "motor", put_out("spindle", -1.0)
    yield "hand about to open", "motor", state("stanford/hand", command=(0.12, 20.0))
    yield "hand opening by itself", "motor", put_out("stanford/grip", 1e-3)
    yield "arm about to be driven", "motor", state("stanford", command=(0.0, 0.0, 0.0, 0.0, 5.0, 0.0))
    yield "arm driven against its brakes", "motor", put_out("stanford/j2", 20.0)
    about = state("stanford", braked=False, command=(5.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    free = figure("dof_frictionloss", "stanford/j1", 0.4)
    yield "arm that holds itself, about to be driven", "motor", both(free, about)
    yield "screw turning out", "still", going("thread_turn3", 1.0)
    yield "pump sliding", "still", going("base", 0.02)
    yield "pump turning", "still", going("base", 0.2, 5)
    yield "pin falling", "still", going("pin0", -0.2, 2)


# -- right pumps -----------------------------------------------------------------------------------


def right() -> Iterator[tuple[str, int | None, Planting]]:
    """What it is like, the world it stands in (none: one without errors), and how it is planted."""
    for number, direction in enumerate(range(0, 360, 45)):
        x, y = 0.9 * np.cos(direction * DEGREE), 0.9 * np.sin(direction * DEGREE)
        top, other = clearance("top"), clearance("gasket") * (-1) ** number
        yield (
            f"layers at {direction} degrees as far off as screws let them", None,
            both(laid("top", x=x * top, y=y * top), laid("gasket", x=x * other, y=y * other)),
        )  # fmt: skip
    farthest = max(float(np.hypot(*hole)) for hole in screw_holes())
    for sign in (-1, 1):
        turn = sign * 0.9 * clearance("top") / farthest
        yield f"top turned as far as screws let it, {sign:+d}", None, laid("top", turn=turn)
    for at in (60.0, -60.0, 200.0):
        yield f"rotor at {at:.0f} degrees", None, rotor(at=at * DEGREE)
    yield "rotor at 179 degrees", None, rotor(at=179 * DEGREE)
    yield "rotor stiff, but not too stiff", None, rotor(friction=0.08)
    yield "rotor loose", None, rotor(friction=0.0)
    yield "base off its blocks", None, shifted(*PUMP, by=(1.0 * MM, -1.0 * MM, 0.0))
    yield "thread scarred, its screw backed out and driven home", None, thread(1, scarred=True)
    yield "thread that runs hard", None, moved_on("dof_frictionloss", "thread_turn2", 0.24)
    yield "layers clamped, as the arm leaves them", None, clamped
    shut = state("stanford/hand", gap=0.0, set_point=0.0, command=(0.0, 80.0))
    yield "hand closed", None, shut
    beside = state("stanford/hand", gap=0.006, set_point=0.0006, command=(0.0, 80.0))
    yield "hand closed, its potentiometer 6 mm off", None, beside
    yield "pins changed about", None, _pins_changed
    yield "screws changed about", None, both(thread(1, screw=4), thread(4, screw=1))
    yield "driver askew in its guides", None, turned("driver", by=planar(0, 0, 0, 1 * DEGREE)[:3, :3])
    yield "driver at the end of its play", None, shifted("driver", by=(0.45 * MM, -0.45 * MM, 0.0))
    for seed in (910031, 910032, 910033):
        yield f"as drawn, seed {seed}", seed, lambda truth: truth


def _pins_changed(truth: Truth) -> Truth:
    first, second = lie(truth, "pin0"), lie(truth, "pin1")
    put(truth, "pin0", second)
    put(truth, "pin1", first)
    return truth
