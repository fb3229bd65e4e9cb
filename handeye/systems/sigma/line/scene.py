"""The scene of the assembly line: the scene of SUPERSIGMA with a second pair of arms, and the devices of
`line.xml`.
"""

import re
from typing import Final

import mujoco

from handeye.core.resources import scenes
from handeye.systems.sigma.gantries.machine import SCENE, Rig, vary
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.protocol import LINE_AXES

LINE_RIG: Final = Rig(axes=LINE_AXES, arms=(1, 2, 3, 4))
FURTHER: Final = 0.75  # m along x from the first SUPERSIGMA to the second one
TRAY_X, TRAY_Y = (
    0.050,
    0.200,
)  # m: place at which arm 1 takes pieces: that of the first cell with X5 = Y5 = 0
CELL: Final = 0.060  # m from cell to cell of the tray
TOP: Final = 0.012  # m, height of the tray and of the belt over the board
_DEVICES: Final = "supersigma/line.xml"
_MIDDLE: Final = '<statistic center=".3 .2 .1" extent="1"/>'
_FURTHER_MIDDLE: Final = '<statistic center=".67 .2 .1" extent="1.7"/>'  # shown by videos
_NUMBERED: Final = re.compile(r'"([A-Za-z_]+)([12])"')
_CARRIAGE: Final = re.compile(r'(name="carriage_X[34]" pos=")(\S+)')


def line_scene(world: GantryWorld) -> mujoco.MjSpec:
    """Return the scene of a world, without the pieces."""
    spec = mujoco.MjSpec.from_string(_text())
    vary(spec, world, LINE_RIG)
    return spec


def _text() -> str:
    """Return the scene as MJCF."""
    one, devices = ((scenes() / name).read_text(encoding="utf-8") for name in (SCENE, _DEVICES))
    world = _part(one, "worldbody")
    arms = world[world.index('<body name="carriage_X1"') :]
    further = _CARRIAGE.sub(lambda found: f"{found[1]}{float(found[2]) + FURTHER:g}", _second(arms))
    parts = {
        "worldbody": re.sub(r'<camera name="people".*?/>', "", world) + further + _part(devices, "worldbody")
    }
    for name in ("tendon", "equality", "sensor"):
        parts[name] = _part(one, name) + _second(_part(one, name)) + _part(devices, name)
    motors, hands = (
        re.findall(rf"<{kind} .*?/>", _part(one, "actuator")) for kind in ("general", "position")
    )
    axes = [*motors, *map(_second, motors), _part(devices, "actuator")]
    parts["actuator"] = "\n".join([*axes, *hands, *map(_second, hands)])
    for name, text in parts.items():
        one = one.replace(_part(one, name), text)
    return one.replace(_MIDDLE, _FURTHER_MIDDLE)


def _part(text: str, name: str) -> str:
    """Return the content of the scene's element `name`; empty if the scene does not have this element."""
    found = re.search(rf"<{name}>(.*?)</{name}>", text, re.DOTALL)
    return found[1] if found else ""


def _second(text: str) -> str:
    """Return a part of the scene in which arms 1 and 2 are renumbered as arms 3 and 4."""
    return _NUMBERED.sub(lambda found: f'"{found[1]}{int(found[2]) + 2}"', text)
