"""Builds the work cell of the water pump from its scene, its devices, the threads of its screws, and the
clamping of its layers."""

import mujoco

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.arm import SimulatedArm
from handeye.cell.camera import SimulatedCamera, make_renderer
from handeye.cell.hand import SimulatedHand, SimulatedLamp, SimulatedScrewdriver
from handeye.cell.physics_stepper import Carrying
from handeye.cell.rendering import RendererMaker
from handeye.cell.signal_lines import SignalLines
from handeye.cell.simulated import SimulatedCell
from handeye.cell.threads import THREAD_FRICTION, ThreadFigures, Threads
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.tasks.water_pump.clamping import Clamping
from handeye.tasks.water_pump.clear_shanks import ClampedStepper
from handeye.tasks.water_pump.faults.before import bad_threads, slipping_screws
from handeye.tasks.water_pump.faults.devices import defects
from handeye.tasks.water_pump.faults.during import Mishaps, due
from handeye.tasks.water_pump.faults.mishap import Scene
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.world.nominal import DRAWING
from handeye.tasks.water_pump.world.pump_world import PumpWorld


def build_cell(world: PumpWorld, *, camera: str | RendererMaker = "auto", rest: bool = True) -> SimulatedCell:
    """Build the cell of a world.

    To save computing time, parts at rest sleep, and clamped parts are welded together. If `rest` is False, parts
    neither sleep nor are welded: the physics is the same, but the simulation is slower.

    `camera` is the renderer: `auto`, `gl` or `ray`, or a function that makes a renderer. Raises InvalidInput if this
    renderer does not work on this computer.
    """
    model = build(world)
    data = mujoco.MjData(model)
    noise, lines = world.generator("sensors"), SignalLines(defects(world.drawn.spec.faults))
    arm = SimulatedArm(
        model, data, ARM, arm=STANFORD, posture=PARK, errors=world.arm, noise=noise, lines=lines
    )
    hand = SimulatedHand(model, data, ARM, hand=STANFORD.hand, errors=world.hand, noise=noise, lines=lines)
    driver = SimulatedScrewdriver(
        model, data, ("drive", "spindle"), torque_noise=world.hand.torque_noise, noise=noise,
        watchdog=arm.watchdog, lines=lines,
    )  # fmt: skip
    faults = world.drawn.spec.faults
    figures = ThreadFigures(
        phases=world.thread_phase,
        friction=THREAD_FRICTION * world.friction["thread"],
        scarred=bad_threads(faults, "scarred"),
        crossing=bad_threads(faults, "crosses"),
        slipping=slipping_screws(faults, len(world.thread_phase)),
    )
    threads = Threads(model, data, driver, figures, lines)
    clamping = Clamping(model, data, threads, allowed=rest)
    mishaps = (Mishaps(Scene(model, data, threads), faults),) if due(faults) else ()
    return SimulatedCell(
        model,
        data,
        arm=arm,
        hand=hand,
        screwdriver=driver,
        lamp=SimulatedLamp(model, f"{ARM}lamp", lines),
        camera=SimulatedCamera(
            data, world.camera, world.generator("camera"), make_renderer(camera, model), DRAWING, lines
        ),
        mechanisms=(*mishaps, threads, clamping),
        lines=lines,
        stepper=ClampedStepper(model, data, carrying(world.screws), clamping, world.screws),
        noise=noise,
    )


def carrying(screws: int) -> Carrying:
    """List the pairs of bodies that may touch while the simulator takes long steps: the hand and a loose part that it
    holds, and the screwdriver and its screw. Steps of middle length have conditions of their own: the screwdriver
    touches no body, the hand does not touch the base, and no screw turns in its thread. All other contacts are allowed
    in these steps.
    """
    hand, driver, fastened = f"{ARM}link6", "driver", [f"screw{k}" for k in range(screws)]
    loose = ("base", "gasket", "top", "pin0", "pin1", driver, *fastened)
    held = [(hand, part) for part in loose]
    return Carrying(
        hand=hand,
        pairs=(*held, *((driver, screw) for screw in fastened)),
        delicate=((driver,), (hand, "base")),
        resting=tuple(f"thread_turn{k}" for k in range(screws)),
    )
