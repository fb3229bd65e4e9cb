"""Limits of the referee, each with its unit and its reason."""

from typing import Final

BLOCK_GAP: Final = 1.27  # mm, .05 in: reference test 59, displacement from the standard position
BASE_HEIGHT: Final = (
    0.5  # mm of its reference point: contact softness; a base that hangs on a block stands 6 mm high
)
BASE_TILT: Final = 0.3  # deg: 1 mm over the length of the plate's shorter half
BASE_YAW: Final = 1.0  # deg, of the base's edge against the far block: the assembly study's criterion

LAYER_HEIGHT: Final = 0.3
"""mm off nominal, at each screw hole: half of it would already be a lost chip under it; assembly study."""

SCREW_GAP: Final = 0.2
"""mm between head and flange. A crossed screw stands 4.4 to 5.7 mm high; assembly study."""
SCREW_CLAMP: Final = 40.0  # N, each: over the 19 N of a hand's pull; seated screws end at 56 to 298 N
SCREW_TURNED: Final = 400.0
"""N with which a head pressed when it was last turned. Pumps that the arm has made have up to 250; the driver's clutch,
.32 N m, makes up to 357 where thread and head rub as little as in any world. Twice its torque makes 530 to 560."""
SCREW_STRAIN: Final = 420.0
"""N under a head. Screws turned home later shift the load: pumps that the arm has made have up to 298."""
SCREW_HOLD: Final = 0.02
"""N m to turn a screw back: what a clean thread rubs with where nothing clamps it. With 40 N it is .026 at the least
friction of any world; without friction the clamp itself turns the screw out."""
SCREW_SIZE: Final = 0.35
"""mm off the drawing in any length or radius: the play of a screw's point in a tapped hole."""
SCREW_THREAD: Final = 6.35
"""mm in the base: one diameter of 1/4 in, the rule for steel. A seated screw has 6.93."""
SCREW_PLACE: Final = 0.12
"""mm: the loosest fit of a 1/4-20 thread of class 2, pitch diameters .2127 in and .2224 in; ASME B1.1."""
SCREW_LEAN: Final = 1.0  # deg: a head 11 mm wide that leans farther gapes by SCREW_GAP
SCARS: Final = 0
"""Threads; a caution. What a scar does to a pump is judged by itself: a screw that was backed out and driven straight
holds as any other if it clamps (SCREW_CLAMP), stands straight (SCREW_LEAN) and has its length of thread (SCREW_THREAD).
But anyone who takes the pump apart has to know: a thread that was cut twice strips sooner."""
SOFT: Final = 0.03
"""mm over the clearance of a shank or pin in its hole. Contacts are soft: a shank that was pressed on a bore with 4 to
32 N went .02 mm into it, with 64 N .033. One that cuts metal goes farther."""

PIN_PLACE: Final = 3.0  # mm from its place in the holder: the holder's hole and its bevel
PIN_TILT: Final = 10.0  # deg: the pin stands, it does not lean out
RACK_TILT: Final = 5.0  # deg: what the play of the guides allows, and no more than leaning
RACK_PLACE: Final = 3.0  # mm from its place in the rack: guides and their bevels

ROTOR_TORQUE: Final = 0.1
"""N m to turn the rotor all the way round, either way and back: twice its friction, .05 N m in every world, which no
quantity varies. Its inertia and bearing add .01 at the rate of the referee's turn. The reference's check, 40 oz at
the crank, is .35 N m: a rotor that needs as much binds."""

ROTOR_PLACE: Final = 0.1  # mm from its bearing, and of its crank: the bearing is drawn without play
ROTOR_LEAN: Final = 0.1  # deg against the top, which it is drawn square to

STILL: Final = 1.0
"""mm/s of any point of a part or of the arm: as contacts come to rest, parts that lie still go at up to .1 mm/s; a
joint that its brake holds creeps by 9e-6 rad/s, .01 mm/s at the hand."""

REST: Final = 0.25
"""mm that anything may go until it has settled: pumps that the arm has made settle by up to .03. What hangs in the air
falls."""

HAND_CLEAR: Final = 25.0  # mm from the hand to any part: a hand that holds or touches something is nearer

APART: Final = 3.0  # mm from where the run found a part: what the arm puts back, its next run must find
APART_GASKET: Final = 6.0
"""mm. Fingers that close on the gasket in its tray draw it along before they lift it, 3.3 mm in seed 0. It is laid back
where it was lifted; at 6.4 mm its holes would not let the fingers of the next run in."""
APART_TURN: Final = (
    3.0  # deg: at the end of a part as long as the base, half of what the fingers have to spare
)

SETTLE: Final = 0.2  # s: forces come up to date, and what hangs in the air falls
TRAY: Final = 3.0
"""mm from its place on the tray under the floor, where the body of a screw lies that a thread stands for: one that is
elsewhere would be there twice."""
FORCE: Final = 0.0  # N and N m from outside on a part or the arm: nothing is held by an unseen hand
MERGED: Final = 0.1
"""mm that a layer may lie off the weld that holds it while it is clamped. Screws turned home later press it off that:
by up to .030 in pumps that the arm has made."""
MERGED_TURN: Final = 0.1  # deg, the same: up to .017
ALTERED: Final = 0  # parts: a scene is made the same to the byte whenever it is made
FLOOR: Final = -5.0  # mm: nothing may be lower than this under the table top
PENETRATION: Final = 0.15  # mm of parts pressed on each other: contacts are soft; six screws make it .06 mm
