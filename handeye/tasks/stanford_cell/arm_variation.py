"""Variation of the Stanford arm and its hand: their differences from the controller's model; joints count from 1."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import Final

import numpy as np

from handeye.arm.converters import SENSE_BITS, TORQUE_BITS, position_step, rate_step, torque_step
from handeye.arm.robots.stanford import STANFORD
from handeye.core.distributions import Distribution, Fixed, Noise, Normal, Phase, Step, Uniform
from handeye.core.units import UNITS
from handeye.core.variation import Quantity

JOINT_UNITS: Final = ("deg", "deg", "in", "deg", "deg", "deg")
ARM_PERIOD: Final = (60.0, 60.0, 8.0, 60.0, 60.0, 60.0)
"""Periods of the waviness of the potentiometers, in JOINT_UNITS."""
ARM_CENTRE: Final = (-25.0, 105.0, 31.0, 0.0, 75.0, 20.0)
"""Mid-work posture, in JOINT_UNITS, at which a wrong scale makes no error."""
_TORQUES: Final = ("N m", "N m", "N", "N m", "N m", "N m")
_RATES: Final = ("rad/s", "rad/s", "m/s", "rad/s", "rad/s", "rad/s")

MOST: Final = {
    "in": 100.0, "deg": 360.0, "%": 1000.0, "oz": 1000.0, "N": 1000.0, "N m": 100.0, "rad/s": 10.0, "m/s": 10.0,
}  # fmt: skip
"""Greatest value that a quantity can be set to, by unit: beyond anything meant."""
_READING: Final = (
    "Potentiometers against joints, so that the hand is wrong by .060 in (median), .112 in (95 %); layout study, "
    "section 4."
)


def group(
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
        most = min(greatest, MOST[its])
        low = 0.0 if isinstance(distribution, Noise | Fixed | Step) else max(least, -most)
        yield Quantity(
            name=f"{group}.{name}",
            unit=its,
            distribution=distribution,
            nominal=float(middle),
            limits=(low, most),
            source=source,
        )


def numbered(kind: type[Normal | Uniform | Noise | Fixed | Step], *spreads: float) -> dict[str, Distribution]:
    return {str(number): kind(spread) for number, spread in enumerate(spreads, 1)}


def arm() -> Iterator[Quantity]:
    phases: dict[str, Distribution] = {str(n): Phase() for n in range(1, 7)}
    size = [UNITS[unit].size for unit in JOINT_UNITS]
    return chain(
        group("arm.offset", numbered(Normal, 0.060, 0.055, 0.027, 0.13, 0.13, 0.27), JOINT_UNITS, _READING),
        group("arm.scale", numbered(Normal, 0.11, 0.22, 0.11, 0.11, 0.22, 0.22), "%",
            f"Scale of the reading, about the mid-work posture. {_READING}"),
        group("arm.wave", numbered(Fixed, 0.027, 0.027, 0.011, 0.044, 0.044, 0.09), JOINT_UNITS,
            f"Amplitude of the waviness of the reading. {_READING} The waviness decides how far a saved correction "
            "carries; its amplitude is a placeholder."),
        group("arm.wave_phase", phases, "deg", "Where the waviness of the reading begins."),
        group("arm.pot_noise", numbered(Noise, 0.004, 0.004, 0.002, 0.01, 0.01, 0.01), JOINT_UNITS,
            "Reading-to-reading noise of the potentiometers, before the converter. Placeholder: far inside a step."),
        group("arm.pot_step", numbered(Step, *(position_step(STANFORD) / size).tolist()), JOINT_UNITS,
            f"One step of the converter of a potentiometer: {SENSE_BITS} bits over the joint's travel. Data sheet of "
            "1974."),
        group("arm.tachometer_noise", numbered(Noise, 2e-5, 2e-5, 1e-5, 2e-5, 2e-5, 2e-5), _RATES,
            "Noise of the tachometers, before the converter. Placeholder: far inside a step."),
        group("arm.tachometer_step", numbered(Step, *rate_step(STANFORD).tolist()), _RATES,
            f"One step of the converter of a tachometer: {SENSE_BITS} bits over the joint's speeds in both directions. "
            "Data sheet of 1974; that it reaches just the greatest speed is inferred."),
        group("arm.torque_step", numbered(Step, *torque_step(STANFORD).tolist()), _TORQUES,
            f"One step of the converter that a drive gets its torque from: {TORQUE_BITS} bits over its torques in both "
            'directions. Data sheet of 1974: "8 bits or more".'),
        group("arm.drive_gain", numbered(Normal, *[1.0] * 6), "%",
            "True torque of a drive over the torque put out. Placeholder: a linear current amplifier with 1 % "
            "resistors.", least=-90.0),
        group("arm.friction", numbered(Uniform, *(mean / 4 for mean in STANFORD.compliance.friction)), _TORQUES,
            "Coulomb friction of the joints, varied by a quarter. Switched off, it is the mean; set to 0, there is "
            "none. Inferred from the paper, by which the released arm stays where it is: joints 2 and 3 bear half a "
            "step of their torques and what is left of gravity when the arm has weighed its links (at the parked "
            "posture, in the worst of 200 worlds, .25 N m and .7 N); the wrist bears half a step. Of joint 1: "
            "placeholder.", nominal=STANFORD.compliance.friction, least=0.0),
        group("arm.damping", numbered(Uniform, *[30.0] * 6), "%",
            "True viscous friction of a joint over the controller's. Placeholder.", least=-90.0),
        group("arm.armature", numbered(Uniform, *[5.0] * 6), "%",
            "True inertia of a drive over the controller's. Placeholder.", least=-90.0),
        group("arm.link_mass", numbered(Normal, *[3.0] * 6), "%",
            "True mass of each link over the controller's. Placeholder.", least=-90.0),
        group("arm.mass_centre", numbered(Uniform, *[5.0] * 6), "%",
            "True distance of each link's mass centre from its joint over the controller's. Placeholder.", least=-90.0),
        group("arm", {"hand_length": Uniform(0.02)}, "in",
            "By how much the hand is longer than the controller believes. Placeholder."),
    )  # fmt: skip


def hand() -> Iterator[Quantity]:
    return chain(
        group("hand", {"gap_offset": Normal(0.01)}, "in", "Error of the gap as read. Placeholder."),
        group("hand", {"gap_scale": Normal(0.5)}, "%", "Error of the gap as read. Placeholder."),
        group("hand", {"gap_noise": Noise(0.0003)}, "in",
            "Noise of the gap as read, before the converter. Placeholder: a third of a step."),
        group("hand", {"gap_step": Step(STANFORD.hand.gap_max / UNITS["in"].size / 2**SENSE_BITS)}, "in",
            f"One step of the converter of the gap: {SENSE_BITS} bits over the opening. Data sheet of 1974."),
        group("hand.switch_force", {"plus_y": Normal(0.4), "minus_y": Normal(0.4)}, "oz",
            'Force at which a finger\'s switch fires. Reference 6.3: "a few oz; simulate about 2 oz".',
            nominal=2.0, least=0.0),
        group("hand.lamp", {axis: Normal(0.03) for axis in "xyz"}, "in",
            "Where the lamp is on the hand, against the drawing that the program calibrates its camera with, in the "
            "hand's frame. Placeholder: screwed on by hand."),
    )  # fmt: skip


def rubbing(kinds: Sequence[str]) -> Iterator[Quantity]:
    """Scales of the coefficients of friction of some kinds of shapes, by their names."""
    yield from group(
        "friction", {name: Uniform(15.0) for name in kinds}, "%",
        "Coefficients of friction over those of the drawing. Placeholder.", least=-100.0,
    )  # fmt: skip
