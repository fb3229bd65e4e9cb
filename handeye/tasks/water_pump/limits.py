"""Limits of the referee, each with its unit and its reason."""

from typing import Final

BLOCK_GAP: Final = 1.27  # mm, .05 in: reference test 59, displacement from the standard position
BASE_HEIGHT: Final = (
    0.5  # mm of its reference point: contact softness; a base that hangs on a block stands 6 mm high
)
BASE_TILT: Final = 0.3  # deg: 1 mm over the length of the plate's shorter half
BASE_YAW: Final = 1.0  # deg, of the base's edge against the far block: the assembly study's criterion

GASKET_HEIGHT: Final = 0.3  # mm off nominal: half of it would already be a lost chip under it; assembly study
GASKET_TILT: Final = 0.5  # deg: .3 mm over 1.4 in; assembly study
# Where pins put a layer: their play in it (gasket .25, top .11 mm), in the bore (.1) and the drilling of the bores
# (.22), and 1.3 times that at the screw hole farthest from both pins.
GASKET_PLACE: Final = 0.75  # mm at the worst screw hole

TOP_HEIGHT: Final = 0.3  # mm off nominal: assembly study; a top that hangs on a pin stands 22 mm high
TOP_TILT: Final = 0.5  # deg: assembly study
TOP_PLACE: Final = 0.57  # mm at the worst screw hole

# A crossed screw stands 4.4 to 5.7 mm high; assembly study.
SCREW_GAP: Final = 0.2  # mm between head and flange
SCREW_CLAMP: Final = 40.0  # N, each: over the 19 N of a hand's pull; seated screws end at 70-200 N

PIN_PLACE: Final = 3.0  # mm from its place in the holder: the holder's hole and its bevel
PIN_TILT: Final = 10.0  # deg: the pin stands, it does not lean out
RACK_TILT: Final = 5.0  # deg: what the play of the guides allows, and no more than leaning
RACK_PLACE: Final = 3.0  # mm from its place in the rack: guides and their bevels

ROTOR_TORQUE: Final = 0.35  # N m: 40 oz at the crank's 1.25 in, the reference's check of the rotor
ROTOR_TURN: Final = 5.0  # deg: so far it must go to count as turning

FLOOR: Final = -5.0  # mm: nothing may be lower than this under the table top
PENETRATION: Final = 0.15  # mm: contacts are soft; six screws press parts .05 mm into each other
