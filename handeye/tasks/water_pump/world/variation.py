"""The quantities in which the cell of a world differs from the cell that the plan assumes.

The program copes with these differences by vision, touch and search. Joints, holes and screws are numbered from 1.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import chain
from typing import Final

from handeye.core.distributions import Choice, Noise, Normal, Phase, Range, Uniform
from handeye.core.variation import Quantity, Variation, WorldSpec
from handeye.tasks.stanford_cell.arm_variation import DOUBLED, MOST, arm, group, hand, rubbing
from handeye.tasks.water_pump.world.stations import stations

BELT_X: Final = (41.5, 47.5)
BELT_Y: Final = (23.0, 33.0)
BELT_LINE: Final = (60.0, 120.0)
"""Where the base may lie on the belt: the ranges of x and y of its reference point (in), and the range of the
direction of the line between the centres of its two large holes (deg).
"""
RUBBING: Final = ("pad", "table", "part", "thread")
DRILLED: Final = ("base", "gasket", "top")  # the parts with screw holes, each drilled with errors of its own
STOOD: Final = ("gasket", "top")
"""The parts that a person puts on a stand, where only friction holds them."""
SCREWS: Final = "pump.screws"
MAKES: Final = (6, 7)
"""Possible values of the number of screws of a pump. A pump has a tapped hole for each of its screws."""
USUAL: Final = 6

_VISION: Final = "Vision study, section 3."
IN_PLAY: Final = 70.0
"""Greatest displacement of a part along an axis, in percent of the part's play. This limit keeps the part clear of the
corners of its seat.
"""


def screws(world: WorldSpec) -> int:
    """Return the number of screws and tapped holes of the pump in a world."""
    return round(variation().value(SCREWS, world))


@cache
def variation() -> Variation:
    """Return the quantities that vary between worlds."""
    return Variation(
        *_make(), *_belt(), *arm(), *hand(),
        *group(
            "screwdriver", {"torque_noise": Noise(0.004)}, "N m",
            "Noise of the screwdriver's motor current, expressed as a torque.",
            unsourced="the noise is about a hundredth of the torque at which the clutch of the screwdriver slips. "
            "Bound: .02 N m, because the program can feel the torque of a clean thread, which is .02 N m.",
        ),
        *_camera(), *_light(), *_fixtures(), *_holes(), *_parts(),
    )  # fmt: skip


def _make() -> Iterator[Quantity]:
    yield Quantity(
        name=SCREWS, unit="", distribution=Choice(tuple(map(float, MAKES))), nominal=float(USUAL),
        source="Number of screws, and of tapped holes: part of the job, not an error. The number does not depend on "
        "seed or level. The seventh screw and its hole belong to a later version of the pump; the program of 1973 "
        "does not know this version.",
    )  # fmt: skip


def _of(number: int, quantities: Iterator[Quantity]) -> Iterator[Quantity]:
    """Yield `quantities`, which belong to the screw or hole with the number `number`. If `number` is above the usual
    number of screws, the quantities exist only in worlds whose pump has this screw.
    """
    where = (SCREWS, float(number)) if number > USUAL else None
    return (replace(quantity, where=where) for quantity in quantities)


def _belt() -> Iterator[Quantity]:
    for name, (low, high), unit in (("x", BELT_X, "in"), ("y", BELT_Y, "in"), ("yaw", BELT_LINE, "deg")):
        yield from group(
            "base", {name: Range(low, high)}, unit,
            "Position of the pump base on the belt: its reference point, and the direction of the "
            "line between the centres of its large holes. Layout study, section 2.",
            nominal=(low + high) / 2,
        )  # fmt: skip


def _camera() -> Iterator[Quantity]:
    lenses = ("25mm", "50mm")
    middle = "Displacement of the lens centre from its place in the drawing."
    turret = f"data sheets of lenses do not give the entrance pupil, and no drawing of the turret is known. {DOUBLED}"
    aside = {way: Normal(0.1) for way in ("ahead", "side", "up")}
    return chain(
        group("camera.place", {axis: Normal(0.15) for axis in "xyz"}, "in",
            f"Position of the camera's mount along each axis. {_VISION}"),
        group("camera.turn", {axis: Normal(0.2) for axis in ("pan", "tilt", "roll")}, "deg",
            f"Rotation of the camera's mount. {_VISION}"),
        group("camera.focal_length", {lens: Normal(0.4) for lens in lenses}, "%",
            f"Relative deviation of each lens's focal length from its value in the drawing. {_VISION}", least=-50.0),
        group("camera", {"pot_noise": Noise(0.07)}, "deg",
            "Noise of the pan and tilt readings. In the vision study, noise of .07 to .10 deg reproduces the "
            "location errors of 1973."),
        *(group(f"camera.lens.{lens}", aside, "in", middle, unsourced=turret) for lens in lenses),
        group("camera.raster", {"pincushion": Normal(0.5), "lines": Normal(0.4), "field": Normal(0.4)}, "%",
            "Shape of the raster. `pincushion`: inward shift of a corner, as a fraction of its distance from the "
            "centre. `lines`: sideways shift of the middle of each line, as a fraction of half the line's length. "
            "`field`: downward shift of the line in the middle of the picture, as a fraction of half the picture's "
            "height.",
            unsourced=f"the papers do not mention the shape of the raster, and the camera is lost. {DOUBLED}"),
        group("camera.raster", {"drift": Noise(0.3)}, "%",
            "Shift of each picture from the previous one: sideways as a fraction of half the picture's width, and "
            "up or down as a fraction of half its height. Sigma is half a pixel. The paper mentions a slight shift "
            "between two pictures; section 4 of the vision study says up to a pixel."),
    )  # fmt: skip


def _light() -> Iterator[Quantity]:
    for name, unit, low, high, nominal, source in (
        ("zenith", "deg", 5.0, 50.0, 25.0, "Direction of the key light: angle to the vertical."),
        ("azimuth", "deg", -180.0, 180.0, -160.0, "Direction of the key light: angle to the table's x axis."),
        ("strength", "", 0.35, 0.85, 0.6, "Diffuse intensity of the key light."),
        ("ambient", "", 0.15, 0.40, 0.25, "Intensity of the room's light, added to the key light."),
    ):
        limits = {"zenith": (0.0, 89.0), "azimuth": (-360.0, 360.0)}.get(name, (0.0, 1.0))
        yield Quantity(
            name=f"light.{name}", unit=unit, distribution=Range(low, high), nominal=nominal, limits=limits,
            source=f"{source} Vision study, section 0.1.",
        )  # fmt: skip


def _fixtures() -> Iterator[Quantity]:
    for station in stations():
        yield from group(
            f"fixtures.{station}",
            {"x": Normal(0.02), "y": Normal(0.02), "z": Normal(0.01), "yaw": Normal(0.2), "pitch": Normal(0.1),
             "roll": Normal(0.1)},
            ("in", "in", "in", "deg", "deg", "deg"),
            "Position, height and tilt of the fixture relative to its drawing, as set up with a steel rule, a "
            "square and a spirit level. Sigma is the tolerance of ISO 2768-1, class m: .5 mm for lengths of 120 to "
            "400 mm, .3 mm for heights of 30 to 120 mm, and 20 minutes of arc for angles whose shorter side is 50 "
            "to 120 mm long. So a third of the fixtures exceed this tolerance. A steel rule has divisions of 1/64 "
            "in; a spirit level is accurate to .5 to 1 mm/m, .03 to .06 deg.",
        )  # fmt: skip


def _holes() -> Iterator[Quantity]:
    for part in DRILLED:
        for hole in range(1, max(MAKES) + 1):
            yield from _of(hole, group(
                f"holes.{part}.{hole}", {"x": Normal(0.0015), "y": Normal(0.0015)}, "in",
                f"Deviation of a screw hole of the {part} from its place in the drawing. The holes of the base are "
                "tapped; those of gasket and top are drilled separately.",
                unsourced="no drawing of the pump is known; two sigma are +-.003 in, the accuracy of a drilling jig. "
                          "Bound: +-.004 in for lengths of 6 to 30 mm and +-.006 in for lengths of 30 to 120 mm, "
                          "class f of ISO 2768-1.",
            ))  # fmt: skip


def _parts() -> Iterator[Quantity]:
    stood = "Position in which a person has put the part on its stand, relative to the drawing."
    by_hand = f"the papers do not say how accurately the parts stood on their stands. {DOUBLED}"
    off = {"x": Uniform(0.03), "y": Uniform(0.03), "yaw": Uniform(1.0)}
    played = (
        "Position of the screwdriver within the play of its guides, or of a screw within the play of its hole, "
        "uniformly distributed. At the level `high`, too, the position stays within the play. A pin has no play, "
        "because the bevel of its hole centres it."
    )
    play = {axis: Uniform(IN_PLAY / 2) for axis in "xy"}
    numbers = range(1, max(MAKES) + 1)
    masses = "Relative deviation of the masses of base and top from their values in the drawing."
    cast = (
        "no drawing of the castings is known. Bound: 10 to 15 %, the tolerance of foundries for the wall thickness "
        "of sand castings (Badger Iron Works)."
    )
    starts = "Start angle of the thread of a screw hole."
    return chain(
        *(group(f"parts.{part}", off, ("in", "in", "deg"), stood, unsourced=by_hand) for part in STOOD),
        group("parts.driver", play, "%", played, greatest=IN_PLAY),
        *(_of(k, group(f"parts.screws.{k}", play, "%", played, greatest=IN_PLAY)) for k in numbers),
        group("parts.driver", {"yaw": Uniform(0.3)}, "deg",
            "Rotation of the screwdriver in its guides. The guides are wide enough for this rotation and for the "
            "play of the screwdriver's position together.", greatest=0.6),
        [Quantity(name="part_mass", unit="%", distribution=Normal(2.0), limits=(-90.0, MOST["%"]), source=masses,
                  unsourced=cast)],
        rubbing(RUBBING),
        *(_of(k, group("thread_phase", {str(k): Phase()}, "deg", starts)) for k in numbers),
    )  # fmt: skip
