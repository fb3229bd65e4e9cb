"""Limits of the referee, each with unit and reason."""

from typing import Final

BLOCK_GAP: Final = 1.27  # mm, .05 in: reference test 59, displacement from the standard position
BASE_HEIGHT: Final = 0.5
"""Greatest height error (mm) of the base's reference point. The limit is not 0, because contacts are soft. A base that
hangs on a block is 6 mm too high.
"""
BASE_TILT: Final = 0.3  # deg: 1 mm over the length of the plate's shorter half
BASE_YAW: Final = 1.0  # deg, of the base's edge against the far block: the assembly study's criterion

LAYER_HEIGHT: Final = 0.3
"""Greatest deviation (mm) of a layer from its nominal height, measured at each screw hole. A chip that was lost under
the layer would already show as a deviation of half this limit (assembly study).
"""

SCREW_GAP: Final = 0.2
"""Greatest gap between head and flange (mm). A cross-threaded screw stands 4.4 to 5.7 mm high (assembly study)."""
SCREW_CLAMP: Final = 40.0
"""Least clamping force of a screw (N). The limit exceeds 19 N, the force with which a hand pulls. The clamping force of
seated screws is 56 to 298 N.
"""
SCREW_TURNED: Final = 400.0
"""Greatest force (N) under the head of a screw when the screw was last turned. In pumps that the arm has made, this
force is at most 250 N. With the least friction that thread and head have in any world, the torque of the driver's
clutch, .32 N m, causes at most 357 N; twice this torque causes 530 to 560 N.
"""
SCREW_STRAIN: Final = 420.0
"""Greatest force (N) under the head of a screw when the work is finished. The force may exceed SCREW_TURNED, because
screws that are tightened later shift the load. In pumps that the arm has made, the force is at most 298 N.
"""
SCREW_HOLD: Final = 0.02
"""A smaller torque (N m) must not turn a screw back. The limit is the friction torque of a clean thread without a
clamping force. With a clamping force of 40 N, a torque of at least .026 N m is needed to turn a screw back in any
world.
"""
SCREW_SIZE: Final = 0.35
"""Greatest deviation of any length or radius from the design (mm): the play of a screw's point in a tapped
hole.
"""
SCREW_THREAD: Final = 6.35
"""Least length of thread in the base (mm): one diameter of a 1/4 in screw, the rule for steel. A seated screw has 6.93
mm of thread in the base.
"""
SCREW_PLACE: Final = 0.12
"""Greatest distance (mm) between the axes of a screw and its hole. It is the play of the loosest fit of a 1/4-20
thread of class 2: half the difference between the pitch diameters .2127 in and .2224 in (ASME B1.1).
"""
SCREW_LEAN: Final = 1.0  # deg: at this tilt, one side of a head 11 mm wide is lifted by about SCREW_GAP
SCARS: Final = 0
"""Greatest number of scarred threads; a larger number only causes a warning. Other limits judge how a scar affects the
pump: a screw in a scarred thread holds like any other screw if it clamps (SCREW_CLAMP), stands straight (SCREW_LEAN)
and is deep enough in its thread (SCREW_THREAD). But a person who takes the pump apart must know of the scar, because a
thread that was cut twice strips sooner.
"""
SOFT: Final = 0.03
"""Tolerated overlap beyond the clearance of a shank or pin in its hole (mm). Contacts are soft: a shank that was
pressed against the wall of a bore went into the wall by .02 mm at 4 to 32 N, and by .033 mm at 64 N. A shank that cuts
metal goes deeper.
"""

PIN_PLACE: Final = 3.0  # mm from its place in the holder: the holder's hole and its bevel
PIN_SEATED: Final = 1.0
"""Greatest distance (mm) of the middle of a pin's shoulder from the mouth of its hole in the base: the depth of the
chamfer. If a pin stands in the chamfer, or beside its hole, this distance is at least 19 mm.
"""
PIN_LEAN: Final = 2.0
"""Greatest tilt (degrees) of a pin in its hole in the base. With .05 mm of play, a nose of 19 mm can tilt by .3
degrees. The limit is larger because the contacts are soft.
"""
PIN_TILT: Final = 10.0  # deg: a pin tilted by more leans out of the holder
RACK_TILT: Final = 5.0
"""Lean of the screwdriver (degrees) that the play of the guides allows. A screwdriver that is out of its guides leans
more.
"""
RACK_PLACE: Final = 3.0  # mm from its place in the rack: guides and their bevels

ROTOR_TORQUE: Final = 0.1
"""Greatest torque (N m) to turn the rotor all the way round, in both directions. The limit is twice the friction
torque of the rotor; this friction torque is .05 N m in every world. At the speed of the referee's turn, inertia and
bearing add .01 N m. A rotor that needs .35 N m binds. Our notes on the system of 1973 describe a weaker check: it
pushes the crank with 40 oz, and so accepts a rotor that needs .35 N m.
"""

ROTOR_PLACE: Final = 0.1
"""Greatest distance (mm) of the rotor from its bearing, and of the crank pin from its place. The bearing has no play.
"""
ROTOR_LEAN: Final = 0.1  # deg from the top's axis: in the design, the two axes are parallel

STILL: Final = 1.0
"""Greatest speed of any point of a part or of the arm (mm/s). While contacts settle, even a part that lies still moves
at up to .1 mm/s; a joint held by its brake creeps at 9e-6 rad/s, which is .01 mm/s at the hand.
"""

REST: Final = 0.25
"""Greatest distance (mm) that any part may move while the parts settle. In pumps that the arm has made, parts
settle by up to .03 mm; a part without support falls.
"""

HAND_CLEAR: Final = 25.0  # mm from the hand to any part: a hand that holds or touches something is nearer

APART: Final = 3.0  # mm from where the run found a part: the next run must find the part there again
APART_GASKET: Final = 6.0
"""Greatest distance of the returned gasket from its original position (mm). When the fingers close on the gasket, they
first drag it along its stand, by 3.3 mm in the world of seed 0, and then lift it. The arm returns the gasket to the
place from which it was lifted. In the next run, the fingers would not fit into the holes of a gasket that is displaced
by 6.4 mm.
"""
APART_TURN: Final = 3.0
"""Greatest turn (degrees) of a part. A turn by this angle moves the end of the base, or of a part as long as the base,
by half of the fingers' clearance.
"""

SETTLE: Final = 0.2  # s: long enough to compute the present forces, and for unsupported parts to fall
TRAY: Final = 3.0
"""Greatest distance (mm) of the parked body of a screw from its place on the tray below the floor. While a carrier
represents the screw, the body of the screw must stay on the tray: anywhere else, the body would be a second screw.
"""
FORCE: Final = 0.0  # N and N m, external, on a part or the arm: nothing may be held by an unseen hand
MERGED: Final = 0.1
"""Greatest distance (mm) between a clamped layer and the position in which its weld holds it. Screws that are
tightened later press the layer away from this position: by up to .030 mm in pumps that the arm has made.
"""
MERGED_TURN: Final = 0.1  # deg, the same limit for rotation; up to .017 deg in pumps that the arm has made
ALTERED: Final = 0  # parts; any difference counts, because building a scene again gives the same bytes
FLOOR: Final = -5.0  # mm, height relative to the table top: no part may be lower
PENETRATION: Final = 0.15
"""Greatest overlap (mm) of two solids. Parts that are pressed together overlap a little, because contacts are soft:
the force of six screws gives .06 mm.
"""
