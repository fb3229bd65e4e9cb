"""A script that looks for the base of the pump with the fake camera, which shows drawn pictures."""

import numpy as np
from fake_runs import FakeRun, fake_run
from synthetic import Canvas, draw_base, part, view

from handeye.core.units import DEGREE, INCH
from handeye.ports.camera import Picture
from handeye.program.program import Position

PART = part()
POSE = (43.0 * INCH, 26.0 * INCH, 70 * DEGREE)
"""x, y and yaw of the base, an inch or two and 20 degrees from where the program expects it."""
SCRIPT = "LENS 25\nAIM PUMP\nLOOK WIDE\nGENERAL PUMP WIDE\nLENS 50\nAIM PUMP\nLOOK NEAR\nSPECIFIC PUMP NEAR"


def aimed(lens: float, x: float, y: float) -> Picture:
    """The picture that the camera takes of the base if it is aimed at a part that the program expects at (`x`, `y`)
    (m).
    """
    holes = np.array([PART.holes[1].x / 2, 0.0])
    turn = np.array([[np.cos(PART.at[3]), -np.sin(PART.at[3])], [np.sin(PART.at[3]), np.cos(PART.at[3])]])
    middle = turn @ holes + (x, y)
    where, canvas = view(lens, (*middle, PART.at[2] + PART.face)), Canvas()
    draw_base(canvas, where, PART, POSE)
    return canvas.picture()


WALL = Position(at=(0.0, 1.53 * INCH, 2.75 * INCH, 90 * DEGREE, 90 * DEGREE, 0.0), of="PUMP")
"""The place at which the hand grasps the wall beside the large hole, with the finger line across the wall."""
GRASP = "OPEN 1.8\nMOVE WALL\nCLOSE .5"


def looked(then: str = "WHERE", end: str = "WHERE") -> FakeRun:
    """A run in which the base is found in a wide picture, the camera is aimed again, and the holes are found in a
    close picture.
    """
    script = f"{SCRIPT}\nJUMP END\n{then}\nEND: {end}"
    run = fake_run(script, parts={"PUMP": PART}, positions={"WALL": WALL})
    run.cell.camera.pictures = [aimed(0.025, *PART.at[:2])]
    while "LENS 50" not in run.steps:
        run.executor.step()
    believed = run.executor.run.world.part("PUMP")
    run.cell.camera.pictures = [aimed(0.050, *believed[:2, 3])]
    return run.go()
