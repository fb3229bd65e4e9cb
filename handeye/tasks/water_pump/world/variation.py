"""Variation of the pump's world: everything that is not quite as the plan thinks.

Search, sight and touch exist to beat these errors. Joints, holes and screws are counted from 1.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import Final

import numpy as np

from handeye.arm.converters import SENSE_BITS, TORQUE_BITS, position_step, rate_step, torque_step
from handeye.arm.robots.stanford import STANFORD
from handeye.core.distributions import Distribution, Fixed, Noise, Normal, Phase, Range, Step, Uniform
from handeye.core.units import UNITS
from handeye.core.variation import Quantity, Variation
from handeye.tasks.water_pump.world.stations import stations

JOINT_UNITS: Final = ("deg", "deg", "in", "deg", "deg", "deg")
ARM_PERIOD: Final = (60.0, 60.0, 8.0, 60.0, 60.0, 60.0)
"""Periods of the waviness of the potentiometers, in JOINT_UNITS."""
ARM_CENTRE: Final = (-25.0, 105.0, 31.0, 0.0, 75.0, 20.0)
"""Mid-work posture, in JOINT_UNITS, at which a wrong scale makes no error."""
BELT_X: Final = (41.5, 47.5)
BELT_Y: Final = (23.0, 33.0)
BELT_LINE: Final = (60.0, 120.0)
"""Ranges of the base on the belt: reference point (in), direction of its line of centres (deg)."""
_TORQUES: Final = ("N m", "N m", "N", "N m", "N m", "N m")
_RATES: Final = ("rad/s", "rad/s", "m/s", "rad/s", "rad/s", "rad/s")
RUBBING: Final = ("pad", "table", "part", "thread")
DRILLED: Final = ("base", "gasket", "top")
"""The parts with screw holes, each drilled with errors of its own."""
STOOD: Final = ("gasket", "top")
"""The parts that a person puts on a stand, which holds them by nothing but friction."""
SEVENTH: Final = 7_000_000
"""The first seed whose pump has seven screws. Chosen: no other worlds are drawn from so far up."""

_MOST: Final = {
    "in": 100.0, "deg": 360.0, "%": 1000.0, "oz": 1000.0, "N": 1000.0, "N m": 100.0, "rad/s": 10.0, "m/s": 10.0,
}  # fmt: skip
"""Greatest value that a quantity can be set to, by unit: beyond anything meant."""
_READING: Final = (
    "Potentiometers against joints, so that the hand is wrong by .060 in (median), .112 in (95 %); layout study, "
    "section 4."
)
_VISION: Final = "Vision study, verdict 1."
IN_PLAY: Final = 70.0
"""Percent of its play that a part can be off along an axis: it stays clear of the corners of its seat."""


def screws(seed: int) -> int:
    """Screws and tapped holes of the pump of a seed: from SEVENTH on it is of a later make, with a seventh."""
    return 6 if seed < SEVENTH else 7


def variation(seed: int) -> Variation:
    """The quantities in which the world of a seed differs from others."""
    return _variation(screws(seed))


@cache
def _variation(count: int) -> Variation:
    return Variation(
        *_belt(), *_arm(), *_hand(), *_camera(), *_light(), *_fixtures(), *_holes(count), *_parts(count)
    )


def _group(
    group: str,
    components: Mapping[str, Distribution],
    unit: str | Sequence[str],
    source: str,
    *,
    nominal: Sequence[float] | float = 0.0,
    least: float = -np.inf,
    greatest: float = np.inf,
) -> Iterator[Quantity]:
    """Quantities with one source; magnitudes are never negative."""
    units = [unit] * len(components) if isinstance(unit, str) else unit
    nominals = np.broadcast_to(nominal, len(components))
    for (name, distribution), its, middle in zip(components.items(), units, nominals, strict=True):
        most = min(greatest, _MOST[its])
        low = 0.0 if isinstance(distribution, Noise | Fixed | Step) else max(least, -most)
        yield Quantity(
            name=f"{group}.{name}",
            unit=its,
            distribution=distribution,
            nominal=float(middle),
            limits=(low, most),
            source=source,
        )


def _numbered(
    kind: type[Normal | Uniform | Noise | Fixed | Step], *spreads: float
) -> dict[str, Distribution]:
    return {str(number): kind(spread) for number, spread in enumerate(spreads, 1)}


def _belt() -> Iterator[Quantity]:
    for name, (low, high), unit in (("x", BELT_X, "in"), ("y", BELT_Y, "in"), ("yaw", BELT_LINE, "deg")):
        yield from _group(
            "base", {name: Range(low, high)}, unit,
            "Where the pump base lies on the belt: its reference point, and the direction of its line of centres. "
            "Layout study, section 2.",
            nominal=(low + high) / 2,
        )  # fmt: skip


def _arm() -> Iterator[Quantity]:
    yield from _group(
        "arm.offset", _numbered(Normal, 0.060, 0.055, 0.027, 0.13, 0.13, 0.27), JOINT_UNITS, _READING
    )
    yield from _group(
        "arm.scale", _numbered(Normal, 0.11, 0.22, 0.11, 0.11, 0.22, 0.22), "%",
        f"Scale of the reading, about the mid-work posture. {_READING}",
    )  # fmt: skip
    yield from _group(
        "arm.wave", _numbered(Fixed, 0.027, 0.027, 0.011, 0.044, 0.044, 0.09), JOINT_UNITS,
        f"Amplitude of the waviness of the reading. {_READING} The waviness decides how far a saved correction "
        "carries; its amplitude is a placeholder.",
    )  # fmt: skip
    yield from _group(
        "arm.wave_phase",
        {str(n): Phase() for n in range(1, 7)},
        "deg",
        "Where the waviness of the reading begins.",
    )
    yield from _sensors()
    yield from _drives()
    yield from _links()


def _sensors() -> Iterator[Quantity]:
    size = [UNITS[unit].size for unit in JOINT_UNITS]
    yield from _group(
        "arm.pot_noise", _numbered(Noise, 0.004, 0.004, 0.002, 0.01, 0.01, 0.01), JOINT_UNITS,
        "Reading-to-reading noise of the potentiometers, before the converter. Placeholder: far inside a step.",
    )  # fmt: skip
    yield from _group(
        "arm.pot_step", _numbered(Step, *(position_step(STANFORD) / size).tolist()), JOINT_UNITS,
        f"One step of the converter of a potentiometer: {SENSE_BITS} bits over the joint's travel. Data sheet of 1974.",
    )  # fmt: skip
    yield from _group(
        "arm.tachometer_noise", _numbered(Noise, 2e-5, 2e-5, 1e-5, 2e-5, 2e-5, 2e-5), _RATES,
        "Noise of the tachometers, before the converter. Placeholder: far inside a step.",
    )  # fmt: skip
    yield from _group(
        "arm.tachometer_step", _numbered(Step, *rate_step(STANFORD).tolist()), _RATES,
        f"One step of the converter of a tachometer: {SENSE_BITS} bits over the joint's speeds in both directions. "
        "Data sheet of 1974; that it reaches just the greatest speed is inferred.",
    )  # fmt: skip


def _drives() -> Iterator[Quantity]:
    yield from _group(
        "arm.torque_step", _numbered(Step, *torque_step(STANFORD).tolist()), _TORQUES,
        f"One step of the converter that a drive gets its torque from: {TORQUE_BITS} bits over its torques in both "
        'directions. Data sheet of 1974: "8 bits or more".',
    )  # fmt: skip
    yield from _group(
        "arm.drive_gain", _numbered(Normal, *[1.0] * 6), "%",
        "True torque of a drive over the torque put out. Placeholder: a linear current amplifier with 1 % resistors.",
        least=-90.0,
    )  # fmt: skip
    friction = STANFORD.compliance.friction
    yield from _group(
        "arm.friction", _numbered(Uniform, *(mean / 4 for mean in friction)), _TORQUES,
        "Coulomb friction of the joints, varied by a quarter. Switched off, it is the mean; set to 0, there is none. "
        "Inferred from the paper, by which the released arm stays where it is: joints 2 and 3 bear half a step of "
        "their torques and what is left of gravity when the arm has weighed its links (at the parked posture, in the "
        "worst of 200 worlds, .25 N m and .7 N); the wrist bears half a step. Of joint 1: placeholder.",
        nominal=friction, least=0.0,
    )  # fmt: skip
    yield from _group(
        "arm.damping", _numbered(Uniform, *[30.0] * 6), "%",
        "True viscous friction of a joint over the controller's. Placeholder.", least=-90.0,
    )  # fmt: skip
    yield from _group(
        "arm.armature", _numbered(Uniform, *[5.0] * 6), "%",
        "True inertia of a drive over the controller's. Placeholder.", least=-90.0,
    )  # fmt: skip


def _links() -> Iterator[Quantity]:
    yield from _group(
        "arm.link_mass", _numbered(Normal, *[3.0] * 6), "%",
        "True mass of each link over the controller's. Placeholder.", least=-90.0,
    )  # fmt: skip
    yield from _group(
        "arm.mass_centre", _numbered(Uniform, *[5.0] * 6), "%",
        "True distance of each link's mass centre from its joint over the controller's. Placeholder.", least=-90.0,
    )  # fmt: skip
    yield from _group(
        "arm", {"hand_length": Uniform(0.02)}, "in",
        "By how much the hand is longer than the controller believes. Placeholder.",
    )  # fmt: skip


def _hand() -> Iterator[Quantity]:
    yield from _group("hand", {"gap_offset": Normal(0.01)}, "in", "Error of the gap as read. Placeholder.")
    yield from _group("hand", {"gap_scale": Normal(0.5)}, "%", "Error of the gap as read. Placeholder.")
    yield from _group(
        "hand", {"gap_noise": Noise(0.0003)}, "in",
        "Noise of the gap as read, before the converter. Placeholder: a third of a step.",
    )  # fmt: skip
    yield from _group(
        "hand", {"gap_step": Step(STANFORD.hand.gap_max / UNITS["in"].size / 2**SENSE_BITS)}, "in",
        f"One step of the converter of the gap: {SENSE_BITS} bits over the opening. Data sheet of 1974.",
    )  # fmt: skip
    yield from _group(
        "hand.switch_force", {"plus_y": Normal(0.4), "minus_y": Normal(0.4)}, "oz",
        'Force at which a finger\'s switch fires. Reference 6.3: "a few oz; simulate about 2 oz".',
        nominal=2.0, least=0.0,
    )  # fmt: skip
    yield from _group(
        "hand.lamp", {axis: Normal(0.03) for axis in "xyz"}, "in",
        "Where the lamp is on the hand, against the drawing that the program calibrates its camera with, in the hand's "
        "frame. Placeholder: screwed on by hand.",
    )  # fmt: skip
    yield from _group(
        "screwdriver",
        {"torque_noise": Noise(0.004)},
        "N m",
        "Noise of the screwdriver's motor current. Placeholder.",
    )


def _camera() -> Iterator[Quantity]:
    yield from _group(
        "camera.place",
        {axis: Normal(0.15) for axis in "xyz"},
        "in",
        f"Where the camera's mount is, each axis. {_VISION}",
    )
    yield from _group(
        "camera.turn", {axis: Normal(0.2) for axis in ("pan", "tilt", "roll")}, "deg",
        f"How the camera's mount is turned. {_VISION}",
    )  # fmt: skip
    yield from _group(
        "camera.focal_length", {lens: Normal(0.4) for lens in ("25mm", "50mm")}, "%",
        f"Focal length of each lens over that of the drawing. {_VISION}",
        least=-50.0,
    )  # fmt: skip
    yield from _group(
        "camera", {"pot_noise": Noise(0.07)}, "deg",
        "Noise of the pan and tilt readings. Vision study: .07-.10 reproduces 1973.",
    )  # fmt: skip
    for lens in ("25mm", "50mm"):
        yield from _group(
            f"camera.lens.{lens}", {way: Normal(0.1) for way in ("ahead", "side", "up")}, "in",
            "Where the middle of the lens is, against the drawing. Placeholder: the turret's own offset is one.",
        )  # fmt: skip
    yield from _group(
        "camera.raster", {"pincushion": Normal(0.5), "lines": Normal(0.4), "field": Normal(0.4)}, "%",
        "Shape of the raster: how far a corner is drawn in, over its distance from the middle, and how far the middle "
        "of lines and of the field is off, over half their length. Honesty study, finding 10: 1 % at the corners.",
    )  # fmt: skip
    yield from _group(
        "camera.raster", {"drift": Noise(0.3)}, "%",
        "How far each picture lies off the one before, over half its length and height: half a point. The paper speaks "
        "of a slight shift between two pictures; vision study, section 4: up to a point.",
    )  # fmt: skip


def _light() -> Iterator[Quantity]:
    for name, unit, low, high, nominal, source in (
        ("zenith", "deg", 5.0, 50.0, 25.0, "Where the key light comes from: angle to the vertical."),
        ("azimuth", "deg", -180.0, 180.0, -160.0, "Where the key light comes from: angle to the table's x."),
        ("strength", "", 0.35, 0.85, 0.6, "Diffuse intensity of the key light."),
        ("ambient", "", 0.15, 0.40, 0.25, "What the room adds to the key light."),
    ):
        limits = {"zenith": (0.0, 89.0), "azimuth": (-360.0, 360.0)}.get(name, (0.0, 1.0))
        yield Quantity(
            name=f"light.{name}", unit=unit, distribution=Range(low, high), nominal=nominal, limits=limits,
            source=f"{source} Vision study 0.1.",
        )  # fmt: skip


def _fixtures() -> Iterator[Quantity]:
    for station in stations():
        yield from _group(
            f"fixtures.{station}",
            {"x": Normal(0.02), "y": Normal(0.02), "z": Normal(0.01), "yaw": Normal(0.2), "pitch": Normal(0.1),
             "roll": Normal(0.1)},
            ("in", "in", "in", "deg", "deg", "deg"),
            "Where the fixture stands against its drawing, how high, and how it tilts. Placeholder: set up with a "
            "rule, a square and a spirit level.",
        )  # fmt: skip


def _holes(count: int) -> Iterator[Quantity]:
    for part in DRILLED:
        for hole in range(1, count + 1):
            yield from _group(
                f"holes.{part}.{hole}", {"x": Normal(0.0015), "y": Normal(0.0015)}, "in",
                f"Where the screw hole of the {part} is against its drawing. Placeholder: drilled by jig, +-.003 in; "
                "the base's are tapped, those of gasket and top drilled apart from them.",
            )  # fmt: skip


def _parts(count: int) -> Iterator[Quantity]:
    for part in STOOD:
        yield from _group(
            f"parts.{part}", {"x": Uniform(0.03), "y": Uniform(0.03), "yaw": Uniform(1.0)}, ("in", "in", "deg"),
            "Where a person has put the part on its stand, against the drawing. Honesty study, finding 9.",
        )  # fmt: skip
    for thing in ("driver", *(f"screws.{screw}" for screw in range(1, count + 1))):
        yield from _group(
            f"parts.{thing}", {axis: Uniform(IN_PLAY / 2) for axis in "xy"}, "%",
            "Where it is within the play that guides or hole leave it. Even, so far that it stays within them at the "
            "high level too. A pin has none: the bevel that it stands in puts it in the middle.",
            greatest=IN_PLAY,
        )  # fmt: skip
    yield from _group(
        "parts.driver", {"yaw": Uniform(0.3)}, "deg",
        "Turn of the screwdriver in its guides. What their play allows beside its place.", greatest=0.6,
    )  # fmt: skip
    yield Quantity(
        name="part_mass", unit="%", distribution=Normal(2.0), limits=(-90.0, _MOST["%"]),
        source="Masses of base and top over those of the drawing. Placeholder.",
    )  # fmt: skip
    yield from _group(
        "friction", {name: Uniform(15.0) for name in RUBBING}, "%",
        "Coefficients of friction over those of the drawing. Placeholder.", least=-100.0,
    )  # fmt: skip
    yield from _group(
        "thread_phase", {str(screw): Phase() for screw in range(1, count + 1)}, "deg",
        "Where the thread of a screw hole starts.",
    )  # fmt: skip
