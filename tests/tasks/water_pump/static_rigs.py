"""Rigs of known weights, levers and springs under the contact settings of the pump's cell: what arithmetic says of each
force, and what the simulation has.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, radians, sin
from typing import Final

import mujoco
import numpy as np

from handeye.arm.dynamics import GRAVITY
from handeye.core.pose import Array
from handeye.core.resources import scenes

SLIDING: Final = 0.2  # friction of the parts: scenes/water_pump/workcell.xml
TABLE: Final = '<geom class="solid" type="box" size="1 1 .05" pos="0 0 -.05"/>'


@dataclass(frozen=True, slots=True, kw_only=True)
class Force:
    """A force or moment in a rig."""

    rig: str
    what: str
    reckoned: float
    """By arithmetic."""
    simulated: float
    """By the contacts of the simulation."""
    felt: float | None = None
    """As the program estimates it, where the hand feels it."""
    unit: str = "N"

    @property
    def off(self) -> float:
        """By how much the simulated one is another than the reckoned one, relative."""
        return self.simulated / self.reckoned - 1


class Rig:
    """Bodies under the settings of the cell."""

    def __init__(self, bodies: str) -> None:
        """Bodies as MJCF; the classes of the cell are theirs to use."""
        cell = (scenes() / "water_pump" / "workcell.xml").read_text(encoding="utf-8")
        text = cell.replace("</mujoco>", f"<worldbody>{bodies}</worldbody></mujoco>")
        self.model = mujoco.MjModel.from_xml_string(text)
        self.model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)  # what sleeps has no contacts
        self.data = mujoco.MjData(self.model)

    def run(self, seconds: float = 1.0) -> "Rig":
        """Let time pass."""
        mujoco.mj_step(self.model, self.data, round(seconds / self.model.opt.timestep))
        mujoco.mj_forward(self.model, self.data)
        return self

    def on(self, body: str, by: str) -> Array:
        """Contact force on a body by another one, in W, shape (3,), N."""
        return contact_wrench(self.model, self.data, body, by)[:3]

    def squeeze(self, joint: str) -> float:
        """Force of the spring in a slide, N."""
        slide, data = self.model.joint(joint), self.data.joint(joint)
        rest = self.model.qpos_spring[slide.qposadr[0]]
        return float(self.model.jnt_stiffness[slide.id].flat[0] * (data.qpos[0] - rest))


def contact_wrench(
    model: mujoco.MjModel, data: mujoco.MjData, body: str, by: str, about: Array | None = None
) -> Array:
    """Contact force (N) on a body by another one, and its moment (N m) about a point of W (the origin); shape (6,)."""
    mine, other = model.body(body).id, model.body(by).id
    total, force = np.zeros(6), np.zeros(6)
    for number, contact in enumerate(data.contact):
        first, second = model.geom_bodyid[contact.geom]
        if {int(first), int(second)} == {mine, other}:
            mujoco.mj_contactForce(model, data, number, force)
            on_body = contact.frame.reshape(3, 3).T @ force[:3] * (1.0 if second == mine else -1.0)
            total[:3] += on_body
            total[3:] += np.cross(contact.pos - (np.zeros(3) if about is None else about), on_body)
    return total


def _body(name: str, at: str, joint: str, geom: str) -> str:
    """MJCF of a body with one solid geom."""
    return f'<body name="{name}" pos="{at}">{joint}<geom class="solid" {geom}/></body>'


def _box(name: str, mass: float, at: str, size: str = ".05 .04 .03", joint: str = "<freejoint/>") -> str:
    return _body(name, at, joint, f'type="box" size="{size}" mass="{mass}"')


def _press(stiffness: float, at: str, axis: str) -> str:
    """A plunger of .5 kg on a slide, pressed by a spring that is 10 mm short."""
    joint = f'<joint name="press" type="slide" axis="{axis}" stiffness="{stiffness}" springref="-.01" damping="20"/>'
    return _box("press", 0.5, at, size=".02 .02 .02", joint=joint)


def block() -> Iterator[Force]:
    """A block on a table."""
    rig = Rig(TABLE + _box("block", 2.0, "0 0 .03")).run()
    yield Force(
        rig="2 kg on a table", what="table", reckoned=2 * GRAVITY, simulated=rig.on("block", "world")[2]
    )


def stack() -> Iterator[Force]:
    """A block on a block."""
    name = "1 kg on 2 kg on a table"
    rig = Rig(TABLE + _box("low", 2.0, "0 0 .03") + _box("high", 1.0, "0 0 .09")).run()
    yield Force(rig=name, what="table", reckoned=3 * GRAVITY, simulated=rig.on("low", "world")[2])
    yield Force(rig=name, what="upper block", reckoned=GRAVITY, simulated=rig.on("high", "low")[2])


def lever() -> Iterator[Force]:
    """A beam with two weights on a fulcrum and a prop."""
    name = "a lever of .5 kg: 3 kg at .3 m, 1 kg at -.2 m, a prop at .4 m"
    round_bar = 'type="cylinder" size=".01 .05" euler="90 0 0"'
    props = _body("fulcrum", "0 0 .05", "", round_bar) + _body("prop", ".4 0 .05", "", round_bar)
    weights = _box("three", 3.0, ".3 0 .1", ".03 .03 .03") + _box("one", 1.0, "-.2 0 .1", ".03 .03 .03")
    rig = Rig(props + _box("beam", 0.5, "0 0 .065", ".5 .03 .005") + weights).run()
    prop = GRAVITY * (3 * 0.3 - 1 * 0.2) / 0.4
    yield Force(rig=name, what="prop", reckoned=prop, simulated=rig.on("beam", "prop")[2])
    fulcrum = 4.5 * GRAVITY - prop
    yield Force(rig=name, what="fulcrum", reckoned=fulcrum, simulated=rig.on("beam", "fulcrum")[2])


def slope() -> Iterator[Force]:
    """A block that friction holds on a slope."""
    name, angle, weight = "2 kg on a slope of 8 degrees", radians(8), 2 * GRAVITY
    normal, uphill = np.array([-sin(angle), 0.0, cos(angle)]), np.array([cos(angle), 0.0, sin(angle)])
    lying = _box("block", 2.0, "0 0 0", joint="").replace("<body", '<body euler="0 -8 0"')
    free = lying.replace('pos="0 0 0">', f'pos="{-0.03 * sin(angle)} 0 {0.03 * cos(angle)}"><freejoint/>')
    rig = Rig(f'<body name="slope" euler="0 -8 0">{TABLE}</body>{free}').run()
    force = rig.on("block", "slope")
    yield Force(rig=name, what="normal", reckoned=weight * cos(angle), simulated=float(force @ normal))
    yield Force(rig=name, what="friction", reckoned=weight * sin(angle), simulated=float(force @ uphill))


def pulled(newtons: float, seconds: float = 0.5) -> float:
    """Speed (m/s) of a block of 2 kg on a table that has been pulled for a time."""
    rig = Rig(TABLE + _box("block", 2.0, "0 0 .03")).run(0.2)
    rig.data.qfrc_applied[0] = newtons
    return float(rig.run(seconds).data.qvel[0])


def slider() -> Iterator[Force]:
    """A block that is pulled harder than friction holds; what its speed says of the mean friction."""
    name, pull, seconds = "2 kg pulled by 6 N", 6.0, 0.5
    friction = pull - 2.0 * pulled(pull, seconds) / seconds
    yield Force(rig=name, what="friction", reckoned=SLIDING * 2 * GRAVITY, simulated=friction)


def spring() -> Iterator[Force]:
    """A plunger that a spring presses on a block."""
    rig = Rig(TABLE + _box("block", 0.5, "0 0 .03") + _press(2000, "0 0 .08", "0 0 1")).run()
    reckoned, simulated = rig.squeeze("press") + 0.5 * GRAVITY, rig.on("press", "block")[2]
    yield Force(
        rig="a plunger of .5 kg and a spring of 2 N/mm",
        what="plunger",
        reckoned=reckoned,
        simulated=simulated,
    )


def clamped() -> Iterator[Force]:
    """A block that hangs between a wall and a plunger, held by friction."""
    name = "2 kg between a wall and a spring of 10 N/mm"
    wall = _body("wall", "-.06 0 .2", "", 'type="box" size=".01 .1 .1"')
    rig = Rig(wall + _box("block", 2.0, "0 0 .2") + _press(10000, ".07 0 .2", "1 0 0")).run(0.5)
    both = rig.on("block", "wall") + rig.on("block", "press")
    yield Force(rig=name, what="wall", reckoned=rig.squeeze("press"), simulated=rig.on("block", "wall")[0])
    yield Force(rig=name, what="friction, both sides", reckoned=2 * GRAVITY, simulated=both[2])


RIGS: Final = (block, stack, lever, slope, slider, spring, clamped)
