"""Limits of plausible sensor readings, and models of the gap between closed fingers.

The limits allow for twice the stated errors of the devices (see the variation tables of the tasks). In worlds of the
level `high`, the errors are twice as large as stated.
"""

from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import INCH, OUNCE_FORCE

FREE_OPENING: Final = 0.12 * INCH
"""Opening (m) after which a finger is clear of an object that it touched.

Each finger moves by half of the opening, 1.5 mm. Only a force of about 18 N deflects the arm by 1.5 mm.
"""
GAP_ERROR: Final = 0.1 * INCH
"""Permitted difference (m) between the gap and its goal. The finger servo stops within a few hundredths of an inch of
the goal. The value is a placeholder.
"""
GAP_NOISE: Final = 0.02 * INCH  # m; twenty times the sensor noise
SHIFT_NOISE: Final = 0.006 * INCH
"""Greatest change (m) of the gap reading between two servo periods while the fingers stand still. The value allows for
the converter, which rounds to steps of .001 in, and for five standard deviations of the noise. At the high level, the
standard deviation is .0006 in per reading.
"""
FREE_FORCE: Final = 45 * OUNCE_FORCE
"""Greatest force that the arm may sense in free air: 12.5 N. With more force, the program calls the operator. The
errors of link masses, mass centres, drive gains and joint friction look like a force on the hand, upwards or
downwards. We calculated this apparent force for 15 places on the table: it is at most 6.1 N in 400 nominal worlds, and
at most 8.9 N in worlds of the high level. At the high level, the base may also weigh 2 N more than the load that the
program declares.
"""
SWITCH_FORCE: Final = 10 * OUNCE_FORCE
"""Force (N) with which the fingers press after centring. It closes both switches.

The switches close at 2 ounces, with a stated spread of .4 ounces. In worlds of the high level, the spread is .8
ounces. A switch may thus need 2 ounces plus three spreads, so each finger must press with at least 4.4 ounces. The rest
of the force allows for two errors. First, one finger can press with 3 ounces less than the other, because the arm can
hold the difference. Second, the force depends on the gap, which is known only to one step of its converter.
"""
GAP_OFFSET: Final = (
    0.06 * INCH
)  # m by which the gap may be off; like GAP_SCALE, three times the doubled stated error
GAP_SCALE: Final = 0.03  # as a fraction of the gap
STARTING_TORQUE: Final = 0.05
"""Torque (N m) of the screwdriver's motor from its start until the spindle has reached its speed: 7 ounce-inches."""
STALLED_TORQUE: Final = 0.37
"""Greatest torque of the motor (N m): the torque of the slipping clutch, plus the torque that turns the spindle."""
STARTING_PERIODS: Final = 4
"""Number of servo periods that a motor takes to reach its driving speed. We measured 4.2 periods."""
FAST_PERIODS: Final = 6
"""A free motor of the usual speed always reaches its speed within this number of servo periods. A motor whose full
speed is 1.4 times the usual speed takes longer.
"""
WIND_UP: Final = 0.2
"""Longest time (s) for which the torque rises after the head of a screw has met the top. The value is our choice; the
measured time is .1 s.
"""
DRIVEN: Final = 0.2 * INCH
"""A screw shows its running torque after four turns, in which it advances by this distance (m)."""
PLATEAU: Final = 1.0
"""Time (s) for which a torque must last to show that the motor is held fast: the time of three turns at driving speed.
Our choice.
"""
HELD_FAST: Final = 0.3
"""If the hand does not advance, a torque above this fraction of the requested torque shows that something holds the
motor fast.

If the program requests 42 ounce-inches, this limit is .09 N m. A turning screw takes .02 N m. A bit that slips on a
head while the hand presses with 22 ounces takes at most .025 N m, even if this whole force causes friction at the edge
of the head. Even with five times the noise of the current (.04 N m), these torques stay below the limit.
"""
CURRENT_NOISE: Final = 0.008  # N m, of a reading: twice the stated noise of the current


def off_zero(force: Array) -> bool:
    """Return True if a force (N, shape (3,)) is too large for a hand in free air."""
    return bool(np.linalg.norm(force) > FREE_FORCE)


def followed(gap: float, goal: float) -> bool:
    """Return True if the gap of the fingers agrees with its goal (both in m)."""
    return abs(gap - goal) <= GAP_ERROR


def leapt(change: float, reach: float) -> bool:
    """Return True if the gap changed by more than `reach` (m). `reach` is the greatest change that the motor can make
    in the time between the two readings of the gap.
    """
    return abs(change) > reach + GAP_NOISE


def work_of_fingers(change: float, force: float) -> float:
    """Compute the work (J) that the fingers have done on the object between them. `change` is the change of the gap
    (m), and `force` is the force of the fingers (N). The work is 0 if the fingers may have stood still, or were pushed
    apart.
    """
    return -change * force if change < -SHIFT_NOISE else 0.0


def thick(gap: float, thickness: float) -> bool:
    """Return True if `gap` (m) is possible for fingers that hold an object of known thickness (m). The object may
    be gripped fully or lightly, straight or askew.
    """
    return abs(gap - thickness) <= GAP_OFFSET + GAP_SCALE * thickness + SKEW


def kept_apart(gap: float, goal: float) -> bool:
    """Return True if an object keeps the fingers apart while the motor drives them together. `gap` is the gap of the
    fingers, and `goal` the gap to which the motor drives them (both in m). A grip that is too light to close a switch
    counts too.
    """
    return gap > EMPTY_GAP and gap - goal > GAP_ERROR


def stood_still(change: float, driven: float) -> bool:
    """Return True if the fingers stood still although their motor was driven. `change` is the measured change of the
    gap, and `driven` the change that the motor should have made (both in m). The result is True if `driven` is greater
    than GAP_ERROR and `change` is smaller than GAP_NOISE.
    """
    return driven > GAP_ERROR and abs(change) < GAP_NOISE


EMPTY_GAP: Final = 0.05 * INCH
"""Greatest reading (m) of the gap when the fingers are closed and empty. The potentiometer is off by up to .02 in; in
worlds of the high level, by up to .04 in.
"""
SAME_HOLD: Final = 5e-4  # m; greatest change of the gap in an unchanged hold
SKEW: Final = 1e-3
"""Permitted change (m) of the gap on an object that has turned between the fingers. If the contact is an inch long, a
turn of 2 degrees changes the gap by .9 mm.

CENTER holds an object only lightly. An object that is grasped again lies straighter than before, and an object that
was pushed against blocks lies more askew. We measured how this changes the gap. On pins, the gap closed by .5 mm. On
the base of the pump, in the worlds of seeds 1 to 6, the gap closed by up to .8 mm or widened by up to .44 mm. In the
world of seed 1001, it widened by more than .5 mm.
"""
OFF_MIDDLE: Final = 3e-3
"""Permitted distance (m), along the line of the fingers, between an object and the middle of the fingers. The limit
applies when the fingers close on an object that they have held before.

An object that was carried and set down may have slid between the fingers by SKEW, and turned by 2 degrees. The fingers
may then grasp the object 57 mm from their earlier hold, as on the walls of the pump base. At this distance, the turn
displaces the object by 2 mm. In eight pumps, the measured displacement was at most 1.8 mm on these walls, and 1.0 mm
elsewhere (from play in a hole or rack, and compliance of the arm while it held the object).
"""


def least_gap(minimum: float) -> float:
    """Return the least gap (m) at which the fingers are sure to hold an object at least as thick as `minimum` (m). If
    `minimum` is 0, any object counts.
    """
    return minimum or EMPTY_GAP


def at_least(gap: float, thickness: float) -> bool:
    """Return True if the fingers hold an object that is at least as thick as `thickness` (m)."""
    return gap >= thickness


def at_most(gap: float, thickness: float) -> bool:
    """Return True if the fingers hold no object that is thicker than `thickness` (m)."""
    return gap <= thickness


def as_before(gap: float, kept: float, closer: float = SKEW, wider: float = SAME_HOLD) -> bool:
    """Return True if the gap (m) agrees with the gap `kept` of an earlier hold (m). The gap may be smaller than `kept`
    by up to `closer` (m), and greater than `kept` by up to `wider` (m).
    """
    return -closer <= gap - kept <= wider


def too_early(gap: float, kept: float) -> bool:
    """Return True if a finger touches an object too early during closing, so that the object does not lie in the
    middle of the hand. `gap` is the gap at the touch, and `kept` the much smaller gap at which the hand held the
    object before (both in m).
    """
    return gap - kept > 2 * OFF_MIDDLE
