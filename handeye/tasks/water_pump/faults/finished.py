"""Mishaps to finished work: a screw comes loose, a part or tool is taken away or raised, or the rotor jams or meets
a stop.
"""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Final

import numpy as np

from handeye.cell.physics_stepper import wake
from handeye.core.errors import FORCE_WRONG, GASKET_WRONG, NOTHING_HELD, SERVO_LAG, WRONG_HEIGHT
from handeye.core.faults import ExpectedDetection, Size, SpoiledWork
from handeye.tasks.water_pump.faults import shared_expectations as detect
from handeye.tasks.water_pump.faults.declaration import declared
from handeye.tasks.water_pump.faults.mishap import ON_BASE_M, Mishap, MishapFault, MishapState, Scene, always
from handeye.tasks.water_pump.faults.scene_changes import METAL

LAST_STAGE: Final = 12
LATER_S: Final = 150.0
"""Time (s) from the beginning of the last stage to the fault. At this time, the screws have been driven again, but no
picture has been taken.
"""
JAM_FRICTION_NM: Final = 20.0  # more than the arm can turn
STICKING_N: Final = 50.0  # vertically; more than the weight of the screwdriver and fingers that press on it
_FALLING: Final = ("floor", "still", "rest")  # findings on a part that falls onto the tray under the floor
_FREE_RAD: Final = 1e3  # beyond any turn of the rotor


def _loose(screw: int, turns: float | None, scene: Scene, _: MishapState) -> bool:
    """As soon as a screw is in its thread and the bit has left the screw, loosen the screw by `turns`. If `turns` is
    None, take the screw away.
    """
    assert scene.threads is not None
    if not scene.threads.loosen(screw, turns):
        return False
    if turns is None:
        scene.take(f"screw{screw}")
    return True


def _loosened(screw: int, turns: float, scene: Scene, state: MishapState) -> bool:
    """Let a person loosen a screw some time after the stage began."""
    return (state.seconds or 0.0) >= LATER_S and _loose(screw, turns, scene, state)


def _take(part: str, scene: Scene, _: MishapState) -> bool:
    scene.take(part)
    return True


def _take_layer(part: str, scene: Scene, _: MishapState) -> bool:
    """Take the gasket or the top away. If a screw holds the layers, or the top covers the gasket, leave the part in
    place.
    """
    assert scene.threads is not None
    over = scene.place("top") - scene.place("gasket")
    covered = part == "gasket" and np.hypot(*over[:2]) < ON_BASE_M and over[2] > 0
    if not (covered or any(thread.screw is not None for thread in scene.threads.holes)):
        scene.take(part)
    return True


def _rotor(scene: Scene) -> tuple[int, int]:
    """Return the indices of the rotor's joint and degree of freedom, and wake the rotor's body."""
    joint = int(scene.model.joint("rotor").id)
    dof = int(scene.model.jnt_dofadr[joint])
    wake(scene.data, dof)
    return joint, dof


def _jam(scene: Scene, _: MishapState) -> bool:
    dof = _rotor(scene)[1]
    scene.model.dof_frictionloss[dof] = JAM_FRICTION_NM
    return True


def _stop(angle: float) -> Mishap:
    """Return a mishap in which the rotor meets a stop at an angle (rad) from the rotor's present position. In the
    other direction, the rotor can still turn freely.
    """

    def act(scene: Scene, _: MishapState) -> bool:
        joint = _rotor(scene)[0]
        there = float(scene.data.qpos[scene.model.jnt_qposadr[joint]]) + angle
        scene.model.jnt_limited[joint] = 1
        scene.model.jnt_solref[joint], scene.model.jnt_solimp[joint] = METAL
        scene.model.jnt_range[joint] = (-_FREE_RAD, there) if angle > 0 else (there, _FREE_RAD)
        return True

    return Mishap(act)


def _turn(angle: float) -> Mishap:
    """Return a mishap in which a person turns the rotor by an angle (rad)."""

    def act(scene: Scene, _: MishapState) -> bool:
        joint, dof = _rotor(scene)
        scene.data.qpos[scene.model.jnt_qposadr[joint]] += angle
        scene.data.qvel[dof] = 0.0
        return True

    return Mishap(act)


def _lift(height: float) -> Mishap:
    """Return a mishap in which the rotor comes out of its bearing by `height` (m)."""

    def act(scene: Scene, _: MishapState) -> bool:
        _rotor(scene)
        scene.model.body_pos[scene.model.body("rotor").id, 2] += height
        return True

    return Mishap(act)


def _raise(height: float) -> Mishap:
    """Return a mishap in which the screwdriver sticks in its rack, too high by `height` (m)."""

    def act(scene: Scene, _: MishapState) -> bool:
        scene.shift("driver", np.array([0.0, 0.0, height]))
        dof = scene.dofs("driver").start + 2
        scene.model.dof_frictionloss[dof] = STICKING_N
        scene.model.dof_solref[dof], scene.model.dof_solimp[dof] = METAL
        return True

    return Mishap(act)


def _with_turns(screw: int) -> Callable[[float], Mishap]:
    return lambda turns: Mishap(partial(_loose, screw, turns))


def _loosened_by(screw: int) -> Callable[[float], Mishap]:
    return lambda turns: Mishap(partial(_loosened, screw, turns))


def faults_of_finished_work() -> Iterator[MishapFault]:
    """Yield all mishaps to finished work, in the order of the catalogue."""
    yield from _screws()
    yield from _rotors()
    yield from _taken()


def _screws() -> Iterator[MishapFault]:
    size = Size(unit="", usual=0.25, limits=(0.05, 10.0))
    for number in range(1, len(detect.SCREWED) + 1):
        expected = ExpectedDetection(
            errors=(FORCE_WRONG,),  # the hand comes down on a head that stands far out
            calls=(detect.untight_screw(number), detect.shifted_head(number)),
            harmless="Each screw is driven again, to the torque stop, before the program calls the pump finished.",
        )
        meaning = f"After screw {number} was driven, it works loose by this number of turns."
        yield declared(
            f"screw.{number}.loose", meaning, _with_turns(number - 1), expected, size, stage=LAST_STAGE,
            spoils=_screw(number),
        )  # fmt: skip
    size = Size(unit="", usual=1.5, limits=(0.05, 6.0))
    for number in range(1, len(detect.SCREWED) + 1):
        expected = ExpectedDetection(
            errors=(FORCE_WRONG,),  # the hand comes down on a head that stands far out
            calls=(detect.high_head(number),),
        )
        meaning = (
            f"A person loosens screw {number} by this number of turns, {LATER_S:.0f} s after the stage began. In "
            "the last stage, the program has finished tightening the screws by then."
        )
        yield declared(
            f"screw.{number}.loosened", meaning, _loosened_by(number - 1), expected, size, stage=LAST_STAGE,
            spoils=_screw(number, delay=LATER_S),
        )  # fmt: skip
    for number in range(1, len(detect.SCREWED) + 1):
        expected = ExpectedDetection(
            calls=(detect.missing_head(number), detect.untight_screw(number), detect.unfelt_head(number))
        )
        meaning = f"After the screwdriver has left screw {number}, the screw is turned out and taken away."
        yield declared(
            f"screw.{number}.removed", meaning, always(Mishap(partial(_loose, number - 1, None))), expected,
            stage=LAST_STAGE,
        )  # fmt: skip


def _screw(number: int, delay: float = 0.0) -> SpoiledWork:
    loose = ("screws_depth", "screws_thread", "screws_clamp")
    return SpoiledWork(findings=loose, where=f"hole {detect.SCREWED[number - 1]}", delay=delay)


def _rotors() -> Iterator[MishapFault]:
    turning = SpoiledWork(findings=("rotor", "as_drawn"))
    hard = ExpectedDetection(calls=(detect.STIFF_ROTOR,))
    yield declared("rotor.jammed", "The rotor does not turn.", always(Mishap(_jam)), hard, spoils=turning)
    size = Size(unit="deg", usual=75.0, limits=(-170.0, 170.0))
    meaning = "The rotor meets a stop at this angle from its present position."
    yield declared("rotor.stops", meaning, _stop, hard, size, stage=LAST_STAGE, spoils=turning)
    expected = ExpectedDetection(
        errors=(FORCE_WRONG, SERVO_LAG),
        calls=(detect.CRANK_ASTRAY,),
        harmless="Fingers that close on the crank find the crank if it is near its expected place.",
    )
    meaning = "A person turns the rotor by this angle."
    yield declared("rotor.turned", meaning, _turn, expected, size, stage=LAST_STAGE)
    out = ExpectedDetection(calls=(detect.UNSEATED_ROTOR,))
    size = Size(unit="mm", usual=4.0, limits=(2.0, 10.0))
    meaning = "The rotor has come out of its bearing by this distance."
    yield declared("rotor.lifted", meaning, _lift, out, size, stage=LAST_STAGE)


def _taken() -> Iterator[MishapFault]:
    for number in (1, 2):
        expected = ExpectedDetection(errors=(NOTHING_HELD,), calls=(detect.missing_pin(number),))
        meaning = f"A person removes aligning pin {number}."
        yield declared(
            f"pin.{number}.removed", meaning, always(Mishap(partial(_take, f"pin{number - 1}"))), expected,
            stage=LAST_STAGE, spoils=SpoiledWork(findings=("pins", *_FALLING), where=f"pin {number}"),
        )  # fmt: skip
    expected, racked = (
        ExpectedDetection(calls=(detect.NO_DRIVER,)),
        SpoiledWork(findings=("rack", "as_drawn", *_FALLING)),
    )
    meaning = "The screwdriver falls from its rack."
    yield declared(
        "driver.fallen", meaning, always(Mishap(partial(_take, "driver"))), expected, stage=LAST_STAGE,
        spoils=racked,
    )  # fmt: skip
    size = Size(unit="mm", usual=6.0, limits=(4.5, 10.0))
    meaning = "The screwdriver sticks in its rack, too high by this distance."
    yield declared("driver.raised", meaning, _raise, expected, size, stage=LAST_STAGE, spoils=racked)
    for part, expected, stage in (
        (
            "gasket",
            ExpectedDetection(errors=(GASKET_WRONG, WRONG_HEIGHT), calls=(detect.NOT_ON, detect.TOO_LOW)),
            6,
        ),
        ("top", ExpectedDetection(calls=(detect.driven_loose_screw(1), detect.loose_screw(1))), 8),
    ):
        meaning = f"A person removes the {part}, if nothing holds it."
        yield declared(
            f"{part}.removed", meaning, always(Mishap(partial(_take_layer, part))), expected, stage=stage
        )
