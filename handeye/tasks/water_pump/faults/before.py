"""Faults that are present before a run: parts of the pump or its cell are missing, misplaced, or of a wrong size.

The scene contains the faulty part from the beginning. All devices work correctly.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, partial
from typing import TYPE_CHECKING, Final, Literal

from handeye.core.errors import (
    FEATURES_NOT_SEEN,
    GASKET_WRONG,
    JOINT_LIMIT,
    NO_SOLUTION,
    NOTHING_HELD,
    PART_NOT_SEEN,
    SEARCH_EXHAUSTED,
    WRONG_HEIGHT,
)
from handeye.core.faults import ExpectedDetection, Fault, Size
from handeye.tasks.stanford_cell.dimensions import Point, dimensions, web_centre
from handeye.tasks.water_pump.faults import scene_changes as scene
from handeye.tasks.water_pump.faults import shared_expectations as detect
from handeye.tasks.water_pump.faults.declaration import PumpFault, broken
from handeye.tasks.water_pump.world.stations import Station

if TYPE_CHECKING:
    import mujoco

_SMOOTH: Final = "bit.smooth"
_AWAY: Final = Size(unit="mm", usual=6.0, limits=(-50.0, 50.0))


Change = Callable[["mujoco.MjSpec", float], None]  # changes a scene, given the value of the fault (SI)
PartFault = PumpFault[Change]


@cache
def part_faults(screws: int) -> tuple[PartFault, ...]:
    """Return all faults of the parts of a pump with the given number of screws, in the order of the catalogue."""
    return (
        *_base(), *_gasket(), *_top(), *_pins(), *_screws(screws), *_holes(screws), *_stations(screws),
        *_screwdriver_and_light(),
    )  # fmt: skip


def break_parts(spec: mujoco.MjSpec, faults: Sequence[Fault], screws: int) -> None:
    """Apply the faults of parts to a scene. Faults of devices do not change the scene."""
    for fault, change in broken(part_faults(screws), faults):
        change(spec, fault.value or 0.0)


def _fault(
    name: str, meaning: str, breaks: Change, expected: ExpectedDetection, size: Size | None = None
) -> PartFault:
    return PumpFault(name=name, meaning=meaning, when="before", size=size, expected=expected, breaks=breaks)


def _base() -> Iterator[PartFault]:
    yield _fault(
        "base.missing", "Nothing lies on the belt.", partial(scene.missing, "base"),
        ExpectedDetection(errors=(PART_NOT_SEEN,), calls=(detect.UNSEEN,)),
    )  # fmt: skip
    yield _fault(
        "base.turned", (
            "The base is turned: the line from its first to its second large hole has this angle to the x axis of "
            "the table."
        ),
        lambda spec, yaw: scene.turn(spec, "base", scene.plate_centre(), yaw),
        ExpectedDetection(
            errors=(PART_NOT_SEEN, FEATURES_NOT_SEEN), calls=(detect.UNSEEN,),
            harmless="The job allows any direction of the base within the arm's reach.",
        ),
        Size(unit="deg", usual=35.0, limits=(-360.0, 360.0)),
    )  # fmt: skip
    yield _fault(
        "base.far", (
            "The belt has carried the base too far by this distance. The base is out of the arm's reach or out of "
            "sight."
        ),
        partial(scene.shift, "base", (0.0, 1.0)),
        ExpectedDetection(errors=(PART_NOT_SEEN, NO_SOLUTION, JOINT_LIMIT), calls=(detect.UNSEEN,)),
        Size(unit="in", usual=18.0, limits=(-60.0, 60.0)),
    )  # fmt: skip
    yield _fault(
        "base.reversed", "The base lies the wrong way round, turned by 180 degrees.",
        lambda spec, _: scene.reverse(spec, "base", scene.plate_centre()),
        ExpectedDetection(errors=(PART_NOT_SEEN, FEATURES_NOT_SEEN), calls=(detect.UNSEEN,)),
    )  # fmt: skip


def _gasket() -> Iterator[PartFault]:
    part, middle = "gasket", (web_centre(), 0.0)
    thin = dimensions()("gasket.thickness")
    high = ExpectedDetection(errors=(WRONG_HEIGHT,), calls=(detect.TOO_HIGH,))
    wrong = ExpectedDetection(errors=(WRONG_HEIGHT,), calls=(detect.TOO_LOW, detect.TOO_HIGH))
    yield _fault(
        "gasket.missing", "There is no gasket on the gasket stand.", partial(scene.missing, part),
        ExpectedDetection(errors=(NOTHING_HELD,), calls=(detect.GASKET_OFF,), stages=(detect.PUT_ON_GASKET,)),
    )  # fmt: skip
    yield _fault(
        "gasket.doubled", "Two gaskets stick together.", lambda spec, _: scene.thicken(spec, 2.0), high
    )
    yield _fault(
        "gasket.thick", "The gasket has this thickness instead of .06 in.",
        lambda spec, thick: scene.thicken(spec, thick / thin), wrong,
        Size(unit="in", usual=0.09, limits=(0.02, 0.5)),
    )  # fmt: skip
    yield from _moved(part, "the gasket", {
        "x": ExpectedDetection(calls=(detect.GASKET_OFF,), harmless=(
            "The hand searches for the gasket around the place where the gasket should lie."
        )),
        "y": ExpectedDetection(
            errors=(SEARCH_EXHAUSTED,), calls=(detect.GASKET_OFF, detect.ON_PINS),
            harmless="The search finds the pins even if the hand holds the gasket .25 inch off its centre.",
        ),
    })  # fmt: skip
    yield _fault(
        "gasket.turned", "The gasket is turned about the vertical on its stand.",
        lambda spec, angle: scene.turn(spec, part, middle, scene.yaw_of(spec, part) + angle),
        ExpectedDetection(
            errors=(SEARCH_EXHAUSTED,),
            # A gasket that goes down beside the pins does not cover the place where the hand measures its thickness.
            calls=(detect.GASKET_OFF, detect.ON_PINS, detect.TOO_LOW),
            harmless="The fingers straighten the gasket when they close on it.",
        ),
        Size(unit="deg", usual=12.0, limits=(-90.0, 90.0)),
    )  # fmt: skip
    yield _fault(
        "gasket.reversed", "The gasket lies the wrong way round, turned by 180 degrees.",
        lambda spec, _: scene.reverse(spec, part, middle),
        # A reversed gasket may stop on the pins where a laid one does. Then it falls beside the face of the base.
        ExpectedDetection(calls=(detect.GASKET_LOST, detect.TOO_LOW)),
    )  # fmt: skip
    yield _fault(
        "gasket.torn", "A square with sides of this length is torn off the gasket around screw hole 6.", scene.tear,
        ExpectedDetection(errors=(GASKET_WRONG,), calls=(detect.NOT_ON,)),
        Size(unit="mm", usual=18.0, limits=(0.0, 30.0)),
    )  # fmt: skip


def _top() -> Iterator[PartFault]:
    yield _fault(
        "top.missing", "There is no top on the top stand.", partial(scene.missing, "top"),
        ExpectedDetection(calls=(detect.NO_TOP, detect.TOP_LOST), stages=(detect.PUT_ON_TOP,)),
    )  # fmt: skip
    off = ExpectedDetection(
        errors=(SEARCH_EXHAUSTED,),
        calls=(detect.ON_PINS,),
        harmless="CENTER grasps the top where it is, and the search then finds the pins.",
    )
    yield from _moved("top", "the top", {"x": off, "y": off})
    yield _fault(
        "top.tilted", "On the stand, a chip of this height lies under one end of the top.", scene.chip,
        ExpectedDetection(
            errors=(WRONG_HEIGHT, SEARCH_EXHAUSTED),
            calls=(detect.NOT_FLAT, "PIN {number} DOES NOT STAND: THE TOP HAS DRAWN IT OUT", detect.ON_PINS),
            stages=(detect.PUT_ON_TOP,),
            harmless="When the fingers close on the two flats of the top's hub, they straighten the top.",
        ),
        Size(unit="mm", usual=6.0, limits=(0.1, 15.0)),
    )  # fmt: skip
    yield _fault(
        "top.reversed", "The top lies the wrong way round, turned by 180 degrees.",
        lambda spec, _: scene.reverse(spec, "top", (0.0, 0.0)),
        ExpectedDetection(calls=(detect.TOP_LOST,)),
    )  # fmt: skip


def _moved(part: str, article: str, expected: Mapping[str, ExpectedDetection]) -> Iterator[PartFault]:
    for axis, direction in (("x", (1.0, 0.0)), ("y", (0.0, 1.0))):
        meaning = f"On its stand, {article} is displaced by this distance along table {axis}."
        yield _fault(
            f"{part}.off.{axis}", meaning, partial(scene.shift, part, direction), expected[axis], _AWAY
        )


def _pins() -> Iterator[PartFault]:
    for number in (1, 2):
        pin = f"pin{number - 1}"
        meaning = f"Aligning pin {number} is not in its holder."
        yield _fault(f"pin.{number}.missing", meaning, partial(scene.missing, pin), detect.NO_PIN)
        yield _fault(
            f"pin.{number}.thick", f"The radius of the nose of aligning pin {number} is larger by this amount.",
            partial(scene.thick_nose, pin), detect.NO_HOLE_FOR_PIN, Size(unit="mm", usual=0.2, limits=(-1.0, 0.25)),
        )  # fmt: skip


def _screws(count: int) -> Iterator[PartFault]:
    for number in range(1, count + 1):
        screw, loose = f"screw{number - 1}", detect.loose_screw(number)

        def calls(*texts: str, number: int = number) -> ExpectedDetection:
            return detect.if_used(number, ExpectedDetection(calls=texts))

        yield _fault(
            f"screw.{number}.missing", f"Screw {number} is not in the dispenser.", partial(scene.missing, screw),
            calls(detect.NO_SCREW),
        )  # fmt: skip
        yield _fault(
            f"screw.{number}.burred",
            f"A burr increases the radius of the point of screw {number} by this amount; if the amount is .35 mm or "
            "more, the screw enters no tapped hole.",
            partial(scene.thick_point, screw), calls(detect.misfit_screw(number), loose),
            Size(unit="mm", usual=0.5, limits=(0.0, 0.8)),
        )  # fmt: skip
        yield _fault(
            f"screw.{number}.slotless",
            f"The head of screw {number} has no slot: the bit slips, and the screw enters no thread.",
            partial(scene.slippery, f"screw_head{number - 1}"), calls(loose),
        )  # fmt: skip


def _holes(count: int) -> Iterator[PartFault]:
    for number in range(1, count + 1):
        hole, screw = number - 1, detect.screw_of(number)
        misfit, loose, high = detect.misfit_screw(screw), detect.loose_screw(screw), detect.high_screw(screw)
        blocked = ExpectedDetection(calls=(misfit, high))
        full = ExpectedDetection(  # the mouth of a filled hole still takes a point, less than one thread deep
            errors=(SEARCH_EXHAUSTED,),
            calls=(misfit, loose, detect.SCREW_IN_NO_HOLE),
            stages=(detect.DRIVE_FIRST if screw <= 2 else detect.DRIVE_LAST,),
        )
        if number in detect.PINNED:
            blocked = full = detect.NO_HOLE_FOR_PIN
        for name, meaning, breaks, expected, size in (
            (f"hole.{number}.blocked", f"Tapped hole {number} of the base is open only to this depth below its mouth.",
             partial(scene.block, hole, "plug"), blocked, Size(unit="mm", usual=2.0, limits=(0.0, 20.0))),
            (f"thread.{number}.scarred",
             f"An earlier screw was cross-threaded in tapped hole {number}, so that the next screw cross-threads "
             "more easily.", scene.as_drawn,
             ExpectedDetection(
                 harmless="A screw that enters straight reaches its seat, even in a scarred thread; the referee "
                 "adds a caution."
             ), None),
            (f"thread.{number}.crosses",
             f"Every screw in tapped hole {number} cross-threads, however straight it is.", scene.as_drawn,
             ExpectedDetection(calls=(high,)), None),
            (f"thread.{number}.stripped",
             f"The thread of tapped hole {number} is worn away: a screw slides in and clamps nothing.",
             partial(scene.strip, hole), ExpectedDetection(calls=(loose, detect.driven_loose_screw(screw))), None),
            (f"thread.{number}.full",
             f"The shank of a broken screw fills tapped hole {number} up to its mouth.",
             partial(scene.block, hole, "stub"), full, None),
        ):  # fmt: skip
            yield _fault(name, meaning, breaks, detect.if_used(number, expected), size)


def _stations(screws: int) -> Iterator[PartFault]:
    """Yield the faults in which a station has moved on the table, together with the parts in it."""
    waiting, expected = [f"screw{k}" for k in range(screws)], detect.MOVED_DISPENSER
    yield from _station(Station.DISPENSER, "dispenser with its screws", waiting, expected, usual=9.0)
    yield from _station(
        Station.TOP_STAND, "stand of the top, with the top,", ["top"], detect.MOVED_TOP_STAND, usual=20.0
    )


def _station(
    station: Station, noun: str, waiting: Sequence[str], expected: ExpectedDetection, usual: float
) -> Iterator[PartFault]:
    def shift(direction: Point, spec: mujoco.MjSpec, away: float) -> None:
        for body in (station, *waiting):
            scene.shift(body, direction, spec, away)

    for axis, direction in (("x", (1.0, 0.0)), ("y", (0.0, 1.0))):
        yield _fault(
            f"{station}.moved.{axis}", f"The {noun} has moved by this distance along table {axis}.",
            partial(shift, direction), expected, Size(unit="mm", usual=usual, limits=(-50.0, 50.0)),
        )  # fmt: skip


def _screwdriver_and_light() -> Iterator[PartFault]:
    yield _fault(
        "screwdriver.missing", "The screwdriver is not in its rack.", partial(scene.missing, "driver"),
        ExpectedDetection(errors=(NOTHING_HELD,), calls=(detect.NO_DRIVER,), stages=(detect.DRIVE_FIRST,)),
    )  # fmt: skip
    yield _fault(
        _SMOOTH, "The bit has no friction, so it cannot drive a screw into its thread.", partial(scene.slippery, "bit"),
        ExpectedDetection(calls=(detect.loose_screw(1),)),
    )  # fmt: skip
    yield _fault(
        "light.shadow", (
            "A card hangs between the lamp and the base, and the edge of its shadow crosses the base."
        ), scene.shade,
        detect.POOR_LIGHT,
    )  # fmt: skip


def bad_threads(faults: Sequence[Fault], how: Literal["scarred", "crosses"]) -> frozenset[int]:
    """Return the indices of the tapped holes whose threads are bad. `scarred` selects the holes that an earlier screw
    has cross-threaded; `crosses` selects the holes in which every screw cross-threads.
    """
    return _numbered(faults, "thread", how)


def slipping_screws(faults: Sequence[Fault], count: int) -> frozenset[int]:
    """Return the indices of the screws on which the bit slips: screws without a slot, or all screws if the bit is
    smooth. Such a screw enters no thread.
    """
    if any(fault.name == _SMOOTH for fault in faults):
        return frozenset(range(count))
    return _numbered(faults, "screw", "slotless")


def _numbered(faults: Sequence[Fault], thing: str, what: str) -> frozenset[int]:
    """Return the numbers from those names of faults that have the form THING.NUMBER.WHAT, with the given THING and
    WHAT. The returned numbers are counted from 0.
    """
    names = (fault.name.split(".") for fault in faults)
    return frozenset(
        int(name[1]) - 1 for name in names if len(name) == 3 and (name[0], name[2]) == (thing, what)
    )
