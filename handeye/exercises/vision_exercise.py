"""The exercise on vision, in the cell of the water pump."""

from typing import Final

from handeye.exercises.arm_exercise import ArmExercise
from handeye.exercises.arm_trial import ArmWorlds

SEE: Final = ArmExercise(
    name="see",
    session=3,
    title="find the base with the camera",
    brief="The base of the pump lies somewhere on the belt, turned by up to 30 degrees. Find it with the camera, "
    "and stop with the hand over the web of the base. The finger line must be along the line between the two large "
    "holes of the base. In some worlds there is no base, or the base lies the wrong way round. In these worlds, the "
    "program must call the operator.",
    task="water_pump",
    taught="exercises/see.toml",
    start="see.al",
    referee="over_web",
    worlds=(
        ArmWorlds(seeds=range(10), told="worlds in which the base lies as it should"),
        ArmWorlds(seeds=range(10, 15), told="worlds without a base", faults=("base.missing",), calls=True),
        ArmWorlds(
            seeds=range(15, 20),
            told="worlds in which the base lies the wrong way round",
            faults=("base.reversed",),
            calls=True,
        ),
    ),
    hints=(
        (
            "reported success",
            "Which picture shows the direction of the base? GENERAL finds only the outline of the base; SPECIFIC "
            "finds its holes. On which path does the program rely on the plan instead of a picture?",
        ),
        (
            "called the operator",
            "In this world, the base lies as it should. Before each LOOK, choose the lens, aim the camera, and "
            "keep the arm out of the picture.",
        ),
    ),
)
