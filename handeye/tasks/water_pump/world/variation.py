"""Variation of the pump's world: everything that is not quite as the plan thinks.

Search, sight and touch exist to beat these errors. Joints, holes and screws are counted from 1.
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
"""Ranges of the base on the belt: reference point (in), direction of its line of centres (deg)."""
RUBBING: Final = ("pad", "table", "part", "thread")
DRILLED: Final = ("base", "gasket", "top")  # the parts with screw holes, each drilled with errors of its own
STOOD: Final = ("gasket", "top")
"""The parts that a person puts on a stand, which holds them by nothing but friction."""
SCREWS: Final = "pump.screws"
MAKES: Final = (6, 7)
"""Numbers of screws, and of tapped holes, of the pumps that there are."""
USUAL: Final = 6

_VISION: Final = "Vision study, section 3."
IN_PLAY: Final = 70.0
"""Percent of its play that a part can be off along an axis: it stays clear of the corners of its seat."""


def screws(world: WorldSpec) -> int:
    """Screws and tapped holes of the pump of a world."""
    return round(variation().value(SCREWS, world))


@cache
def variation() -> Variation:
    """The quantities in which worlds differ."""
    return Variation(
        *_make(), *_belt(), *arm(), *hand(),
        *group(
            "screwdriver", {"torque_noise": Noise(0.004)}, "N m",
            "Noise of the screwdriver's motor current, as torque.",
            unsourced="about a hundredth of the torque at which its clutch slips. Bound: .02 N m, the torque of a "
            "clean thread, which the program feels.",
        ),
        *_camera(), *_light(), *_fixtures(), *_holes(), *_parts(),
    )  # fmt: skip


def _make() -> Iterator[Quantity]:
    yield Quantity(
        name=SCREWS, unit="", distribution=Choice(tuple(map(float, MAKES))), nominal=float(USUAL),
        source="How many screws the pump has, in as many tapped holes: the job, and no error. No seed draws it and no "
        "level scales it. The seventh is that of a later make, of which the program of 1973 knows nothing.",
    )  # fmt: skip


def _of(number: int, quantities: Iterator[Quantity]) -> Iterator[Quantity]:
    """Quantities of the screw or hole of a number, which pumps of fewer screws lack."""
    where = (SCREWS, float(number)) if number > USUAL else None
    return (replace(quantity, where=where) for quantity in quantities)


def _belt() -> Iterator[Quantity]:
    for name, (low, high), unit in (("x", BELT_X, "in"), ("y", BELT_Y, "in"), ("yaw", BELT_LINE, "deg")):
        yield from group(
            "base", {name: Range(low, high)}, unit,
            "Where the pump base lies on the belt: its reference point, and the direction of its line of centres. "
            "Layout study, section 2.",
            nominal=(low + high) / 2,
        )  # fmt: skip


def _camera() -> Iterator[Quantity]:
    lenses = ("25mm", "50mm")
    middle = "Where the middle of the lens is, against the drawing."
    turret = (
        f"sheets of lenses do not give the entrance pupil, and no drawing of the turret is known. {DOUBLED}"
    )
    aside = {way: Normal(0.1) for way in ("ahead", "side", "up")}
    return chain(
        group("camera.place", {axis: Normal(0.15) for axis in "xyz"}, "in",
            f"Where the camera's mount is, each axis. {_VISION}"),
        group("camera.turn", {axis: Normal(0.2) for axis in ("pan", "tilt", "roll")}, "deg",
            f"How the camera's mount is turned. {_VISION}"),
        group("camera.focal_length", {lens: Normal(0.4) for lens in lenses}, "%",
            f"Focal length of each lens over that of the drawing. {_VISION}", least=-50.0),
        group("camera", {"pot_noise": Noise(0.07)}, "deg",
            "Noise of the pan and tilt readings. Vision study: .07-.10 reproduces 1973."),
        *(group(f"camera.lens.{lens}", aside, "in", middle, unsourced=turret) for lens in lenses),
        group("camera.raster", {"pincushion": Normal(0.5), "lines": Normal(0.4), "field": Normal(0.4)}, "%",
            "Shape of the raster: how far a corner is drawn in, over its distance from the middle, and how far the "
            "middle of lines and of the field is off, over half their length. Honesty study, finding 10: 1 % at the "
            "corners."),
        group("camera.raster", {"drift": Noise(0.3)}, "%",
            "How far each picture lies off the one before, over half its length and height: half a point. The paper "
            "speaks of a slight shift between two pictures; vision study, section 4: up to a point."),
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
        yield from group(
            f"fixtures.{station}",
            {"x": Normal(0.02), "y": Normal(0.02), "z": Normal(0.01), "yaw": Normal(0.2), "pitch": Normal(0.1),
             "roll": Normal(0.1)},
            ("in", "in", "in", "deg", "deg", "deg"),
            "Where the fixture stands against its drawing, how high, and how it tilts, set up with a rule, a square "
            "and a spirit level. Sigma is what ISO 2768-1 allows in class m, which a third of them then exceed: .5 mm "
            "over 120 to 400 mm, .3 mm of height over 30 to 120 mm, 20 minutes over 50 to 120 mm. A rule is divided to "
            "1/64 in; a spirit level is good for .5 to 1 mm/m, .03 to .06 deg.",
        )  # fmt: skip


def _holes() -> Iterator[Quantity]:
    for part in DRILLED:
        for hole in range(1, max(MAKES) + 1):
            yield from _of(hole, group(
                f"holes.{part}.{hole}", {"x": Normal(0.0015), "y": Normal(0.0015)}, "in",
                f"Where the screw hole of the {part} is against its drawing. The base's are tapped, those of gasket "
                "and top drilled apart from them.",
                unsourced="no drawing of the pump is known; two sigma are +-.003 in, as a jig drills. Bound: +-.004 in "
                "over 6 to 30 mm and +-.006 in over 30 to 120 mm, class f of ISO 2768-1.",
            ))  # fmt: skip


def _parts() -> Iterator[Quantity]:
    stood = "Where a person has put the part on its stand, against the drawing. Honesty study, finding 9."
    off = {"x": Uniform(0.03), "y": Uniform(0.03), "yaw": Uniform(1.0)}
    played = (
        "Where it is within the play that guides or hole leave it. Even, so far that it stays within them at the high "
        "level too. A pin has none: the bevel that it stands in puts it in the middle."
    )
    play = {axis: Uniform(IN_PLAY / 2) for axis in "xy"}
    numbers = range(1, max(MAKES) + 1)
    masses = "Masses of base and top over those of the drawing."
    cast = (
        "no drawing of the castings is known. Bound: 10 to 15 %, which foundries allow for the thickness of walls in "
        "sand (Badger Iron Works)."
    )
    starts = "Where the thread of a screw hole starts."
    return chain(
        *(group(f"parts.{part}", off, ("in", "in", "deg"), stood) for part in STOOD),
        group("parts.driver", play, "%", played, greatest=IN_PLAY),
        *(_of(k, group(f"parts.screws.{k}", play, "%", played, greatest=IN_PLAY)) for k in numbers),
        group("parts.driver", {"yaw": Uniform(0.3)}, "deg",
            "Turn of the screwdriver in its guides. What their play allows beside its place.", greatest=0.6),
        [Quantity(name="part_mass", unit="%", distribution=Normal(2.0), limits=(-90.0, MOST["%"]), source=masses,
                  unsourced=cast)],
        rubbing(RUBBING),
        *(_of(k, group("thread_phase", {str(k): Phase()}, "deg", starts)) for k in numbers),
    )  # fmt: skip
