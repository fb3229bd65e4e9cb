"""The referee's findings on a finished pump, point by point."""

from math import degrees, isfinite
from typing import Final

import numpy as np

from handeye.cell.truth import Truth
from handeye.judge.finding import Finding, Findings, at_least, at_most
from handeye.judge.measured import Measured, displacement, tilt
from handeye.pose import Pose, translated, yaw
from handeye.tasks.water_pump import limits
from handeye.tasks.water_pump.dimensions import dimensions
from handeye.tasks.water_pump.drawing import base_top, screw_holes
from handeye.tasks.water_pump.measure import head_force, rotor_torque
from handeye.tasks.water_pump.threads import holes_of
from handeye.units import INCH

_MM: Final = 1e3
_PINS: Final = ("pin0", "pin1")
_GASKET: Final = (limits.GASKET_HEIGHT, limits.GASKET_TILT, limits.GASKET_PLACE)
_TOP: Final = (limits.TOP_HEIGHT, limits.TOP_TILT, limits.TOP_PLACE)


def judge(truth: Truth) -> Findings:
    """Measure the pump and its cell.

    Works on copies: the state of the cell is not touched.
    """
    measured = Measured(truth)
    return {
        **_base(measured),
        **_layer(measured, "gasket", base_top(), _GASKET),
        **_layer(measured, "top", base_top() + dimensions()("gasket.thickness"), _TOP),
        **_screws(measured, truth),
        **_cell(measured, truth),
        "rotor": _rotor(measured),
        "overlap": _overlap(measured),
    }


def _base(measured: Measured) -> dict[str, Finding]:
    turn = degrees(yaw(measured.relative("base", "blocks")) % (2 * np.pi)) - 180
    findings = {
        f"base_{side}": at_most(
            abs(measured.gap("plate", f"block_{side}")) * _MM, limits.BLOCK_GAP, "mm",
            f"gap between the base and the {side} block",
        )
        for side in ("far", "left")
    }  # fmt: skip
    findings["base_yaw"] = at_most(abs(turn), limits.BASE_YAW, "deg", "turn of the base against the blocks")
    X_WB = measured.pose("base")
    findings["base_height"] = at_most(
        abs(X_WB[2, 3]) * _MM, limits.BASE_HEIGHT, "mm", "height of the base off the table"
    )
    findings["base_tilt"] = at_most(degrees(tilt(X_WB)), limits.BASE_TILT, "deg", "tilt of the base")
    return findings


def _layer(
    measured: Measured, part: str, height: float, most: tuple[float, float, float]
) -> dict[str, Finding]:
    X: Pose = translated(measured.relative(part, "base"), (0.0, 0.0, -height))
    off = displacement(X, np.array(screw_holes()))
    return {
        f"{part}_height": at_most(
            abs(X[2, 3]) * _MM, most[0], "mm", f"height of the {part} off its nominal {height / INCH:.2f} in"
        ),
        f"{part}_tilt": at_most(degrees(tilt(X)), most[1], "deg", f"tilt of the {part} on the base"),
        f"{part}_place": at_most(
            off * _MM, most[2], "mm", f"farthest screw hole of the {part} from the base's"
        ),
    }


def _screws(measured: Measured, truth: Truth) -> dict[str, Finding]:
    size = dimensions()
    filled = [k for k, thread in enumerate(holes_of(truth)) if thread.screw is not None]
    height = size("top.flange") + size("screw.head_height") / 2
    gaps = []
    for k in filled:
        head = measured.model.geom(f"head{k}").id
        X_WT = measured.pose("top")
        gaps.append(float(X_WT[:3, 2] @ (measured.data.geom_xpos[head] - X_WT[:3, 3]) - height))
    forces = [head_force(measured, k) for k in filled]
    crossed = sum(thread.crossed for thread in holes_of(truth))
    nothing = float(size("screw.length") * _MM)  # a missing screw counts as one that stands full length high
    worst = max((abs(gap) * _MM for gap in gaps), default=nothing)
    return {
        "screws": at_least(len(filled), len(holes_of(truth)), "screws", "screws in their threads"),
        "screws_depth": at_most(worst, limits.SCREW_GAP, "mm", "greatest gap under a screw's head"),
        "screws_clamp": at_least(
            min(forces, default=0.0), limits.SCREW_CLAMP, "N", "weakest clamp of a screw"
        ),
        "screws_crossed": at_most(crossed, 0, "screws", "cross-threaded screws"),
    }


def _cell(measured: Measured, truth: Truth) -> dict[str, Finding]:
    pins = [measured.place(pin, _PINS) for pin in _PINS]
    screws = tuple(f"screw{k}" for k in range(len(holes_of(truth))))
    in_threads = {thread.screw for thread in holes_of(truth)}
    loose = [name for k, name in enumerate(screws) if k not in in_threads]
    strayed = [measured.place(name, screws)[0] for name in loose]
    away, lean = measured.place("driver", ("driver",))
    lowest = min(measured.pose(name)[2, 3] for name in ("base", "gasket", "top", *_PINS, "driver", *loose))
    return {
        "pins": at_most(
            max(distance for distance, _ in pins) * _MM, limits.PIN_PLACE, "mm", "farther pin from its holder"
        ),
        "pins_tilt": at_most(
            max(degrees(lean) for _, lean in pins), limits.PIN_TILT, "deg", "lean of a pin in its holder"
        ),
        "rack": at_most(away * _MM, limits.RACK_PLACE, "mm", "screwdriver from its rack"),
        "rack_tilt": at_most(degrees(lean), limits.RACK_TILT, "deg", "lean of the screwdriver in its rack"),
        "dispenser": at_most(
            max(strayed, default=0.0) * _MM, limits.PIN_PLACE, "mm", "loose screw from the dispenser"
        ),
        "floor": at_least(lowest * _MM, limits.FLOOR, "mm", "lowest part over the table top"),
    }


def _rotor(measured: Measured) -> Finding:
    torque = rotor_torque(measured)
    value = torque if isfinite(torque) else 2 * limits.ROTOR_TORQUE  # did not turn at all
    return at_most(value, limits.ROTOR_TORQUE, "N m", "torque that turns the rotor")


def _overlap(measured: Measured) -> Finding:
    depth, what = measured.deepest()
    return at_most(depth * _MM, limits.PENETRATION, "mm", f"deepest overlap, of {what}")
