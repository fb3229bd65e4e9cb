"""The referee's findings on a finished pump, and on one that was taken apart, point by point."""

from collections.abc import Iterable
from math import degrees, isfinite
from typing import Final

import numpy as np

from handeye.cell.truth import Truth
from handeye.core.pose import yaw
from handeye.core.units import INCH
from handeye.judge.finding import Finding, Findings, at_least, at_most, worse
from handeye.judge.measured import Measured, tilt
from handeye.tasks.water_pump.referee import limits, measure
from handeye.tasks.water_pump.referee.measure import Overlap, deepest
from handeye.tasks.water_pump.scene.arm import ARM
from handeye.tasks.water_pump.threads import Thread, holes_of
from handeye.tasks.water_pump.world.dimensions import dimensions

_MM: Final = 1e3
_PINS: Final = ("pin0", "pin1")
_PARTS: Final = {"base": limits.APART, "gasket": limits.APART_GASKET, "top": limits.APART}


def judge(truth: Truth) -> Findings:
    """Measure the pump and its cell.

    Places are measured twice, as parts were left and when they have settled, and the worse finding counts: what hangs
    in the air falls, and what was pressed into something springs out. The state of the cell is not touched.
    """
    left, settled = _as_left_and_settled(truth)
    holes = holes_of(truth)
    return {
        **worse(_places(left, holes), _places(settled, holes)),
        "screws_clamp": _clamp(settled, holes),
        "rotor": _rotor(settled),
    }


def _as_left_and_settled(truth: Truth) -> tuple[Measured, Measured]:
    return Measured(truth), Measured(truth, limits.SETTLE)


def _places(measured: Measured, holes: tuple[Thread, ...]) -> Findings:
    return {
        **_base(measured),
        **_layer(measured, "gasket", holes),
        **_layer(measured, "top", holes),
        **_screws(measured, holes),
        **_cell(measured, holes),
        **_overlap(*deepest(measured)),
    }


def _base(measured: Measured) -> Findings:
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


def _layer(measured: Measured, layer: str, holes: tuple[Thread, ...]) -> Findings:
    """Height of gasket or top, and whether every screw passes its hole there without cutting into it."""
    off = measure.corner_height(measured, layer, len(holes))
    room = [measure.clearance(measured, layer, k) for k in range(len(holes))]
    apart = [measure.misfit(measured, layer, k) for k in range(len(holes))]
    hole = max(range(len(holes)), key=lambda k: apart[k] - room[k])
    return {
        f"{layer}_height": at_most(
            off * _MM, limits.LAYER_HEIGHT, "mm",
            f"farthest corner of the {layer} off its nominal {measure.under(layer) / INCH:.2f} in",
        ),
        f"{layer}_place": at_most(
            apart[hole] * _MM, round(room[hole] * _MM + limits.SOFT, 3), "mm",
            f"axis of screw hole {hole + 1} of the base from that of the {layer}",
        ),
    }  # fmt: skip


def _screws(measured: Measured, holes: tuple[Thread, ...]) -> Findings:
    size = dimensions()
    filled = [k for k, thread in enumerate(holes) if thread.screw is not None]
    gap = max(
        (abs(measure.head_gap(measured, k)) for k in filled), default=size("screw.length")
    )  # no screw is like one that stands full length high
    aside = max((measure.thread_offset(measured, k) for k in filled), default=0.0)
    lengths = [measure.thread_length(measured, k) for k in filled]
    lean = max((measure.screw_lean(measured, k) for k in filled), default=0.0)
    return {
        "screws": at_least(
            len({holes[k].screw for k in filled}), len(holes), "screws", "screws in their threads"
        ),
        "screws_depth": at_most(gap * _MM, limits.SCREW_GAP, "mm", "greatest gap under a screw's head"),
        "screws_thread": at_least(
            min(lengths, default=0.0) * _MM,
            limits.SCREW_THREAD,
            "mm",
            "shortest thread of a screw in the base",
        ),
        "screws_place": at_most(
            aside * _MM, limits.SCREW_PLACE, "mm", "farthest axis of a screw from that of its tapped hole"
        ),
        "screws_lean": at_most(degrees(lean), limits.SCREW_LEAN, "deg", "greatest lean of a screw"),
        "screws_crossed": at_most(
            sum(thread.crossed for thread in holes), 0, "screws", "cross-threaded screws"
        ),
        "threads_scarred": at_most(
            sum(thread.scarred for thread in holes), limits.SCARS, "threads",
            "threads that a crossed screw has scarred", caution=True,
        ),
    }  # fmt: skip


def _cell(measured: Measured, holes: tuple[Thread, ...]) -> Findings:
    screws = [f"screw{k}" for k in range(len(holes))]
    in_threads = {thread.screw for thread in holes}
    loose = [name for k, name in enumerate(screws) if k not in in_threads]
    parts = ("base", "gasket", "top", *_PINS, "driver", *loose)
    lowest = min(measured.pose(name)[2, 3] for name in parts)
    pins, dispenser, rack = (
        measured.strayed(things, places) * _MM
        for things, places in ((_PINS, _PINS), (loose, screws), (("driver",), ("driver",)))
    )
    lean = max(tilt(measured.pose(pin)) for pin in _PINS)
    return {
        "pins": at_most(pins, limits.PIN_PLACE, "mm", "farther pin from its hole in the holder"),
        "pins_tilt": at_most(degrees(lean), limits.PIN_TILT, "deg", "lean of a pin in its holder"),
        "rack": at_most(rack, limits.RACK_PLACE, "mm", "screwdriver from its rack"),
        "rack_tilt": at_most(
            degrees(tilt(measured.pose("driver"))),
            limits.RACK_TILT,
            "deg",
            "lean of the screwdriver in its rack",
        ),
        "dispenser": at_most(dispenser, limits.PIN_PLACE, "mm", "loose screw from the dispenser"),
        "floor": at_least(lowest * _MM, limits.FLOOR, "mm", "lowest part over the table top"),
        "hand": at_least(
            hand_room(measured, parts) * _MM, limits.HAND_CLEAR, "mm", "hand from the nearest part"
        ),
    }


def hand_room(measured: Measured, parts: Iterable[str]) -> float:
    """Distance of the hand from the nearest of some parts and what is fixed to them, m; at most twice its limit."""
    model = measured.model
    solid = (model.geom_contype | model.geom_conaffinity) != 0
    tree = model.body_rootid[model.geom_bodyid]
    arm = np.array([model.body(body).name.startswith(ARM) for body in model.geom_bodyid])
    mine = np.isin(tree, [model.body(part).id for part in parts])
    return measured.nearest(
        np.flatnonzero(arm & solid), np.flatnonzero(mine & solid), 2 * limits.HAND_CLEAR / _MM
    )


def _clamp(measured: Measured, holes: tuple[Thread, ...]) -> Finding:
    forces = [measure.head_force(measured, k) for k, thread in enumerate(holes) if thread.screw is not None]
    return at_least(min(forces, default=0.0), limits.SCREW_CLAMP, "N", "weakest clamp of a screw")


def _rotor(measured: Measured) -> Finding:
    torque = measure.rotor_torque(measured)
    value = torque if isfinite(torque) else 2 * limits.ROTOR_TORQUE  # did not turn all the way
    return at_most(
        value,
        limits.ROTOR_TORQUE,
        "N m",
        f"torque that turns the rotor {limits.ROTOR_SWING:.0f} degrees and back",
    )


def _overlap(bores: Overlap, others: Overlap) -> Findings:
    return {
        "overlap_bores": at_most(
            bores.depth * _MM,
            limits.SOFT,
            "mm",
            f"deepest cut of a shank or pin into a bore, of {bores.between}",
        ),
        "overlap": at_most(
            others.depth * _MM, limits.PENETRATION, "mm", f"deepest overlap, of {others.between}"
        ),
    }


def judge_apart(truth: Truth) -> Findings:
    """Measure the parts as they were left and when they have settled; the worse finding counts."""
    filled = sum(thread.screw is not None for thread in holes_of(truth))
    in_threads = at_most(filled, 0, "screws", "screws left in their threads")
    left, settled = _as_left_and_settled(truth)
    return {**worse(_apart(left), _apart(settled)), "screws_out": in_threads}


def _apart(measured: Measured) -> Findings:
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
