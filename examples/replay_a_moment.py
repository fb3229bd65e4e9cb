"""Show one moment of a recorded run: what the arm was doing, and a photograph of the cell (moment.png).

    python replay_a_moment.py [RUN SECONDS]

RUN is the folder of a run, and SECONDS a time in it, as `handeye trace show` prints it. Without arguments, the program
makes a short run, in which the hand feels for the table, and shows its end. It does not simulate the run again. The
photograph needs OpenGL.
"""

import sys
import tempfile
from pathlib import Path

import cv2

import handeye

SCRIPT = Path(__file__).with_name("feel_for_the_table.al")

with tempfile.TemporaryDirectory() as folder:
    run = sys.argv[1] if sys.argv[1:] else f"{folder}/run"
    if not sys.argv[1:]:
        handeye.assemble(script=SCRIPT, camera="ray", out=run)
    trace = handeye.open(run)

moment = float(sys.argv[2]) if sys.argv[2:] else trace.times[-1]
state = trace.at(moment)
print(f"{state.time:.2f} s, stage {state.stage}")
if state.step is not None:
    print(f"line {state.step.place}: {state.step.text}")
print("joints:", ", ".join(f"{position:.3f}" for position in state.joints))
x, y, z = state.poses["stanford/link6"][:3]
print(f"last link at ({x:.3f}, {y:.3f}, {z:.3f}) m, fingers {1000 * state.gap:.1f} mm open")

try:
    picture = trace.frame(moment, "studio", width=960, height=720)
except handeye.InvalidInput as error:  # no OpenGL here
    print(f"no photograph: {error}")
else:
    cv2.imwrite("moment.png", picture[:, :, ::-1])
    print("moment.png")
