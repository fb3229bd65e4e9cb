"""The water-pump work cell as a MuJoCo model, built for a world with its errors."""

from typing import Final

import mujoco

from handeye.core.resources import scenes
from handeye.tasks.stanford_cell.arm import add_arm
from handeye.tasks.stanford_cell.shapes import Shaper
from handeye.tasks.water_pump.faults.before import break_parts
from handeye.tasks.water_pump.scene.base import add_base
from handeye.tasks.water_pump.scene.cover import add_gasket, add_merging, add_top
from handeye.tasks.water_pump.scene.dressing import dress
from handeye.tasks.water_pump.scene.fasteners import add_pins, add_screws
from handeye.tasks.water_pump.scene.fixtures import add_blocks, add_plain_stations
from handeye.tasks.water_pump.scene.room import add_room
from handeye.tasks.water_pump.scene.tool import add_driver
from handeye.tasks.water_pump.world.pump_world import PumpWorld

_METAL: Final = (
    "solid", "grip", "bore", "tap", "face", "hub", "shank", "shoulder", "threaded", "nose", "head",
    "base_land", "gasket_land", "top_land",
)  # fmt: skip
"""Default classes of the shapes whose friction varies between worlds."""


def specification(world: PumpWorld) -> mujoco.MjSpec:
    """Return the scene before compilation. The caller can then add shapes to the scene, or save it.

    The scene contains the bodies `base`, `gasket`, `top`, `pin0`, `pin1`, `screw0`, `screw1` (and so on), `driver`,
    and the fixtures. The base contains `carrier0`, `carrier1` (and so on), the top contains `rotor`, and the driver
    contains `bit`. The names of the arm's bodies begin with `stanford/`. The world frame is the frame of the table.
    """
    spec = mujoco.MjSpec.from_file(str(scenes() / "water_pump" / "workcell.xml"))
    add_arm(spec, world)  # first, because free bodies added before the arm would shift its joints
    shaper = Shaper(spec=spec)
    for style in _METAL:
        friction = shaper.style(style).geom.friction
        friction[0] *= world.friction["part"]  # a contact has the greater friction of the two
    add_room(shaper, world)
    add_blocks(shaper, world)
    add_base(shaper, world)
    add_gasket(shaper, world)
    add_top(shaper, world)
    add_pins(shaper, world)
    add_screws(shaper, world)
    add_driver(shaper, world)
    add_plain_stations(shaper, world)
    add_merging(spec)
    break_parts(spec, world.drawn.spec.faults, world.screws)
    return spec


def build(world: PumpWorld) -> mujoco.MjModel:
    """Compile the scene. All joint positions are zero. Zero is outside the limits of joint 3, so the caller must set a
    configuration before the first physics step.
    """
    return specification(world).compile()


def dressed(world: PumpWorld) -> mujoco.MjModel:
    """Compile the scene for photographs, with shapes that the working cell does not have. This scene is never
    simulated.
    """
    spec = specification(world)
    dress(Shaper(spec=spec))
    return spec.compile()
