"""The imperfect world: everything that is not quite as the plan thinks, drawn from one seed.

Search, sight and touch exist to beat these errors. Every magnitude stands in the tables below, in the units
people use; `World` holds the drawn values in SI. "sigma" is of a normal distribution clipped at two sigma,
"half range" of a uniform one.
"""

from dataclasses import dataclass
from typing import Final, Self

import numpy as np

from handeye.cell.device_errors import ArmErrors, CameraErrors, HandErrors
from handeye.pose import Array
from handeye.units import DEGREE, INCH, OUNCE_FORCE

_ARM_UNIT: Final = np.array([DEGREE, DEGREE, INCH, DEGREE, DEGREE, DEGREE])

ARM_OFFSET: Final = np.array([0.060, 0.055, 0.027, 0.13, 0.13, 0.27])  # sigma; deg, joint 3 in
ARM_SCALE: Final = np.array([0.11, 0.22, 0.11, 0.11, 0.22, 0.22])  # sigma; %, about ARM_CENTRE
ARM_WAVE: Final = np.array([0.027, 0.027, 0.011, 0.044, 0.044, 0.09])  # amplitude; deg, joint 3 in
ARM_PERIOD: Final = np.array([60.0, 60.0, 8.0, 60.0, 60.0, 60.0])  # of the waviness; deg, joint 3 in
ARM_CENTRE: Final = np.array([-25.0, 105.0, 31.0, 0.0, 75.0, 20.0])  # mid-work posture; deg, joint 3 in
"""Potentiometers against joints, so that the hand is wrong by .060 in (median), .112 in (95 %); layout study,
section 4. The waviness decides how far a saved correction carries; its amplitude is a placeholder."""

ARM_POT_NOISE: Final = np.array([0.004, 0.004, 0.002, 0.01, 0.01, 0.01])  # sigma; deg, joint 3 in
"""Reading-to-reading noise. Placeholder: far inside the .08 in repeatability of the 1974 data sheet."""
TACHOMETER_NOISE: Final = np.array([2e-5, 2e-5, 1e-5, 2e-5, 2e-5, 2e-5])  # sigma; rad/s, joint 3 m/s
"""Placeholder, after filtering: with 1/60 s it makes under .1 N of noise in the estimated hand force."""
LINK_MASS: Final = 3.0  # sigma; %, true mass over the controller's. Placeholder.
JOINT_FRICTION: Final = np.array([0.04, 0.04, 0.16, 0.008, 0.008, 0.004])  # mean; N m, joint 3 N
"""Coulomb friction of the joints, varied by half. Placeholder: the true arm had more and its programs knew
it; this much makes about .15 N of false hand force."""

GAP_OFFSET: Final = 0.01  # sigma; in. Placeholder.
GAP_SCALE: Final = 0.5  # sigma; %. Placeholder.
GAP_NOISE: Final = 0.001  # sigma; in. Placeholder: one step of a 12-bit converter over 4.13 in.
SWITCH_FORCE: Final = (2.0, 0.4)  # mean and sigma; oz. Reference 6.3: "a few oz; simulate about 2 oz".
TORQUE_NOISE: Final = 0.004  # sigma; N m, screwdriver motor current. Placeholder.

BELT_X: Final = (41.5, 47.5)  # uniform; in, where the base's reference point lies. Layout study, section 2.
BELT_Y: Final = (23.0, 33.0)  # uniform; in
BELT_LINE: Final = (90.0, 30.0)  # middle and half range; deg, direction of the line of centres

FIXTURES: Final = ("blocks", "pin_holder", "gasket_stand", "top_stand", "rack", "dispenser")
FIXTURE_PLACE: Final = 0.02  # sigma; in, each of x and y. Placeholder.
FIXTURE_YAW: Final = 0.2  # sigma; deg. Placeholder.
HOLE_PLACE: Final = 0.003  # sigma; in, each of x and y, of a tapped hole. Placeholder: drilled by jig.
PART_MASS: Final = 2.0  # sigma; %. Placeholder.
RUBBING: Final = ("pad", "table", "part", "thread")
FRICTION: Final = 15.0  # half range; %, of every coefficient of friction. Placeholder.

CAMERA_PLACE: Final = 0.15  # sigma; in, each axis of the mount. Vision study, verdict 1.
CAMERA_TURN: Final = 0.2  # sigma; deg, each of pan, tilt and roll. Vision study, verdict 1.
FOCAL_LENGTH: Final = 0.4  # sigma; %, each lens. Vision study, verdict 1.
CAMERA_POT: Final = 0.07  # sigma; deg, pan and tilt readings. Vision study: .07-.10 reproduces 1973.

LIGHT_ZENITH: Final = (5.0, 50.0)  # uniform; deg from the vertical. Vision study 0.1, as the two below.
LIGHT_STRENGTH: Final = (0.35, 0.85)  # uniform; diffuse intensity
AMBIENT: Final = (0.15, 0.40)  # uniform

SEVENTH: Final = 7_000_000
"""The first seed whose pump has seven screws. Chosen: no other worlds are drawn from so far up."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Light:
    """The key light and what the room adds."""

    zenith: float
    """rad from the vertical."""
    azimuth: float
    """rad from table x: where the light comes from."""
    strength: float
    ambient: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Placing:
    """An error of place: m and rad."""

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class World:
    """One drawn world. Equal seeds give equal worlds.

    From seed `SEVENTH` on the pump is of a later make, with a seventh hole, and the dispenser has a seventh screw.
    """

    seed: int
    base: Placing
    """The pump base on the belt: its reference point and the direction of its line of centres, in W."""
    arm: ArmErrors
    hand: HandErrors
    camera: CameraErrors
    light: Light
    fixtures: dict[str, Placing]
    """Error of each fixture, by the names in FIXTURES."""
    holes: tuple[tuple[float, float], ...]
    """Error of each tapped hole in the base, m; as many as there are holes."""
    part_mass: float
    """Scale of the masses of base and top."""
    friction: dict[str, float]
    """Scales of the coefficients of friction, by the names in RUBBING."""
    thread_phase: tuple[float, ...]
    """Where each thread starts, rad."""

    @classmethod
    def sample(cls, seed: int) -> Self:
        """The world of a seed."""
        screws = 6 if seed < SEVENTH else 7
        rng = np.random.default_rng([seed, 1973])
        return cls(
            seed=seed,
            base=Placing(
                x=float(rng.uniform(*BELT_X)) * INCH,
                y=float(rng.uniform(*BELT_Y)) * INCH,
                yaw=(BELT_LINE[0] + BELT_LINE[1] * float(rng.uniform(-1, 1))) * DEGREE,
            ),
            arm=_arm(rng, 1.0),
            hand=_hand(rng, 1.0),
            camera=_camera(rng, 1.0),
            light=_light(rng),
            fixtures={name: _placing(rng) for name in FIXTURES},
            holes=tuple(_pair(rng, HOLE_PLACE * INCH) for _ in range(screws)),
            part_mass=1 + float(_clipped(rng)) * PART_MASS / 100,
            friction={name: 1 + FRICTION / 100 * float(rng.uniform(-1, 1)) for name in RUBBING},
            thread_phase=tuple(float(a) for a in rng.uniform(0, 2 * np.pi, screws)),
        )

    @classmethod
    def nominal(cls, screws: int = 6) -> Self:
        """The world as the plan thinks it is: no error, no noise."""
        rng = np.random.default_rng(0)
        return cls(
            seed=0,
            base=Placing(x=sum(BELT_X) / 2 * INCH, y=sum(BELT_Y) / 2 * INCH, yaw=BELT_LINE[0] * DEGREE),
            arm=_arm(rng, 0.0),
            hand=_hand(rng, 0.0),
            camera=_camera(rng, 0.0),
            light=Light(zenith=25 * DEGREE, azimuth=200 * DEGREE, strength=0.6, ambient=0.25),
            fixtures={name: Placing() for name in FIXTURES},
            holes=((0.0, 0.0),) * screws,
            part_mass=1.0,
            friction=dict.fromkeys(RUBBING, 1.0),
            thread_phase=(0.0,) * screws,
        )

    def generator(self, stream: int) -> np.random.Generator:
        """A source of noise of this world; different `stream`s are independent."""
        return np.random.default_rng([self.seed, 1973, stream])


def _clipped(rng: np.random.Generator, size: int | None = None) -> Array:
    """Standard normal values clipped at two sigma."""
    return np.clip(rng.standard_normal(size), -2.0, 2.0)


def _pair(rng: np.random.Generator, sigma: float) -> tuple[float, float]:
    x, y = _clipped(rng, 2) * sigma
    return float(x), float(y)


def _placing(rng: np.random.Generator) -> Placing:
    x, y = _pair(rng, FIXTURE_PLACE * INCH)
    return Placing(x=x, y=y, yaw=float(_clipped(rng)) * FIXTURE_YAW * DEGREE)


def _arm(rng: np.random.Generator, amount: float) -> ArmErrors:
    return ArmErrors(
        offset=amount * _clipped(rng, 6) * ARM_OFFSET * _ARM_UNIT,
        scale=amount * _clipped(rng, 6) * ARM_SCALE / 100,
        wave=amount * ARM_WAVE * _ARM_UNIT,
        period=ARM_PERIOD * _ARM_UNIT,
        phase=rng.uniform(0, 2 * np.pi, 6),
        centre=ARM_CENTRE * _ARM_UNIT,
        pot_noise=amount * ARM_POT_NOISE * _ARM_UNIT,
        tachometer_noise=amount * TACHOMETER_NOISE,
        link_mass=1 + amount * _clipped(rng, 6) * LINK_MASS / 100,
        friction=amount * JOINT_FRICTION * rng.uniform(0.5, 1.5, 6),
    )


def _hand(rng: np.random.Generator, amount: float) -> HandErrors:
    mean, sigma = SWITCH_FORCE
    first, second = (mean + amount * sigma * _clipped(rng, 2)) * OUNCE_FORCE
    return HandErrors(
        gap_offset=amount * float(_clipped(rng)) * GAP_OFFSET * INCH,
        gap_scale=amount * float(_clipped(rng)) * GAP_SCALE / 100,
        gap_noise=amount * GAP_NOISE * INCH,
        switch_force=(float(first), float(second)),
        torque_noise=amount * TORQUE_NOISE,
    )


def _camera(rng: np.random.Generator, amount: float) -> CameraErrors:
    place = amount * _clipped(rng, 3) * CAMERA_PLACE * INCH
    turn = amount * _clipped(rng, 3) * CAMERA_TURN * DEGREE
    focal = 1 + amount * _clipped(rng, 2) * FOCAL_LENGTH / 100
    return CameraErrors(
        place=(float(place[0]), float(place[1]), float(place[2])),
        turn=(float(turn[0]), float(turn[1]), float(turn[2])),
        focal_scale=(float(focal[0]), float(focal[1])),
        pot_noise=amount * CAMERA_POT * DEGREE,
    )


def _light(rng: np.random.Generator) -> Light:
    zenith = float(rng.uniform(*LIGHT_ZENITH)) * DEGREE
    return Light(
        zenith=zenith,
        azimuth=float(rng.uniform(-np.pi, np.pi)),
        strength=float(rng.uniform(*LIGHT_STRENGTH)),
        ambient=float(rng.uniform(*AMBIENT)),
    )
