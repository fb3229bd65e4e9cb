"""Insertion as a task: fetch one pin and insert it into one hole."""

from __future__ import annotations

import math
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from handeye.arm.robots.stanford import STANFORD
from handeye.judge.finding import Findings, all_right, at_least, at_most
from handeye.tasks.inserting import InsertionTask, InsertionTruth
from handeye.tasks.interface import Words
from handeye.tasks.stanford_cell.dimensions import PARK, dimensions

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import mujoco

    from handeye.cell.rendering import RendererMaker
    from handeye.cell.simulated import SimulatedCell
    from handeye.cell.truth import Truth
    from handeye.core.faults import Catalogue
    from handeye.core.variation import Variation, WorldSpec


HOLDER_PLACE: Final = 3.0
"""Greatest distance (mm) of a returned pin from its original position: the sum of the clearance and the chamfer of the
holder's hole. The limit for the pump's pins is the same.
"""
HOLE_PLACE: Final = 2.5
"""Greatest distance (mm) of an inserted pin from the axis of its hole: the radius of the pin's nose. The height alone
does not show that a pin is in its hole: a pin on the table beside the plate lies even lower.
"""
ON_FACE: Final = 0.1
"""Greatest distance (mm) between the face and the end of a pin that stands on the face. Contacts are soft: a standing
pin sinks in by .01 to .06 mm.
"""
STANDING: Final = 1.0  # N; a pin that presses less on the plate may only hover close to it. Our choice
HOLDER_LEAN: Final = 10.0  # deg; a pin tilted by more leans out of the holder


class Insertion(InsertionTask):
    """Insert one pin into one hole."""

    name = "insertion"
    arm = STANFORD
    park = PARK
    words = Words(product="the pin", done="The pin is in its hole.", apart="The pin is back in its holder.")
    script = "insertion.al"
    other_scripts = ("insertion_1973.al",)
    programs = MappingProxyType({"gentle": "insertion.al", "1973": "insertion_1973.al"})

    def variation(self) -> Variation:
        from handeye.tasks.insertion.world import VARIATION

        return VARIATION

    def faults(self, world: WorldSpec) -> Catalogue:
        from handeye.tasks.insertion.world import FAULTS

        return FAULTS

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        from handeye.tasks.insertion.cell import build
        from handeye.tasks.insertion.world import InsertionWorld

        return build(InsertionWorld.draw(spec))

    def cell(self, spec: WorldSpec, camera: str | RendererMaker) -> SimulatedCell:
        from handeye.tasks.insertion.cell import InsertionCell
        from handeye.tasks.insertion.world import InsertionWorld

        return InsertionCell(InsertionWorld.draw(spec))

    def judge(self, truth: Truth) -> Findings:
        return _inserted(truth)

    def judge_apart(self, truth: Truth) -> Findings:
        from handeye.tasks.insertion.cell import off_holder

        away, leans = off_holder(truth.data)
        return {
            "pin_place": at_most(
                away * 1e3, HOLDER_PLACE, "mm", "distance of the pin from its place in the holder"
            ),
            "pin_lean": at_most(math.degrees(leans), HOLDER_LEAN, "deg", "tilt of the pin"),
        }

    @property
    def referees(self) -> Mapping[str, Callable[[Truth], Findings]]:
        return {"on_face": _on_face}

    def caught(self, clearance: float, chamfer: float) -> float:
        return clearance / 2 + chamfer + dimensions()("pin.nose_bevel")

    def hole(self, clearance: float, chamfer: float) -> dict[str, float]:
        return {"hole.clearance": clearance, "hole.chamfer": chamfer, "plate.x": 0.0, "plate.y": 0.0}

    def off(self, truth: Truth, error: tuple[float, float]) -> dict[str, float]:
        from handeye.tasks.insertion.cell import HOLE, tip

        end = tip(truth.data)
        return {f"plate.{axis}": float(end[k] - HOLE[k] + error[k]) for k, axis in enumerate("xy")}

    def witnessed(self, cell: SimulatedCell) -> InsertionTruth:
        from handeye.tasks.insertion.cell import InsertionCell

        assert isinstance(cell, InsertionCell)
        seen, right = cell.witness, all_right(_inserted(cell.truth))
        return InsertionTruth(peak=seen.peak, first=seen.first, seated=seen.seated, right=right)


def _inserted(truth: Truth) -> Findings:
    """Judge whether the pin stands in the hole, on its shoulder."""
    from handeye.tasks.insertion.cell import SEATED, off_hole, shoulder

    high, away = shoulder(truth.data) * 1e3, off_hole(truth.data) * 1e3
    return {
        "seat": at_most(high, SEATED * 1e3, "mm", "height of the pin's shoulder above the face of the plate"),
        "place": at_most(away, HOLE_PLACE, "mm", "distance of the pin from the axis of the hole"),
    }


def _on_face(truth: Truth) -> Findings:
    """Judge whether the end of the pin stands on the face of the plate."""
    from handeye.tasks.insertion.cell import FACE, PUSH, tip

    off = abs(float(tip(truth.data)[2]) - FACE) * 1e3
    force = math.hypot(*truth.data.sensor(PUSH).data)
    return {
        "on_face": at_most(off, ON_FACE, "mm", "distance of the pin's end from the face of the plate"),
        "standing": at_least(force, STANDING, "N", "force between pin and plate at the end"),
    }


INSERTION: Final = Insertion()
