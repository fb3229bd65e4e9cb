"""Adds the base, the plate, the pins, the screws, their fixtures and the screwdriver of arm 2 to the scene of the
gantries.
"""

from typing import Final

import mujoco

from handeye.cell.looks import SEEN
from handeye.systems.sigma.prco.drawing import (
    BASE,
    BIT,
    DISPENSER_HEIGHT,
    HOLDER_BORE,
    HOLDER_HEIGHT,
    HUB,
    PIN_BORE,
    PIN_DEPTH,
    PLATE,
    PLATE_PIN_BORE,
    PLAY,
    STAND_HEIGHT,
    Pump,
    dispenser_places,
    holder_places,
)
from handeye.tasks.stanford_cell.screws import (
    ALUMINIUM,
    CHAMFER,
    LENGTH,
    MM,
    SCREW_BORE,
    TAP,
    TAP_DEPTH,
    Place,
    add_bit,
    add_box,
    add_hung_screw,
    add_loose,
    add_motors,
    add_pin,
    add_ring,
    add_styles,
    add_thread,
)
from handeye.tasks.stanford_cell.shapes import Shaper, body_inertia, box_moments

DRIVER_MASS: Final = 0.3  # kg, taken from the palm: both hands weigh the same


def add_pump(spec: mujoco.MjSpec, pump: Pump) -> None:
    """Add the parts of a pump, their fixtures and the screwdriver to the scene of the gantries."""
    spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_DIAGEXACT)  # a thread under load needs it
    spec.option.impratio = 50
    add_styles(spec)
    shaper = Shaper(spec=spec)
    for geom in spec.geoms:
        if geom.classname.name in ("arm", "finger"):
            geom.contype = 3
    spec.geom("board").conaffinity = 9
    _add_base(shaper, pump)
    _add_plate(shaper, pump)
    _add_pins(shaper, pump)
    _add_screws(shaper, pump)
    _add_driver(shaper)


def _add_base(shaper: Shaper, pump: Pump) -> None:
    """Add the base with its holes. The base lies loose in a nest of four stops."""
    nest, (length, width, height) = pump.nest, BASE
    stops = shaper.spec.worldbody.add_body(name="nest", pos=[nest.x * MM, nest.y * MM, 0])
    for sign in (-1, 1):
        for side in (-1, 1):
            across = Place(sign * (length / 2 + PLAY + 4), side * 20)
            add_box(shaper, stops, "fixed", across, (8, 12, 12), 0, "enamel")
            along = Place(side * 50, sign * (width / 2 + PLAY + 4))
            add_box(shaper, stops, "fixed", along, (12, 8, 12), 0, "enamel")
    body = add_loose(shaper, "base", nest, 0)
    mass = ALUMINIUM * length * width * height * MM**3
    body_inertia(body, mass, (0, 0, height / 2 * MM), box_moments(mass, [each * MM for each in BASE]))
    add_box(shaper, body, "base", Place(0, 0), BASE, 0, "iron")
    add_box(shaper, body, "face", Place(0, 0), (length, width, 10), height - 10)
    for at in pump.base_pins:
        add_ring(shaper, body, "pin_hole", "bore", at, height, PIN_BORE, PIN_DEPTH)
        add_box(shaper, body, "bore", at, (12, 12, 6), height - PIN_DEPTH - 6)
    for number, at in enumerate(pump.base_taps):
        add_ring(shaper, body, "tap", "tap", at, height, TAP, TAP_DEPTH)
        add_thread(shaper, body, number, at, height)


def _add_plate(shaper: Shaper, pump: Pump) -> None:
    """Add the plate with its hub, on its stand."""
    length, width, height = PLATE
    stand = shaper.spec.worldbody.add_body(name="stand", pos=[pump.stand.x * MM, pump.stand.y * MM, 0])
    for side in (-1, 1):
        add_box(shaper, stand, "fixed", Place(side * 50, 0), (16, 60, STAND_HEIGHT), 0, "enamel")
    body = add_loose(shaper, "plate", pump.stand, STAND_HEIGHT)
    sheet = ALUMINIUM * length * width * height * MM**3
    hub = ALUMINIUM * HUB[0] * HUB[1] * HUB[2] * MM**3
    mass = sheet + hub
    middle = (sheet * height / 2 + hub * (height + HUB[2] / 2)) / mass
    body_inertia(body, mass, (0, 0, middle * MM), box_moments(mass, (length * MM, width * MM, 0.016)))
    add_box(shaper, body, "plate", Place(0, 0), PLATE, 0, "plate")
    hold = add_box(shaper, body, "plate", Place(0, 0), HUB, height, "plate")
    hold.friction[0] = 0.4
    for at in pump.plate_pins:
        add_ring(shaper, body, "plate_pin_hole", "bore", at, height, PLATE_PIN_BORE, height, below=CHAMFER)
    for number, at in enumerate(pump.plate_bores):
        add_ring(shaper, body, "plate_bore", "bore", at, height, SCREW_BORE, height, below=CHAMFER)
        add_box(shaper, body, "seat", at, (16, 16, height), 0)  # flat, unlike a ring; only heads touch it
        body.add_site(name=f"plate_bore{number}", pos=[at.x * MM, at.y * MM, height * MM], group=5)


def _add_pins(shaper: Shaper, pump: Pump) -> None:
    """Add the pins in their holder. The origin of a pin is its lower end."""
    x, y = pump.holder
    holder = shaper.spec.worldbody.add_body(name="holder")
    for number, at in enumerate(holder_places(pump)):
        add_ring(shaper, holder, "holder_hole", "bore", at, HOLDER_HEIGHT, HOLDER_BORE, PIN_DEPTH)
        body = add_loose(shaper, f"pin_{number + 1}", at, HOLDER_HEIGHT - PIN_DEPTH)
        add_pin(shaper, body)
    add_box(shaper, holder, "fixed", Place(x, y), (80, 26, HOLDER_HEIGHT - PIN_DEPTH), 0)
    add_box(shaper, holder, "look", Place(x, y), (80, 26, HOLDER_HEIGHT), 0, "enamel")


def _add_screws(shaper: Shaper, pump: Pump) -> None:
    """Add the screws in their dispenser. Also add a tray, which is out of sight. While a screw is in a thread, the
    tray holds the screw's loose body.
    """
    (x, y), top = pump.dispenser, DISPENSER_HEIGHT
    dispenser = shaper.spec.worldbody.add_body(name="dispenser")
    add_box(shaper, shaper.spec.worldbody, "fixed", Place(300, 200), (400, 200, 20), -1020)
    for number, at in enumerate(dispenser_places(pump)):
        add_hung_screw(shaper, dispenser, number, at, top)
    add_box(shaper, dispenser, "fixed", Place(x, y), (130, 26, top - LENGTH - 2), 0)
    add_box(shaper, dispenser, "look", Place(x, y), (130, 26, top), 0, "enamel")


def _add_driver(shaper: Shaper) -> None:
    """Mount the screwdriver between the fingers of arm 2, below the wrist, with its motors."""
    spec = shaper.spec
    hand = spec.body("hand_2")
    hand.mass -= DRIVER_MASS
    body = hand.add_body(name="driver", pos=[0, 0, BIT * MM], gravcomp=1)
    body_inertia(body, DRIVER_MASS - 0.03, (0, 0, 0.05), (1e-4, 1e-4, 3e-5))
    body.add_site(name="driver", group=5)
    shaper.cylinder(body, "driver", 0.0085, (0, 0, 0.025), (0, 0, 0.084), "brass").group = SEEN
    add_bit(shaper, body, 0)
    add_motors(spec)
