"""The findings of the pump's referee, each with the claims on which it rests."""

from collections.abc import Iterator
from typing import Final

from handeye.core.units import INCH, MILLIMETRE
from handeye.proof.obligation import Obligation
from handeye.tasks.water_pump.obligations.claims import PumpClaims


def obligations(screws: int) -> tuple[Obligation, ...]:
    """Return the obligations for a pump with a given number of screws."""
    return (
        *_sensed(screws),
        *(Obligation(finding=name, rests=why) for name, why in _UNSENSED.items()),
    )


def _sensed(screws: int) -> Iterator[Obligation]:
    claims = PumpClaims(screws)
    heads, driven, tight, threaded, sizes = (
        tuple(map(claim, range(screws)))
        for claim in (claims.head, claims.driven, claims.tight, claims.threaded, claims.size)
    )
    far, left, free = claims.against("far"), claims.against("left"), claims.free()
    pins, rack, bearing = (claims.pin(0), claims.pin(1)), (claims.rack(),), (claims.bearing(),)
    yield from (
        Obligation(finding="base_far", claims=(far,), rests=_SLIDES),
        Obligation(finding="base_left", claims=(left,), rests=_SLIDES),
        Obligation(
            finding="base_yaw", claims=(far,),
            rests="A push against the far block turns the base until the straight edge of the base lies along the "
            "block.",
        ),
        Obligation(
            finding="base_height", claims=(claims.level(), *map(claims.face, range(4))),
            rests="A base that is too high by less than .04 in may remain unnoticed; the referee allows .02 in.",
        ),
        Obligation(
            finding="base_tilt", claims=(claims.side(0, 3), claims.side(1, 2)),
            rests="A base that leans across the line of the large holes by less than .6 degrees may remain "
            "unnoticed; the referee allows .3 degrees.",
        ),
        Obligation(finding="gasket_height", claims=heads, rests=_LAYERS),
        Obligation(
            finding="gasket_place", claims=(claims.gasket(),),
            rests="A displaced gasket is noticed only if the pictures show one of its edges out of place.",
        ),
        Obligation(finding="top_height", claims=heads, rests=_LAYERS),
        Obligation(
            finding="top_place", claims=threaded,
            rests="A screw reaches its thread only through its hole in the top.",
        ),
        Obligation(
            finding="screws",
            claims=(*driven, *heads),
            rests="Only a screw resists the driver, and only a screw has a head at the height that the fingers feel.",
        ),
        Obligation(
            finding="screws_depth", claims=heads,
            rests="A head that stands too high by less than .02 in may remain unnoticed; the referee allows .008 in.",
            unnoticed=0.02 * INCH / MILLIMETRE,
        ),
        Obligation(
            finding="screws_thread", claims=threaded,
            rests="The screw has the length that the drawing gives (screws_size).",
        ),
        Obligation(
            finding="screws_place", claims=threaded, rests="A thread holds its screw on the axis of the hole."
        ),
        Obligation(
            finding="screws_size", claims=sizes,
            rests="Only the length of a screw is felt, with a tolerance of .12 in; the referee allows .014 in.",
        ),
        Obligation(finding="screws_lean", claims=heads, rests="A leaning screw rests on one side of its head."),
        Obligation(finding="screws_crossed", claims=threaded, rests="A crossed screw stops at least .17 in too high."),
        Obligation(
            finding="screws_clamp", claims=tight,
            rests="A screw that is driven later shifts the load of the others. The program measures the torque, not "
            "the clamping force: if a thread is hard to turn, its screw clamps less.",
        ),
        Obligation(finding="screws_strain", claims=(claims.gentle(),), rests=_CLUTCH),
        Obligation(finding="screws_turned", claims=(claims.gentle(),), rests=_CLUTCH),
        Obligation(finding="pins", claims=pins, rests=_HOLDER),
        Obligation(finding="pins_tilt", claims=pins, rests=_HOLDER),
        Obligation(finding="rack", claims=rack, rests=_RACK),
        Obligation(finding="rack_tilt", claims=rack, rests=_RACK),
        Obligation(
            finding="dispenser", claims=driven, rests="If each thread has its screw, no screw lies elsewhere."
        ),
        Obligation(
            finding="rotor", claims=free,
            rests="A rotor that resists with less than .125 N m may remain unnoticed; the referee allows .1 N m.",
        ),
        Obligation(finding="rotor_place", claims=bearing, rests=_BEARING),
        Obligation(finding="rotor_lean", claims=bearing, rests=_BEARING),
        Obligation(finding="hand", claims=(claims.away(),), rests="No part stands at the parking place."),
        Obligation(finding="motor", claims=(claims.motor_off(),), rests=_SERVO),
        Obligation(
            finding="rest", claims=(claims.released(),),
            rests="A program need not touch a part that no other finding needs, so a part that hangs from the hand "
            "may remain unnoticed.",
        ),
    )  # fmt: skip


_SLIDES: Final = "A push with more than 40 oz slides the pump on the table."
_LAYERS: Final = (
    "An object under the head of a screw raises the head. An object that raises the head by less than .02 in may "
    "remain unnoticed; the referee allows .012 in."
)
_CLUTCH: Final = "The clamping force that a torque causes depends on the friction of the thread and the head."
_HOLDER: Final = "If a pin leans or is not in its hole, its end is lower or higher than it should be."
_RACK: Final = (
    "If the screwdriver leans or hangs on its guides, its end is lower or higher than it should be."
)
_BEARING: Final = (
    "Only the height of the crank pin's end is felt. A bent crank may remain unnoticed, and so may a rotor that is "
    "out of its bearing by less than .07 in; the referee allows .004 in."
)
_SERVO: Final = (
    "The arm and the hand have executed all commands, because each step waits for the end of its motion."
)
_UNSENSED: Final = {
    "screws_hold": "To test whether a screw holds, the arm would have to loosen the screw.",
    "threads_scarred": (
        "The arm does not feel a scar in a thread. The referee does not reject a scarred thread, but adds a "
        "caution."
    ),
    "floor": "No step looks under the table.",
    "tray": (
        "In the simulation, a carrier represents a screw in its thread; the body of the screw stays on a tray."
    ),
    "still": "No step waits to see whether a part comes to rest.",
    "arm_still": (
        "The program does not measure whether the arm is at rest; the servo ends each motion at rest, or raises an "
        "error."
    ),
    "overlap_bores": "In the simulation, solids do not pass through each other.",
    "overlap": "In the simulation, solids do not pass through each other.",
    "as_drawn": "In the simulation, a part keeps its shape, mass and friction during a run.",
    "bonds": "In the simulation, a bond opens or closes only when the assembly requires it.",
    "held": "In the simulation, only the arm acts on the parts.",
    "numbers": "In the simulation, all numbers are finite.",
}
"""Findings of the referee that no program has to prove, each with the reason."""
