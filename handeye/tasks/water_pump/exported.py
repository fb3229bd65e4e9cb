"""Exports the pump's cell to other programs. In the export, names are readable, screws are in their holes, and there
are no mechanisms.

In the simulated cell, a carrier represents a screw in its thread, and the screw itself lies on a tray below the
floor (`cell/threads.py`). In the export, the screw is in its hole, at the pose of the carrier, welded to the
base. Carriers, the tray, and the coupling between the driver's motor and a carrier are left out.
"""

from typing import Final

import mujoco

from handeye.cell.keyframe import add_keyframe, body_pose
from handeye.cell.threads import holes_of
from handeye.cell.truth import Truth
from handeye.core.pose import Pose, inverse
from handeye.core.resources import scenes
from handeye.tasks.interface import ExportedScene
from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.water_pump.scene import specification
from handeye.tasks.water_pump.scene.textures import add_textures
from handeye.tasks.water_pump.world.pump_world import PumpWorld

RENAMED: Final = {"pin0": "pin1", "pin1": "pin2"}
"""The bodies that the export renames, together with their joints. The keys are the names in the scene, and the values
are the names in the export.
"""
_METAL: Final = {
    "base.casting.density": ("casting", "floor_2"),
    "base.plate.density": ("base_plate",),
    "gasket.density": ("gasket",),
    "top.density": ("flange", "hub"),
    "rotor.density": ("crank_bar", "crank_pin", "shaft", "collar"),
}  # solids of each metal, by the dimension that is its density
_CAST: Final = ("base.", "top.")  # figures of the parts whose mass differs from world to world
_FASTENERS: Final = ("screw", "pin_nose", "pin_body")
_MECHANISMS: Final = {
    "actuators": ("drive",),
    "equalities": ("thread", "merge_"),
    "bodies": ("carrier",),
    "sites": ("park",),
    "geoms": ("tray",),
}  # elements that only make threads and clamping work, by kind and prefix of their names, dependants first


def exported(world: PumpWorld, truth: Truth, keyframe: str) -> ExportedScene:
    """Return the scene of a world, with every object at its true pose. The arguments are the same as for
    `Task.exported`.
    """
    model, data = truth.copy()
    spec = specification(world)
    model.eq_data[:] = spec.compile().eq_data  # reset to the design, because the bonds are deleted below
    spec.copy_back(model)
    add_textures(spec)
    threaded = {
        f"screw{thread.screw}": body_pose(data, f"carrier{hole}")
        for hole, thread in enumerate(holes_of(truth))
        if thread.screw is not None
    }
    for kind, names in _MECHANISMS.items():
        for thing in [thing for thing in getattr(spec, kind) if thing.name.startswith(names)]:
            spec.delete(thing)
    for screw, X_WS in threaded.items():
        _weld(spec, screw, inverse(body_pose(data, "base")) @ X_WS)
    add_keyframe(spec, keyframe, data, threaded)
    _rename(spec)
    about = (scenes() / "water_pump" / "exported.md").read_text(encoding="utf-8")
    pump = ("base", "gasket", "top", "rotor", *(f"screw{k}" for k in range(world.screws)))
    return ExportedScene(
        spec=spec, about=about, parts={"pump": pump}, densities=_densities(spec, world.part_mass)
    )


def _densities(spec: mujoco.MjSpec, cast: float) -> dict[str, float]:
    """Return the densities (kg/m3) of the solids that consist of a single metal. In this world, the densities of base
    and top are `cast` times the densities of the design.
    """
    steel = spec.find_default("shank")
    assert steel is not None
    table = {
        solid: dimensions()(figure) * (cast if figure.startswith(_CAST) else 1.0)
        for figure, names in _METAL.items()
        for solid in names
    }
    return {**table, **dict.fromkeys(_FASTENERS, float(steel.geom.density))}


def _weld(spec: mujoco.MjSpec, screw: str, X_BS: Pose) -> None:
    """Weld a screw to the base, and switch off the contacts between screw and base, because the screw's thread
    overlaps the wedges of the hole.
    """
    weld = spec.add_equality(
        name=f"{screw}_in_thread", type=mujoco.mjtEq.mjEQ_WELD, objtype=mujoco.mjtObj.mjOBJ_BODY,
        name1="base", name2=screw, solref=[0.004, 1.0], solimp=[0.99, 0.999, 0.0001, 0.5, 2.0],
    )  # fmt: skip
    weld.data[:3] = 0.0
    weld.data[3:6] = X_BS[:3, 3]
    mujoco.mju_mat2Quat(weld.data[6:10], X_BS[:3, :3].ravel())
    weld.data[10] = 1.0
    spec.add_exclude(name=f"{screw}_in_base", bodyname1="base", bodyname2=screw)


def _rename(spec: mujoco.MjSpec) -> None:
    things = [thing for kind in (spec.bodies, spec.joints) for thing in kind if thing.name in RENAMED]
    names = [RENAMED[thing.name] for thing in things]
    for thing in things:
        thing.name = f"{thing.name} of the scene"  # no two may ever have the same name
    for thing, name in zip(things, names, strict=True):
        thing.name = name
