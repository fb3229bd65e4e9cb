"""The referee's findings on an assembled pump, and on a pump that was taken apart."""

from math import degrees, isfinite

import numpy as np

from handeye.cell.threads import Thread, holes_of
from handeye.cell.truth import Truth
from handeye.core.pose import yaw
from handeye.core.units import INCH
from handeye.judge.finding import Finding, Findings, at_least, at_most, worse
from handeye.judge.measured import SettledState, deg, mm, tilt
from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.water_pump.referee import limits, measure
from handeye.tasks.water_pump.referee.cell_findings import PARTS, around, loose_screws, made, resting
from handeye.tasks.water_pump.referee.measure import PINS


def judge(truth: Truth) -> Findings:
    """Measure the pump and its cell.

    Positions are measured twice: as the parts were left, and after they have settled. While the cell settles, a part
    without support falls, and a part that was pressed into another part springs out. The worse finding counts. The
    state of the cell is not changed.
    """
    left, settled = _as_left_and_settled(truth)
    holes = holes_of(truth)
    return {
        **worse(_places(left, holes), _places(settled, holes)),
        **_pressing(settled, holes),
        **resting(left, settled, holes),
        **made(left, truth),
        "rotor": _turning(settled),
    }


def _as_left_and_settled(truth: Truth) -> tuple[SettledState, SettledState]:
    return SettledState(truth), SettledState(truth, limits.SETTLE)


def _places(measured: SettledState, holes: tuple[Thread, ...]) -> Findings:
    return {
        **_base(measured),
        **_layer(measured, "gasket", holes),
        **_layer(measured, "top", holes),
        **_screws(measured, holes),
        **_rotor(measured),
        **_cell(measured, holes),
        **around(measured, holes),
    }


def _base(measured: SettledState) -> Findings:
    turn = degrees(yaw(measured.relative("base", "blocks")) % (2 * np.pi)) - 180
    X_WB = measured.pose("base")
    gaps = {side: abs(measured.gap("plate", f"block_{side}")) for side in ("far", "left")}
    return {
        **{
            f"base_{side}": mm(gap, limits.BLOCK_GAP, f"gap between the base and the {side} block")
            for side, gap in gaps.items()
        },
        "base_yaw": at_most(abs(turn), limits.BASE_YAW, "deg", "yaw of the base relative to the blocks"),
        "base_height": mm(abs(X_WB[2, 3]), limits.BASE_HEIGHT, "height of the base above the table"),
        "base_tilt": deg(tilt(X_WB), limits.BASE_TILT, "tilt of the base"),
    }  # fmt: skip


def _layer(measured: SettledState, layer: str, holes: tuple[Thread, ...]) -> Findings:
    """Judge one layer, which is the gasket or the top. The layer must be at its height, and no screw may cut into the
    layer's material at its hole.
    """
    off = measure.corner_height(measured, layer, len(holes))
    margin = [measure.clearance(measured, layer, k) for k in range(len(holes))]
    apart = [measure.misfit(measured, layer, k) for k in range(len(holes))]
    hole = max(range(len(holes)), key=lambda k: apart[k] - margin[k])
    return {
        f"{layer}_height": mm(
            off, limits.LAYER_HEIGHT,
            f"greatest deviation of the {layer}'s corners from their height of {measure.under(layer) / INCH:.2f} in",
        ),
        f"{layer}_place": mm(
            apart[hole], round(margin[hole] * 1e3 + limits.SOFT, 3),
            f"offset between the axes of screw hole {hole + 1} in the base and in the {layer}",
        ),
    }  # fmt: skip


def _screws(measured: SettledState, holes: tuple[Thread, ...]) -> Findings:
    size = dimensions()
    filled = [k for k, thread in enumerate(holes) if thread.screw is not None]
    gap = max(
        (abs(measure.head_gap(measured, k)) for k in filled), default=size("screw.length")
    )  # if there is none: like a screw whose full length stands out
    aside = max((measure.thread_offset(measured, k) for k in filled), default=0.0)
    length = min((measure.thread_length(measured, k) for k in filled), default=0.0)
    size_off = max(
        (
            measure.screw_deviation(measured, thread.screw, k)
            for k, thread in enumerate(holes)
            if thread.screw is not None
        ),
        default=0.0,
    )
    lean = max((measure.screw_lean(measured, k) for k in filled), default=0.0)
    crossed, scarred = sum(thread.crossed for thread in holes), sum(thread.scarred for thread in holes)
    return {
        "screws": at_least(
            len({holes[k].screw for k in filled}), len(holes), "screws", "screws in their threads"
        ),
        "screws_depth": mm(gap, limits.SCREW_GAP, "greatest gap under a screw's head"),
        "screws_thread": at_least(
            length * 1e3, limits.SCREW_THREAD, "mm", "shortest thread engagement of a screw in the base"
        ),
        "screws_place": mm(
            aside, limits.SCREW_PLACE, "greatest offset between the axes of a screw and its tapped hole"
        ),
        "screws_size": mm(
            size_off, limits.SCREW_SIZE,
            "greatest deviation of a screw's length or radius from the drawing",
        ),
        "screws_lean": deg(lean, limits.SCREW_LEAN, "greatest tilt of a screw"),
        "screws_crossed": at_most(crossed, 0, "screws", "cross-threaded screws"),
        "threads_scarred": at_most(
            scarred, limits.SCARS, "threads", "threads damaged by a cross-threaded screw", caution=True
        ),
    }  # fmt: skip


def _pressing(settled: SettledState, holes: tuple[Thread, ...]) -> Findings:
    """Judge the forces and torques of the screws. They can be measured only after the cell has settled."""
    filled = [k for k, thread in enumerate(holes) if thread.screw is not None]
    forces = [measure.head_force(settled, k) for k in filled]
    turned = [holes[k].clamp for k in filled]
    held = [measure.loosening_torque(settled, k) for k in filled]
    return {
        "screws_clamp": at_least(
            min(forces, default=0.0), limits.SCREW_CLAMP, "N", "smallest clamping force of a screw"
        ),
        "screws_strain": at_most(
            max(forces, default=0.0), limits.SCREW_STRAIN, "N", "greatest clamping force of a screw"
        ),
        "screws_turned": at_most(
            max(turned, default=0.0),
            limits.SCREW_TURNED,
            "N",
            "greatest clamping force reached while a screw was tightened",
        ),
        "screws_hold": at_least(
            min(held, default=0.0), limits.SCREW_HOLD, "N m", "smallest torque that loosens a screw"
        ),
    }


def _cell(measured: SettledState, holes: tuple[Thread, ...]) -> Findings:
    rack = measured.strayed(("driver",), ("driver",))
    dispenser = measured.strayed(loose_screws(holes), [f"screw{k}" for k in range(len(holes))])
    return {
        "pins": mm(
            measured.strayed(PINS, PINS),
            limits.PIN_PLACE,
            "greatest distance of a pin from its hole in the holder",
        ),
        "rack": mm(rack, limits.RACK_PLACE, "distance of the screwdriver from its place in the rack"),
        "dispenser": mm(
            dispenser, limits.PIN_PLACE, "greatest distance of a loose screw from its place in the dispenser"
        ),
    }


def _rotor(measured: SettledState) -> Findings:
    return {
        "rotor_place": mm(
            measure.rotor_deviation(measured),
            limits.ROTOR_PLACE,
            "greatest distance of the rotor or its crank pin from its nominal place",
        ),
        "rotor_lean": deg(
            measure.rotor_lean(measured), limits.ROTOR_LEAN, "tilt of the rotor relative to the top"
        ),
    }


def _turning(settled: SettledState) -> Finding:
    torque = measure.rotor_torque(settled)
    value = torque if isfinite(torque) else 2 * limits.ROTOR_TORQUE  # did not turn all the way
    return at_most(
        value,
        limits.ROTOR_TORQUE,
        "N m",
        "greatest torque to turn the rotor a full turn, in both directions",
    )


def judge_pins(truth: Truth) -> Findings:
    """Judge whether each aligning pin stands in one of the holes that the base has for pins. Each pin is judged twice:
    as the arm left it, and after it has settled. The worse finding counts.
    """
    left, settled = _as_left_and_settled(truth)
    return worse(_pinned(left), _pinned(settled))


def _pinned(measured: SettledState) -> Findings:
    away, lean = measure.pins_away(measured), measure.pins_lean(measured)
    return {
        "pins_seated": mm(
            away,
            limits.PIN_SEATED,
            "greatest distance of a pin's shoulder from the mouth of its hole in the base",
        ),
        "pins_lean": deg(lean, limits.PIN_LEAN, "greatest tilt of a pin relative to the base"),
    }


def judge_apart(truth: Truth) -> Findings:
    """Measure the parts of a pump that was taken apart: first as the arm left them, and again after they have settled.
    The worse finding counts.
    """
    holes = holes_of(truth)
    filled = sum(thread.screw is not None for thread in holes)
    left, settled = _as_left_and_settled(truth)
    return {
        **worse(_apart(left, holes), _apart(settled, holes)),
        **resting(left, settled, holes),
        **made(left, truth),
        "screws_out": at_most(filled, 0, "screws", "screws left in their threads"),
        "rotor": _turning(settled),
    }


def _apart(measured: SettledState, holes: tuple[Thread, ...]) -> Findings:
    screws = [f"screw{k}" for k in range(len(holes))]
    turned = max(measured.turned(name) for name in PARTS)
    apart = {"base": limits.APART, "gasket": limits.APART_GASKET, "top": limits.APART}
    return {
        **{
            f"{name}_back": mm(
                measured.strayed((name,), (name,)), limit,
                f"distance of the {name} from its place at the start of the run",
            )
            for name, limit in apart.items()
        },
        "parts_turn": deg(
            turned, limits.APART_TURN, "greatest rotation of base, gasket or top since the start of the run"
        ),
        **{
            name: mm(measured.strayed(things, things), limits.APART, what)
            for name, things, what in (
                ("pins", PINS, "greatest distance of a pin from its hole in the holder"),
                ("dispenser", screws, "greatest distance of a screw from its place in the dispenser"),
                ("rack", ("driver",), "distance of the screwdriver from its place in the rack"),
            )
        },
        **_rotor(measured),
        **around(measured, holes),
    }  # fmt: skip
