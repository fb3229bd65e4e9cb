"""What is in the room for people alone: no cell that works has any of it.

It touches nothing, weighs nothing, and lies in a group that the television camera leaves out.
"""

from typing import Final

from handeye.tasks.water_pump.scene.bevels import add_bevels
from handeye.tasks.water_pump.scene.boom_cables import add_boom_cables
from handeye.tasks.water_pump.scene.machine_room import add_reels, add_teletype
from handeye.tasks.water_pump.scene.shapes import Shaper
from handeye.tasks.water_pump.scene.textures import add_textures
from handeye.tasks.water_pump.scene.wall_clock import add_clock

_MATERIALS: Final = {
    "case": (0.70, 0.66, 0.55, 0.25),
    "paper": (0.90, 0.89, 0.84, 0.0),
    "tape": (0.20, 0.13, 0.09, 0.3),
    "reel": (0.78, 0.78, 0.76, 0.4),
}
"""Red, green, blue, and gloss."""


def dress(shaper: Shaper) -> None:
    """Put into a scene what is there for people alone."""
    for name, (*rgb, gloss) in _MATERIALS.items():
        shaper.spec.add_material(name=name, rgba=[*rgb, 1.0], specular=gloss, shininess=gloss)
    add_textures(shaper.spec)
    add_reels(shaper)
    add_teletype(shaper)
    add_clock(shaper)
    add_boom_cables(shaper)
    add_bevels(shaper)
