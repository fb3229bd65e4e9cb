"""The quantities in which the simulated Stanford arm and its hand differ from the controller's model. Joints are
numbered from 1.
"""

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
"""Configuration in the middle of the work area, in JOINT_UNITS, at which a scale error has no effect."""
_TORQUES: Final = ("N m", "N m", "N", "N m", "N m", "N m")
_RATES: Final = ("rad/s", "rad/s", "m/s", "rad/s", "rad/s", "rad/s")

MOST: Final = {
    "in": 100.0, "deg": 360.0, "%": 1000.0, "oz": 1000.0, "N": 1000.0, "N m": 100.0, "rad/s": 10.0, "m/s": 10.0,
}  # fmt: skip
"""Greatest value to which a quantity can be set, by unit. It is beyond any plausible value."""
_READING: Final = (
    "The errors of the potentiometers of all joints together displace the hand by .060 in (median) or .112 in "
    "(95th percentile); layout study, section 4."
)


DOUBLED: Final = (
    "Tested at twice this size. At the level `high`, which doubles all errors, 18 of 20 pumps were assembled "
    "(commit 64baaebf), and no failure was silent."
)


def group(
    group: str,
    components: Mapping[str, Distribution],
    unit: str | Sequence[str],
    source: str,
    *,
    unsourced: str = "",
    nominal: Sequence[float] | float = 0.0,
    least: float = -np.inf,
    greatest: float = np.inf,
) -> Iterator[Quantity]:
    """Yield quantities whose figures come from the same source. Quantities that are magnitudes, such as noise, cannot
    be negative.
    """
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
            unsourced=unsourced,
        )


def numbered(kind: type[Normal | Uniform | Noise | Fixed | Step], *spreads: float) -> dict[str, Distribution]:
    return {str(number): kind(spread) for number, spread in enumerate(spreads, 1)}


def arm() -> Iterator[Quantity]:
    phases: dict[str, Distribution] = {str(n): Phase() for n in range(1, 7)}
    size = [UNITS[unit].size for unit in JOINT_UNITS]
    return chain(
        group("arm.offset", numbered(Normal, 0.060, 0.055, 0.027, 0.13, 0.13, 0.27), JOINT_UNITS,
            f"Offset of the position reading. {_READING}"),
        group("arm.scale", numbered(Normal, 0.11, 0.22, 0.11, 0.11, 0.22, 0.22), "%",
            "Scale error of the position reading. The error is zero at a posture in the middle of the work area. "
            f"{_READING}"),
        group("arm.wave", numbered(Fixed, 0.027, 0.027, 0.011, 0.044, 0.044, 0.09), JOINT_UNITS,
            "Amplitude of the periodic error of the position reading. The periodic error limits the distance over "
            "which a saved correction is valid.",
            unsourced="no data sheet of 1974 gives this amplitude. Today's data sheets give the greatest deviation "
            "of the reading from a straight line (.15 to .25 % of the travel for wire-wound potentiometers, 1 to 2 "
            "% for conductive plastic: Bourns 3400 to 3590, 6537 to 6639). These data sheets do not say whether "
            "this deviation is periodic. Bound: .18 deg for joint 1, .16 deg for joint 2, .10 in for joint 3, .59 "
            "deg for joint 4, .57 deg for joint 5; each of these amplitudes alone would explain the error of .1 in "
            "of the whole arm (layout study, section 4)."),
        group("arm.wave_phase", phases, "deg", "Phase of the periodic error of the position reading."),
        group("arm.pot_noise", numbered(Noise, 0.004, 0.004, 0.002, 0.01, 0.01, 0.01), JOINT_UNITS,
            "Noise of the potentiometers before the converter. This noise differs from reading to reading.",
            unsourced="we chose a noise far smaller than a step of the converter (.05 to .08 deg and .009 in), so "
            "the converter does not show it. Bound: four steps of the converter, because the output smoothness of "
            "the Bourns 6639 is .1 % of the travel."),
        group("arm.pot_step", numbered(Step, *(position_step(STANFORD) / size).tolist()), JOINT_UNITS,
            f"One step of the converter of a potentiometer: {SENSE_BITS} bits over the joint's travel. Data sheet of "
            "1974."),
        group("arm.tachometer_noise", numbered(Noise, 2e-5, 2e-5, 1e-5, 2e-5, 2e-5, 2e-5), _RATES,
            "Noise of the tachometers, before the converter.",
            unsourced="no data sheet of the arm's tachometers is known. Bound: a step of the converter, which is 37 "
            "to 146 times this noise, so the converter does not show the noise."),
        group("arm.tachometer_step", numbered(Step, *rate_step(STANFORD).tolist()), _RATES,
            f"One step of the converter of a tachometer: {SENSE_BITS} bits over the range of the joint's speeds in "
            "both directions. Data sheet of 1974; we infer that the range ends at the joint's greatest speed."),
        group("arm.torque_step", numbered(Step, *torque_step(STANFORD).tolist()), _TORQUES,
            f"One step of the converter that sets the torque of a drive: {TORQUE_BITS} bits over the range of the "
            'drive\'s torques in both directions. Data sheet of 1974: "8 bits or more".'),
        group("arm.drive_gain", numbered(Normal, *[1.0] * 6), "%",
            "Relative deviation of a drive's true torque from the commanded torque.", least=-90.0,
            unsourced="a linear current amplifier is as accurate as its resistors, and 1 % is the class of the E96 "
                      f"series (IEC 60063); the error of the motors is not known. {DOUBLED}"),
        _friction(),
        group("arm.damping", numbered(Uniform, *[30.0] * 6), "%",
            "Relative deviation of a joint's true viscous friction from the controller's value.", least=-90.0,
            unsourced="the friction of robot joints changes considerably as the joints warm up (Bittencourt and "
            "others, IROS 2010; "
                      "Simoni "
            f"and others, Robotica 2017), but the friction of the Stanford arm was never measured. {DOUBLED}"),
        group("arm.armature", numbered(Uniform, *[5.0] * 6), "%",
            "Relative deviation of a drive's true inertia from the controller's value.", least=-90.0,
            unsourced=f"no data sheet of the arm's motors is known. {DOUBLED}"),
        group("arm.link_mass", numbered(Normal, *[3.0] * 6), "%",
            "Relative deviation of a link's true mass from the controller's value.", least=-90.0,
            unsourced="the masses were published without a tolerance. To correct the error of the masses, the arm "
            f"weighs its links. {DOUBLED}"),
        group("arm.mass_centre", numbered(Uniform, *[5.0] * 6), "%",
            "True distance between a link's joint and its centre of mass, as a relative deviation from the "
            "controller's value.", least=-90.0,
            unsourced="the centres of mass, like the masses, were published without a tolerance. To correct the "
            f"errors of these centres, the arm weighs its links. {DOUBLED}"),
        group("arm", {"hand_length": Uniform(0.02)}, "in",
            "True length of the hand minus the controller's value.",
            unsourced="no drawing gives the tolerance. A length like this is measured with a steel rule, which "
                "has divisions of 1/64 in (.016 in). Bound: 1/32 in, a misreading by two divisions."),
    )  # fmt: skip


def _friction() -> Iterator[Quantity]:
    """Yield the Coulomb friction of the joints. According to the paper, a released arm stays in place. This statement
    does not concern joint 1, because joint 1 carries no weight.
    """
    means = STANFORD.compliance.friction
    what = (
        "Coulomb friction of the joints. It differs from its mean by up to a quarter. Without this error, a joint "
        "has its mean friction. If the friction is set to 0, the joint has none."
    )
    first, *others = numbered(Uniform, *(mean / 4 for mean in means)).items()
    yield from group(
        "arm.friction", dict([first]), _TORQUES[:1], what, nominal=means[0], least=0.0,
        unsourced="the friction of the other joints is inferred from the paper: when the arm is released, these "
        "joints do not move under the weight of the links. Joint 1 carries no weight, so this observation says "
        f"nothing about the friction of joint 1. {DOUBLED}",
    )  # fmt: skip
    yield from group(
        "arm.friction", dict(others), _TORQUES[1:],
        f"{what} Inferred from the paper, in which a released arm stays in place. The friction of joints 2 and 3 "
        "must therefore withstand the sum of two loads. One is half a step of the joint's torque converter. The "
        "other is the part of the weight for which the arm does not compensate, even after it has weighed its "
        "links: .25 N m at joint 2 and .7 N at joint 3 in the parked posture, in the worst of 200 worlds. The "
        "friction of a wrist joint need withstand only half a step of the joint's torque converter.",
        nominal=means[1:], least=0.0,
    )  # fmt: skip


def hand() -> Iterator[Quantity]:
    return chain(
        group("hand", {"gap_offset": Normal(0.01)}, "in", "Offset of the gap reading.",
            unsourced="the offset is due to the wear of the finger pads since the gap was last set, and this wear "
            f"was never measured. {DOUBLED}"),
        group("hand", {"gap_scale": Normal(0.5)}, "%",
            "Scale error of the gap reading. Wire-wound potentiometers have a linearity of .15 to .25 %, and "
            "conductive plastic ones of 1 to 2 % (data sheets of Bourns 3400 to 3590 and 6537 to 6639). The size "
            "of the error is between the two."),
        group("hand", {"gap_noise": Noise(0.0003)}, "in",
            "Noise of the gap reading, before the converter.",
            unsourced="the noise is a third of a step of the converter, so the converter hardly shows it. Bound: "
                "four steps of the converter, because the output smoothness of the Bourns 6639 is .1 % of the travel."),
        group("hand", {"gap_step": Step(STANFORD.hand.gap_max / UNITS["in"].size / 2**SENSE_BITS)}, "in",
            f"One step of the converter of the gap: {SENSE_BITS} bits over the full opening. Data sheet of 1974."),
        group("hand.switch_force", {"plus_y": Normal(0.4), "minus_y": Normal(0.4)}, "oz",
            "Force at which a finger's switch closes. Our notes on the system of 1973 estimate this force at a few "
            "ounces, and suggest 2 oz for a simulation.",
            nominal=2.0, least=0.0),
        group("hand.lamp", {axis: Normal(0.03) for axis in "xyz"}, "in",
            "Deviation of the lamp's position in the hand from its position in the drawing. The calibration of the "
            "camera uses the position in the drawing.",
            unsourced="the lamp is screwed on by hand and set with a steel rule, which has divisions of 1/64 in. "
            "Bound: 1/16 in, two sigma."),
    )  # fmt: skip


def rubbing(kinds: Sequence[str]) -> Iterator[Quantity]:
    """Yield one quantity for each kind of shape in `kinds`: the relative error of the coefficient of friction."""
    yield from group(
        "friction", {name: Uniform(15.0) for name in kinds}, "%",
        "Relative deviation of the coefficients of friction from their values in the drawing.", least=-100.0,
        unsourced="for the same pair of metals, the measured friction differs from laboratory to laboratory (VAMAS "
                  f"round robin, Wear 114, 1987; ASTM G115), and this pump was never measured. {DOUBLED}",
    )  # fmt: skip
