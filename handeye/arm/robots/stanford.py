"""The Stanford arm (V. Scheinman, 1969) on its table, as data.

DH rows, masses, mass centres, inertia tensors and drive inertias are from the Robotics Toolbox model after Paul
(1981). Speeds, the range of joint 5 and the opening of the hand are from the data sheet of 1974. Figures without a
source are marked "chosen" or "placeholder".
"""

from math import pi
from typing import Final, Literal

from handeye.arm.model import ArmModel, ComplianceModel, GraspModel, HandModel, Joint, ServoModel
from handeye.core.pose import pose, rotation_z
from handeye.core.units import DEGREE, GAP, INCH, JIFFY

# Wrist centre to finger tips. Chosen: the published model ends at the wrist centre.
HAND_LENGTH: Final = 10 * INCH

Triple = tuple[float, float, float]


def _moments_about_centre(about_origin: Triple, mass: float, centre: Triple) -> Triple:
    """Compute, by Steiner's theorem, the moments of inertia about the mass centre from the published tensors,
    which are about the *origin* of the link.

    The tensors are published without products of inertia. The products of inertia about the mass centre are therefore
    set to zero. The largest neglected product, of link 1, would be .018 kg m2.
    """
    x, y, z = centre
    a, b, c = about_origin
    return (a - mass * (y * y + z * z), b - mass * (x * x + z * z), c - mass * (x * x + y * y))


def _joint(
    name: str,
    kind: Literal["revolute", "prismatic"],
    *,
    d: float,
    alpha: float,
    limits: tuple[float, float],
    drive: tuple[float, float, float],
    mass: float,
    centre: Triple,
    tensor: Triple,
    armature: float,
    damping: float,
    brake: float,
    wrist: float = 0.0,
) -> Joint:
    """Make a joint from published values. `wrist` is the z coordinate (m), in our frame, of the origin of the
    published frame.
    """
    speed, acceleration, effort = drive
    x, y, z = centre
    return Joint(
        name=name, kind=kind, d=d, alpha=alpha, lower=limits[0], upper=limits[1],
        speed=speed, acceleration=acceleration, effort=effort,
        mass=mass, centre=(x, y, z + wrist), inertia=_moments_about_centre(tensor, mass, centre),
        armature=armature, damping=damping, brake=brake,
    )  # fmt: skip


# Mass centres: those of links 2 to 6 are published ten times too large (m r2 would exceed the tensor).
# Divided by ten, the tensors of links 1 to 4 and 6 leave possible moments at the centre: positive, and none
# greater than the sum of the others. Link 5 needs more: at (0, .0566, .0003) its centre would lie off to
# the side, along the axis of joint 5, and .63 kg x (.0566 m)2 = .0020 would exceed its moment about z,
# .0004 kg m2. The tensor is that of a body slender along z, the approach direction, so y and z are taken as
# exchanged. Link 6 is published in a frame with its origin at the wrist centre; ours is a hand length
# further out.
#
# drive = (speed, acceleration, effort). Accelerations: chosen, no source; they make a careful arm (J1 needs
# 10-19 N m for its 3 rad/s2 with 2 kg and the boom .6-1 m out). Efforts: placeholder, enough to hold the
# arm's own weight and the data sheet's greatest load (4.5 kg within .5 m) at these accelerations, not much
# more. Damping: placeholder. Brakes: placeholder, over twice what the drives can do.
_JOINTS: Final = (
    _joint(
        "column", "revolute", d=0.412, alpha=-pi / 2, limits=(-170 * DEGREE, 170 * DEGREE),
        drive=(3.0, 3.0, 50.0), mass=9.29, centre=(0.0, 0.0175, -0.1105), tensor=(0.276, 0.255, 0.071),
        armature=0.953, damping=2.0, brake=200.0,
    ),
    _joint(
        "shoulder", "revolute", d=0.154, alpha=pi / 2, limits=(-170 * DEGREE, 170 * DEGREE),
        drive=(1.5, 2.5, 70.0), mass=5.01, centre=(0.0, -0.1054, 0.0), tensor=(0.108, 0.018, 0.100),
        armature=2.193, damping=2.0, brake=200.0,
    ),
    # a3 = 0 and theta3 = 0 as in Paul (1981); the toolbox has .0203 m and -90 degrees.
    _joint(
        "boom", "prismatic", d=0.0, alpha=0.0, limits=(12 * INCH, 50 * INCH),
        drive=(1.0, 60 * INCH, 200.0), mass=4.25, centre=(0.0, 0.0, -0.6447), tensor=(2.51, 2.51, 0.006),
        armature=0.782, damping=5.0, brake=600.0,
    ),
    _joint(
        "wrist roll", "revolute", d=0.0, alpha=-pi / 2, limits=(-170 * DEGREE, 170 * DEGREE),
        drive=(6.0, 12.0, 15.0), mass=1.08, centre=(0.0, 0.0092, -0.0054), tensor=(0.002, 0.001, 0.001),
        armature=0.106, damping=0.3, brake=30.0,
    ),
    # The data sheet gives a range of 220 degrees. The toolbox has +-90 degrees, with which the hand could point
    # down only while the boom slopes down.
    _joint(
        "wrist bend", "revolute", d=0.0, alpha=pi / 2, limits=(-110 * DEGREE, 110 * DEGREE),
        drive=(6.0, 12.0, 15.0), mass=0.63, centre=(0.0, 0.0003, 0.0566), tensor=(0.003, 0.003, 0.0004),
        armature=0.097, damping=0.3, brake=30.0,
    ),
    _joint(
        "hand roll", "revolute", d=HAND_LENGTH, alpha=0.0, limits=(-170 * DEGREE, 170 * DEGREE),
        drive=(6.0, 12.0, 10.0), mass=0.51, centre=(0.0, 0.0, 0.1554), tensor=(0.013, 0.013, 0.0003),
        armature=0.020, damping=0.1, brake=20.0, wrist=-HAND_LENGTH,
    ),
)  # fmt: skip

# Sizes of the hand: as drawn. Mass of each finger (.12 kg), and mass centre of the fingers (they reach from .175 to
# .254 m): placeholders. Opening, and its rate of 8 cm/s without load (3 cm/s loaded): data sheet of 1974. Grip: the
# strongest that the assembly study measured. Grasp: chosen.
_HAND: Final = HandModel(
    length=HAND_LENGTH, mass=0.24, centre=0.20, gap_max=GAP, gap_speed=0.08, grip=80.0,
    finger_width=0.01905, finger_thickness=0.01016, finger_length=0.0782,
    palm=(-0.0381, -0.0635, -0.1055, 0.0381, 0.0635, -0.0815),
    wrist=(-0.039, -0.050, -0.2540, 0.039, 0.050, -0.1055), lamp=(-0.045, 0.062, -0.088),
    grasp=GraspModel(speed=0.05, centring=0.5 * INCH, settle=20),
)  # fmt: skip

# Frequencies: with torques held for 1/60 s, the servo becomes unstable between 50 and 60 rad/s (measured); at 20 to
# 30 rad/s the arm follows to a fraction of a millimetre. The wrist has little inertia and would bend under a push of
# a few pounds, so its frequencies are higher. Lag: placeholder, twenty times the lag in free motions. Short:
# placeholder, five times the .032 in that whole runs show; the servo is soft. Drag: chosen, because the joints have
# too little friction to stop the floating arm.
_SERVO: Final = ServoModel(
    period=JIFFY, frequency=(25.0, 25.0, 25.0, 40.0, 40.0, 40.0), lag=(0.05, 0.05, 0.03, 0.15, 0.15, 0.15),
    short=0.004, settle=8, drag=0.1,
)  # fmt: skip

# Chosen. Gain: slow enough for the arm's 20 kg of felt inertia. Gain of turning: slow, because the servo holds the
# wrist with a stiffness of some 160 N m/rad. Limit of turning: a wrench that turns the hand farther means that the
# hand was hit. Friction: the data sheet has none. It is inferred from the paper, according to which an arm that is
# let go stays where it is. Friction must therefore carry half a torque step in each wrist joint; in joints 2 and 3,
# it must also carry what is left of gravity after the arm has weighed itself. Friction of joint 1: placeholder,
# .8 per cent of the greatest torque of its drive.
_COMPLIANCE: Final = ComplianceModel(
    gain=0.0015, speed=0.0127, turn_gain=0.1, turn_speed=0.1, turn_limit=15 * DEGREE, ramp=6,
    friction=(0.4, 0.8, 2.0, 0.1, 0.1, 0.05),
)  # fmt: skip

STANFORD: Final = ArmModel(
    name="Stanford",
    structure="spherical wrist",
    joints=_JOINTS,
    # The base at (20, 10) in is the period's; the 6 in riser and the turn are chosen, so that the hand
    # reaches all stations pointing down and the dead sector of joint 1 faces the near edge of the table.
    X_WB=pose(rotation_z(pi / 2), (20 * INCH, 10 * INCH, 6 * INCH)),
    hand=_HAND,
    servo=_SERVO,
    compliance=_COMPLIANCE,
)  # the arm of the pump assembly
