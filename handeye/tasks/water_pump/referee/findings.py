"""The referee's findings on a finished pump, and on one that was taken apart, point by point."""

from collections.abc import Iterable, Sequence
from math import degrees, isfinite
from typing import Final

import numpy as np

from handeye.cell.threads import Thread, holes_of
from handeye.cell.truth import Truth
from handeye.core.pose import yaw
from handeye.core.units import INCH
from handeye.judge.finding import Finding, Findings, at_least, at_most, worse
from handeye.judge.measured import SettledState, tilt
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.water_pump.referee import limits, measure
from handeye.tasks.water_pump.referee.measure import deepest

_PINS: Final = ("pin0", "pin1")
_PARTS: Final = {"base": limits.APART, "gasket": limits.APART_GASKET, "top": limits.APART}


def judge(truth: Truth) -> Findings:
    """Measure the pump and its cell.

    Places are measured twice, as parts were left and when they have settled, and the worse finding counts: what hangs
    in the air falls, and what was pressed into something springs out. The state of the cell is not touched.
    """
    left, settled = _as_left_and_settled(truth)
    holes = holes_of(truth)
    forces = [measure.head_force(settled, k) for k, thread in enumerate(holes) if thread.screw is not None]
    clamp, torque = min(forces, default=0.0), measure.rotor_torque(settled)
    value = torque if isfinite(torque) else 2 * limits.ROTOR_TORQUE  # did not turn all the way
    return {
        **worse(_places(left, holes), _places(settled, holes)),
        "screws_clamp": at_least(clamp, limits.SCREW_CLAMP, "N", "weakest clamp of a screw"),
        "rotor": at_most(
            value,
            limits.ROTOR_TORQUE,
            "N m",
            f"torque that turns the rotor {limits.ROTOR_SWING:.0f} degrees and back",
        ),
    }


def _as_left_and_settled(truth: Truth) -> tuple[SettledState, SettledState]:
    return SettledState(truth), SettledState(truth, limits.SETTLE)


def _places(measured: SettledState, holes: tuple[Thread, ...]) -> Findings:
    bores, others = deepest(measured)
    return {
        **_base(measured),
        **_layer(measured, "gasket", holes),
        **_layer(measured, "top", holes),
        **_screws(measured, holes),
        **_cell(measured, holes),
        "overlap_bores": _mm(
            bores.depth, limits.SOFT, f"deepest cut of a shank or pin into a bore, of {bores.between}"
        ),
        "overlap": _mm(others.depth, limits.PENETRATION, f"deepest overlap, of {others.between}"),
    }


def _mm(value_m: float, limit_mm: float, subject: str) -> Finding:
    return at_most(value_m * 1e3, limit_mm, "mm", subject)


def _deg(value_rad: float, limit_deg: float, subject: str) -> Finding:
    return at_most(degrees(value_rad), limit_deg, "deg", subject)


def _base(measured: SettledState) -> Findings:
    turn = degrees(yaw(measured.relative("base", "blocks")) % (2 * np.pi)) - 180
    X_WB = measured.pose("base")
    gaps = {side: abs(measured.gap("plate", f"block_{side}")) for side in ("far", "left")}
    return {
        **{
            f"base_{side}": _mm(gap, limits.BLOCK_GAP, f"gap between the base and the {side} block")
            for side, gap in gaps.items()
        },
        "base_yaw": at_most(abs(turn), limits.BASE_YAW, "deg", "turn of the base against the blocks"),
        "base_height": _mm(abs(X_WB[2, 3]), limits.BASE_HEIGHT, "height of the base off the table"),
        "base_tilt": _deg(tilt(X_WB), limits.BASE_TILT, "tilt of the base"),
    }  # fmt: skip


def _layer(measured: SettledState, layer: str, holes: tuple[Thread, ...]) -> Findings:
    """Height of gasket or top, and whether every screw passes its hole there without cutting into it."""
    off = measure.corner_height(measured, layer, len(holes))
    margin = [measure.clearance(measured, layer, k) for k in range(len(holes))]
    apart = [measure.misfit(measured, layer, k) for k in range(len(holes))]
    hole = max(range(len(holes)), key=lambda k: apart[k] - margin[k])
    return {
        f"{layer}_height": _mm(
            off, limits.LAYER_HEIGHT,
            f"farthest corner of the {layer} off its nominal {measure.under(layer) / INCH:.2f} in",
        ),
        f"{layer}_place": _mm(
            apart[hole], round(margin[hole] * 1e3 + limits.SOFT, 3),
            f"axis of screw hole {hole + 1} of the base from that of the {layer}",
        ),
    }  # fmt: skip


def _screws(measured: SettledState, holes: tuple[Thread, ...]) -> Findings:
    size = dimensions()
    filled = [k for k, thread in enumerate(holes) if thread.screw is not None]
    gap = max(
        (abs(measure.head_gap(measured, k)) for k in filled), default=size("screw.length")
    )  # no screw is like one that stands full length high
    aside = max((measure.thread_offset(measured, k) for k in filled), default=0.0)
    length = min((measure.thread_length(measured, k) for k in filled), default=0.0)
    lean = max((measure.screw_lean(measured, k) for k in filled), default=0.0)
    crossed, scarred = sum(thread.crossed for thread in holes), sum(thread.scarred for thread in holes)
    return {
        "screws": at_least(
            len({holes[k].screw for k in filled}), len(holes), "screws", "screws in their threads"
        ),
        "screws_depth": _mm(gap, limits.SCREW_GAP, "greatest gap under a screw's head"),
        "screws_thread": at_least(
            length * 1e3, limits.SCREW_THREAD, "mm", "shortest thread of a screw in the base"
        ),
        "screws_place": _mm(aside, limits.SCREW_PLACE, "farthest axis of a screw from that of its tapped hole"),
        "screws_lean": _deg(lean, limits.SCREW_LEAN, "greatest lean of a screw"),
        "screws_crossed": at_most(crossed, 0, "screws", "cross-threaded screws"),
        "threads_scarred": at_most(
            scarred, limits.SCARS, "threads", "threads that a crossed screw has scarred", caution=True
        ),
    }  # fmt: skip


def _cell(measured: SettledState, holes: tuple[Thread, ...]) -> Findings:
    screws = [f"screw{k}" for k in range(len(holes))]
    in_threads = {thread.screw for thread in holes}
    loose = [name for k, name in enumerate(screws) if k not in in_threads]
    parts = ("base", "gasket", "top", *_PINS, "driver", *loose)
    lowest = min(measured.pose(name)[2, 3] for name in parts)
    rack = measured.strayed(("driver",), ("driver",))
    dispenser = measured.strayed(loose, screws)
    return {
        "pins": _mm(measured.strayed(_PINS, _PINS), limits.PIN_PLACE, "farther pin from its hole in the holder"),
        "pins_tilt": _tilt(measured, _PINS, limits.PIN_TILT, "lean of a pin in its holder"),
        "rack": _mm(rack, limits.RACK_PLACE, "screwdriver from its rack"),
        "rack_tilt": _tilt(measured, ("driver",), limits.RACK_TILT, "lean of the screwdriver in its rack"),
        "dispenser": _mm(dispenser, limits.PIN_PLACE, "loose screw from the dispenser"),
        "floor": at_least(lowest * 1e3, limits.FLOOR, "mm", "lowest part over the table top"),
        "hand": _hand(measured, parts),
    }  # fmt: skip


def _tilt(measured: SettledState, bodies: Sequence[str], limit_deg: float, subject: str) -> Finding:
    return _deg(max(tilt(measured.pose(body)) for body in bodies), limit_deg, subject)


def _hand(measured: SettledState, parts: Iterable[str]) -> Finding:
    """Distance of the hand from the nearest of some parts and what is fixed to them; at most twice its limit."""
    model = measured.model
    solid = (model.geom_contype | model.geom_conaffinity) != 0
    tree = model.body_rootid[model.geom_bodyid]
    arm = np.array([model.body(body).name.startswith(ARM) for body in model.geom_bodyid])
    mine = np.isin(tree, [model.body(part).id for part in parts])
    nearest = measured.nearest(
        np.flatnonzero(arm & solid), np.flatnonzero(mine & solid), 2 * limits.HAND_CLEAR / 1e3
    )
    return at_least(nearest * 1e3, limits.HAND_CLEAR, "mm", "hand from the nearest part")


def judge_apart(truth: Truth) -> Findings:
    """Measure the parts as they were left and when they have settled; the worse finding counts."""
    filled = sum(thread.screw is not None for thread in holes_of(truth))
    in_threads = at_most(filled, 0, "screws", "screws left in their threads")
    left, settled = _as_left_and_settled(truth)
    return {**worse(_apart(left), _apart(settled)), "screws_out": in_threads}


def _apart(measured: SettledState) -> Findings:
    names = [measured.model.body(number).name for number in range(measured.model.nbody)]
    screws = [name for name in names if name.startswith("screw") and name[5:].isdecimal()]
    turned = max(measured.turned(name) for name in _PARTS)
    return {
        **{
            f"{name}_back": _mm(measured.strayed((name,), (name,)), limit, f"{name} from where the run found it")
            for name, limit in _PARTS.items()
        },
        "parts_turn": _deg(
            turned, limits.APART_TURN, "turn of base, gasket or top against how the run found it"
        ),
        **{
            name: _mm(measured.strayed(things, things), limits.APART, what)
            for name, things, what in (
                ("pins", _PINS, "farther pin from its hole in the holder"),
                ("dispenser", screws, "farthest screw from its place in the dispenser"),
                ("rack", ("driver",), "screwdriver from its rack"),
            )
        },
        "pins_tilt": _tilt(measured, _PINS, limits.PIN_TILT, "lean of a pin in its holder"),
        "rack_tilt": _tilt(measured, ("driver",), limits.RACK_TILT, "lean of the screwdriver in its rack"),
        "hand": _hand(measured, (*_PARTS, *_PINS, "driver", *screws)),
    }  # fmt: skip
