"""The exercises on the insertion bench."""

from typing import Final

from handeye.core.units import MILLIMETRE
from handeye.exercises.arm_exercise import ArmExercise
from handeye.exercises.arm_trial import ArmWorlds
from handeye.trials.insertion import TASK

MOST_FORCE: Final = 30.0
"""Greatest permitted force (N). In 2000 trials, the bench's own search reached 20 N; the search of 1973 reached about
100 N (docs/insertion.md).
"""
BESIDE: Final = 20 * MILLIMETRE  # so far beside its taught place, the hole is out of reach of any search here
_USUAL: Final = "worlds in which the hole is off its taught place by about 1 mm along each axis"
_BESIDE: Final = "worlds in which the hole is 20 mm off its taught place"

_TAUGHT: Final = "insertion.toml"  # the positions of all these exercises

TOUCH: Final = ArmExercise(
    name="touch",
    session=1,
    title="stand the pin on the plate, gently",
    brief="The hand holds the pin about .13 in over the face of the plate; the exact distance differs from world to "
    "world. Move the pin down until it stands on the face, and stop there. A motion by a fixed distance stops above "
    "the face in some worlds, and presses on the face in others.",
    task=TASK,
    taught=_TAUGHT,
    start="touch.al",
    worlds=(ArmWorlds(seeds=range(20), told=_BESIDE, set={"plate.x": BESIDE, "plate.y": 0.0}),),
    most_force=MOST_FORCE,
    referee="on_face",
    hints=(
        (
            "reported success",
            "Move farther than planned, and let STOP end the motion where the pin meets the plate.",
        ),
        (
            "pressed too hard",
            "Let STOP end the motion, and move more slowly: the force of an impact grows with the speed.",
        ),
        ("called the operator", "A motion with a STOP must be long enough to meet the plate in every world."),
    ),
)
FIND: Final = ArmExercise(
    name="find",
    session=2,
    title="find the hole by force",
    brief="The hole is not exactly where it was taught. Search for it: lift the pin, move it to the next place, and "
    "try again, until the pin goes in.",
    task=TASK,
    taught=_TAUGHT,
    start="find.al",
    worlds=(ArmWorlds(seeds=range(20), told=_USUAL),),
    hints=(
        (
            "called the operator",
            "Error 23 does not occur if the pin stands on the face. Begin a SEARCH where your program finds that "
            "error 23 has not occurred.",
        ),
        (
            "reported success",
            "Use HEIGHT to compare the height of the hand with the height at which the motion began.",
        ),
    ),
)
GENTLY: Final = ArmExercise(
    name="gently",
    session=2,
    title="find the hole without hitting the plate hard",
    brief="The program of 1973 strikes the plate at 1 in/s. The force of an impact grows with the speed. Change the "
    "program so that the pin still finds its hole, and the force between pin and plate stays small.",
    task=TASK,
    taught=_TAUGHT,
    start="gently.al",
    worlds=(ArmWorlds(seeds=range(20), told=_USUAL),),
    most_force=MOST_FORCE,
    hints=(
        (
            "pressed too hard",
            (
                "Give a speed to each CHANGE in which the pin may meet metal, and let STOP end the motion at a smaller "
                "force."
            ),
        ),
        (
            "reported success",
            (
                "The pin stands on something other than its shoulder. Use HEIGHT to check how high the pin stands."
            ),
        ),
        (
            "called the operator",
            "Use FREE, so that the chamfer can guide the pin. Without FREE, a pin that moves slowly may stay on "
            "the chamfer.",
        ),
    ),
)
HONEST: Final = ArmExercise(
    name="honest",
    session=4,
    title="report success only if the pin is in its hole",
    brief="In half of the worlds, the hole is too far away to be found. In these worlds, the program must call the "
    "operator: a program that ends as if all were well is worse than one that stops. In the other worlds, the pin "
    "must go in.",
    task=TASK,
    taught=_TAUGHT,
    start="honest.al",
    worlds=(
        ArmWorlds(seeds=range(10), told=_USUAL),
        ArmWorlds(seeds=range(10, 20), told=_BESIDE, set={"plate.x": BESIDE, "plate.y": 0.0}, calls=True),
    ),
    hints=(
        (
            "reported success",
            "Follow each path to the end of the program. On which path does the program not measure whether the "
            "pin is in its hole?",
        ),
        (
            "called the operator",
            "In this world, the hole was within reach. Search more places before you give up.",
        ),
    ),
)
