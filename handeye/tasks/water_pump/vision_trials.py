"""Trials of vision: the base on the belt and the gasket, over many worlds, counted."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from msgspec.structs import replace

from handeye.cell.still_cell import StillCell
from handeye.ports.camera import CLOSE_UP, LENSES, WIDE, Picture, TvCamera
from handeye.pose import Array, planar, translated, yaw
from handeye.program.cause_text import cause_sentence
from handeye.program.program import Hole, Part
from handeye.tasks.interface import Count
from handeye.tasks.water_pump.dimensions import dimensions
from handeye.tasks.water_pump.drawing import base_top, pin_seat, screw_holes, standard
from handeye.tasks.water_pump.eye import DRAWING
from handeye.tasks.water_pump.park import PARK
from handeye.tasks.water_pump.pump_world import PumpWorld
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.scene.arm import ARM
from handeye.tasks.water_pump.variation import BELT_LINE, BELT_X, BELT_Y
from handeye.units import DEGREE, INCH
from handeye.variation import WorldSpec
from handeye.vision.base import (
    Failure,
    GeneralLocation,
    SpecificLocation,
    locate_general,
    locate_specific,
)
from handeye.vision.calibration import Calibration, Sighting, calibrate
from handeye.vision.camera_model import CameraModel, View
from handeye.vision.gasket import inspect
from handeye.vision.holes import hole_places

WITHIN: Final = (INCH / 3, INCH / 4)
"""Accuracy of the eye by the paper, in X and in Y."""
WRONG: Final = 5.0
"""A hole found more than this many picture points off is another thing, whatever the camera's error."""
RIGHT: Final = "right"
GASKETS: Final[dict[str, float | None]] = {RIGHT: 0.0, "shifted .15": 0.15, "shifted .3": 0.3, "absent": None}
"""Cases, and how far off the gasket lies, in: on properly within .02 in and .3 deg; off in any direction; not there."""
SPOTS: Final = 20
ARM_ERROR: Final = 0.1 * INCH
SPOT_ERROR: Final = 0.5
"""Calibration: spots for each lens, largest error of the arm on each axis, points of noise."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BaseCounts:
    """Errors are those of found bases, m and rad, root mean square of x, y and yaw."""

    tried: int
    found: int
    wrong: int
    within: int
    rms: tuple[float, float, float]
    failures: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class GasketCounts:
    """How often each of GASKETS was called right."""

    tried: int
    accepted: dict[str, int]


class StillPump(StillCell):
    """The cell of a world before it has moved, its arm parked."""

    def __init__(self, world: PumpWorld, *, renderer: str = "auto") -> None:
        self.world = world
        posture = {f"{ARM}j{number}": float(q) for number, q in enumerate(PARK, 1)}
        super().__init__(
            build(world), posture=posture, drawing=DRAWING, errors=world.camera,
            noise=world.generator("camera"), renderer=renderer,
        )  # fmt: skip


def pump_base(at: tuple[float, float, float, float] | None = None) -> Part:
    """The pump base as a program describes it, by the dimensions of the scene; on the belt by default."""
    d = dimensions()
    first = Hole(x=0.0, y=0.0, diameter=d("base.large_hole_1.diameter"))
    second = Hole(x=d("base.large_hole_2.x"), y=0.0, diameter=d("base.large_hole_2.diameter"))
    middle, length, width = d("base.plate.centre_x"), d("base.plate.length"), d("base.plate.width")
    (x0, x1), (y0, y1) = BELT_X, BELT_Y
    belt = ((x0 + x1) / 2 * INCH, (y0 + y1) / 2 * INCH, d("belt.height"), sum(BELT_LINE) / 2 * DEGREE)
    return Part(
        at=at or belt,
        face=base_top(),
        holes=(first, second),
        screw_holes=tuple(
            Hole(x=x, y=y, diameter=2 * d("base.screw_holes.radius")) for x, y in screw_holes()
        ),
        region=((x1 - x0) / 2 * INCH, (y1 - y0) / 2 * INCH),
        outline=(middle - length / 2, -width / 2, middle + length / 2, width / 2),
    )


def look(camera: TvCamera, known: CameraModel, lens: float, point: tuple[float, float, float]) -> View:
    """Turn the lens, aim and focus as the executor does; what the program then believes to see."""
    camera.lens(lens)
    camera.aim(*known.aim(point, lens))
    camera.focus(math.dist(point, known.mount))
    return known.view(lens, *camera.pots())


def locate(
    camera: TvCamera, known: CameraModel, part: Part
) -> tuple[SpecificLocation | Failure, list[tuple[Picture, View, GeneralLocation | None]]]:
    """Both stages, with the pictures they used."""
    x, y, z, _ = part.at
    view = look(camera, known, WIDE, (x, y, z))
    picture, _ = camera.digitise()
    general = locate_general(picture, view, part)
    if isinstance(general, Failure):
        return general, [(picture, view, None)]
    pictures: list[tuple[Picture, View, GeneralLocation | None]] = [(picture, view, general)]
    middle = np.mean(general.corners, axis=0)
    view = look(camera, known, CLOSE_UP, (float(middle[0]), float(middle[1]), float(middle[2])))
    picture, _ = camera.digitise()
    pictures.append((picture, view, None))
    return locate_specific(picture, view, part, general), pictures


def base_trial(n: int, first: WorldSpec, *, renderer: str, camera: str) -> Count:
    """Counts of `base_trials`, in words."""
    counts = base_trials(n, first, renderer=renderer, camera=camera)
    x, y, turn = counts.rms
    lines = (
        f"found {counts.found} of {counts.tried}, {counts.wrong} of them wrong",
        f"{counts.within} within {WITHIN[0] / INCH:.2f} x {WITHIN[1] / INCH:.2f} in",
        f"rms error {x / INCH:.3f} in, {y / INCH:.3f} in, {turn / DEGREE:.2f} deg",
        *counts.failures,
    )
    return Count(lines=lines, wrong=counts.wrong)


def gasket_trial(n: int, first: WorldSpec, *, renderer: str) -> Count:
    """Counts of `gasket_trials`, in words."""
    accepted = gasket_trials(n, first, renderer=renderer).accepted
    lines = tuple(f"{case:12} accepted {count} of {n}" for case, count in accepted.items())
    return Count(lines=lines, wrong=sum(accepted[case] for case in GASKETS if case != RIGHT))


def base_trials(n: int, first: WorldSpec, *, renderer: str = "auto", camera: str = "true") -> BaseCounts:
    """Locate the base in `n` worlds from `first` on.

    Args:
        camera: what the program knows of it: `true`, `drawn` or `calibrated`.
    """
    part = pump_base()
    errors, failures, wrong = [], [], 0
    for world in _worlds(first, n):
        still = StillPump(world, renderer=renderer)
        location, _ = locate(still.camera, _known(camera, still, part), part)
        if isinstance(location, Failure):
            failures.append(f"{world.drawn.spec.seed}: {cause_sentence(location.cause)}")
            continue
        error = _error(location.pose, (world.base.x, world.base.y, world.base.yaw))
        wrong += _is_wrong(location, still, part)
        errors.append(error)
    table = np.abs(np.array(errors).reshape(-1, 3))
    return BaseCounts(
        tried=n,
        found=len(errors),
        wrong=wrong,
        within=int(np.sum(np.all(table[:, :2] <= WITHIN, axis=1))),
        rms=(_rms(table[:, 0]), _rms(table[:, 1]), _rms(table[:, 2])),
        failures=tuple(failures),
    )


def _worlds(first: WorldSpec, n: int) -> Iterator[PumpWorld]:
    """So many worlds, of this seed and those that follow it."""
    for seed in range(first.seed, first.seed + n):
        yield PumpWorld.draw(replace(first, seed=seed))


def _known(camera: str, still: StillPump, part: Part) -> CameraModel:
    if camera == "true":
        return still.true_camera
    return DRAWING if camera == "drawn" else simulated_calibration(still, part).model


def gasket_trials(n: int, first: WorldSpec, *, renderer: str = "auto") -> GasketCounts:
    """Inspect the gasket in `n` worlds from `first` on, in every one of GASKETS; with a calibrated camera."""
    part = pump_base(_standard())
    accepted = dict.fromkeys(GASKETS, 0)
    for world in _worlds(first, n):
        still = StillPump(world, renderer=renderer)
        rng = world.generator("trial.gasket")
        base = _jittered(part.at, rng, 0.03)
        put_base(still, base, pins=True)
        x, y, z, _ = part.at
        view = look(still.camera, simulated_calibration(still, part).model, CLOSE_UP, (x, y, z + part.face))
        before, _ = still.camera.digitise()
        for name in GASKETS:
            after = _with_gasket(still, base, name, rng)
            accepted[name] += inspect(before, after, view, part, part.at[:2] + part.at[3:]).ok
    return GasketCounts(tried=n, accepted=accepted)


def put_base(still: StillPump, place: tuple[float, float, float, float], *, pins: bool) -> None:
    """Put the base at x, y, z (m), yaw (rad), with the aligning pins in it or where they are."""
    X_WP = planar(*place)
    still.put("base", X_WP)
    d = dimensions()
    seat = base_top() + pin_seat(d("base.screw_holes.chamfer"), d("base.screw_holes.radius"))
    for number, hole in enumerate(d.all("base.screw_holes.pinned") if pins else ()):
        x, y = screw_holes()[int(hole)]
        still.put(f"pin{number}", X_WP @ planar(x, y, seat, 0.0))


def _with_gasket(
    still: StillPump, base: tuple[float, float, float, float], case: str, rng: np.random.Generator
) -> Picture:
    """The picture after, with the target voltage of the one before; the gasket is put back on its stand."""
    on_base = planar(0.0, 0.0, base_top(), 0.0)
    X_WP = planar(*base) @ on_base
    stand = still.pose("gasket")
    off = GASKETS[case]
    if case == RIGHT:
        still.put("gasket", planar(*_jittered((*X_WP[:3, 3], base[3]), rng, 0.02)))
    elif off is not None:
        direction = rng.uniform(0, 2 * math.pi)
        away = off * INCH
        still.put("gasket", translated(X_WP, (away * math.cos(direction), away * math.sin(direction), 0.0)))
    after, _ = still.camera.digitise(hold_target=True)
    still.put("gasket", stand)
    return after


def _standard() -> tuple[float, float, float, float]:
    X_WP = standard()
    return float(X_WP[0, 3]), float(X_WP[1, 3]), float(X_WP[2, 3]), yaw(X_WP)


def _jittered(
    place: tuple[float, ...], rng: np.random.Generator, amount: float
) -> tuple[float, float, float, float]:
    """Off by at most `amount` inches in x and y, and .3 degrees."""
    x, y, z, turn = place
    dx, dy = rng.uniform(-amount, amount, 2) * INCH
    return x + float(dx), y + float(dy), z, turn + float(rng.uniform(-0.3, 0.3)) * DEGREE


def simulated_calibration(still: StillPump, part: Part) -> Calibration:
    """Calibrate as by a lamp that the arm carries to random places over the belt, without rendering any."""
    rng = still.world.generator("trial.calibration")
    x, y, z, _ = part.at
    sightings = []
    for lens in LENSES:
        for _ in range(SPOTS):
            lamp = np.array([x, y, z]) + rng.uniform((-0.12, -0.12, 0.01), (0.12, 0.12, 0.24))
            pan, tilt = DRAWING.aim(lamp, lens)
            wobble = rng.normal(0, still.world.camera.pot_noise, 2)
            uv = still.true_camera.view(lens, pan + wobble[0], tilt + wobble[1]).project(lamp)[0]
            u, v = uv + rng.normal(0, SPOT_ERROR, 2)
            told = lamp + rng.uniform(-ARM_ERROR, ARM_ERROR, 3)
            point = (float(told[0]), float(told[1]), float(told[2]))
            sightings.append(Sighting(lens=lens, pan=pan, tilt=tilt, u=float(u), v=float(v), point_W=point))
    return calibrate(sightings, DRAWING)


def _rms(values: Array) -> float:
    return math.sqrt(float(np.mean(values**2))) if len(values) else 0.0


def _is_wrong(location: SpecificLocation, still: StillPump, part: Part) -> bool:
    base = still.world.base
    true = still.camera.true_view().project(hole_places(part, (base.x, base.y, base.yaw)))
    found = [(hole.u, hole.v) for hole in location.holes]
    return bool(np.hypot(*(true - found).T).max() > WRONG)


def _error(pose: tuple[float, float, float], truth: tuple[float, float, float]) -> tuple[float, float, float]:
    dx, dy, turn = (a - b for a, b in zip(pose, truth, strict=True))
    return dx, dy, math.remainder(turn, 2 * math.pi)
