"""The referee of a pump that was taken apart: does everything lie where the run found it?"""

from math import degrees
from typing import Final

import numpy as np

from handeye.cell.truth import Truth
from handeye.judge.finding import Findings, at_least, at_most, worse
from handeye.judge.measured import Measured, tilt
from handeye.tasks.water_pump import limits
from handeye.tasks.water_pump.referee import hand_room
from handeye.tasks.water_pump.threads import holes_of

_MM: Final = 1e3
_PINS: Final = ("pin0", "pin1")
_PARTS: Final = {"base": limits.APART, "gasket": limits.APART_GASKET, "top": limits.APART}


def judge_apart(truth: Truth) -> Findings:
    """Measure the parts as they were left and when they have settled; the worse finding counts."""
    filled = sum(thread.screw is not None for thread in holes_of(truth))
    in_threads = at_most(filled, 0, "screws", "screws left in their threads")
    left, settled = Measured(truth), Measured(truth, limits.SETTLE)
    return {**worse(_places(left), _places(settled)), "screws_out": in_threads}


def _places(measured: Measured) -> Findings:
    screws = [name for name in _bodies(measured) if name.startswith("screw") and name[5:].isdecimal()]
    findings = {
        f"{name}_back": at_most(
            measured.strayed((name,), (name,)) * _MM, limit, "mm", f"{name} from where the run found it"
        )
        for name, limit in _PARTS.items()
    }
    turned = max(measured.turned(name) for name in _PARTS)
    findings["parts_turn"] = at_most(
        degrees(turned), limits.APART_TURN, "deg", "turn of base, gasket or top against how the run found it"
    )
    for name, things, what in (
        ("pins", _PINS, "farther pin from its hole in the holder"),
        ("dispenser", screws, "farthest screw from its place in the dispenser"),
        ("rack", ("driver",), "screwdriver from its rack"),
    ):
        findings[name] = at_most(measured.strayed(things, things) * _MM, limits.APART, "mm", what)
    for name, things, most, what in (
        ("pins_tilt", _PINS, limits.PIN_TILT, "lean of a pin in its holder"),
        ("rack_tilt", ("driver",), limits.RACK_TILT, "lean of the screwdriver in its rack"),
    ):
        lean = max(tilt(measured.pose(thing)) for thing in things)
        findings[name] = at_most(degrees(lean), most, "deg", what)
    parts = (*_PARTS, *_PINS, "driver", *screws)
    findings["hand"] = at_least(
        hand_room(measured, parts) * _MM, limits.HAND_CLEAR, "mm", "hand from the nearest part"
    )
    return findings


def _bodies(measured: Measured) -> list[str]:
    return [measured.model.body(number).name for number in np.arange(measured.model.nbody)]
