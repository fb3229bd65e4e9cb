# ---
# jupyter:
#   jupytext:
#     formats: ipynb,py:percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # 7. A reflex
#
# At the end you will know why a robot of 1981 had one wire that bypassed its central computer, and what this wire
# saves in a collision.
#
# SUPERSIGMA, built in Milan, has two arms over one board. A central computer runs your program in
# [MAL](../docs/mal.md). Each motor has a microcomputer of its own, and a bus carries commands to these microcomputers.
# A wire leads from the force sensor in each wrist directly to the microcomputers of the same arm. With this wire, a
# motor stops by itself when the hand meets something: a reflex.
#
# You can read this notebook without running it. Running it takes a few seconds.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## A collision
#
# Arm 2 stands in the way of arm 1. Both hands are at the same height, and X2 counts from the other end of the rail.
# The hands touch when X1 is 160 mm, but the program sends arm 1 to 200 mm, at 50 mm/s.

# %%
collide = """
10 ORIGIN X1, X2
20 MOVE X2 TO 400
30 MOVE X1 TO 200 SLOW 50
40 PRINT "ARRIVED AT", POS(X1)
"""
reflex = handeye.Mal(collide, arm="gantries")
reflex.run()
reflex.stopped

# %%
picture = reflex.photograph(width=480, height=360)
figure, axis = plt.subplots(figsize=(6, 4.5), dpi=80, layout="constrained")
axis.imshow(picture)
axis.set_axis_off()

# %% [markdown]
# Now the same program runs with the wires cut. Nothing stops the arm, and the program prints that it has arrived.

# %%
cut = handeye.Mal(collide, arm="gantries", faults=["no-reflex"])
cut.run()

# %% [markdown]
# ## What was felt
#
# The left picture shows the force on the wrist of arm 1 along X. With the reflex, the motor stops within a
# millimetre, at a force of 12 N. Without it, the motor pushes arm 2 with all the force that it has.
#
# The right picture shows the true place of X1. The motors have no position sensors. Without the reflex, the program
# believes that X1 is at 200 mm (dashed), because it counts the steps that it has sent. The rotor has not followed
# these steps.

# %%
figure, (force, place) = plt.subplots(1, 2, figsize=(9, 3), dpi=80, layout="constrained")
force.plot(cut.history["time"], abs(cut.history["force"][:, 0]), label="without reflex")
force.plot(reflex.history["time"], abs(reflex.history["force"][:, 0]), label="with reflex")
force.set(xlabel="time, s", ylabel="force on wrist 1, N")
force.legend()
place.plot(cut.history["time"], cut.history["place"][:, 0])
place.plot(reflex.history["time"], reflex.history["place"][:, 0])
place.axhline(cut.believed["X1"], linestyle="--", color="grey")
place.set(xlabel="time, s", ylabel="true place of X1, mm")
cut.believed["X1"], round(float(cut.history["place"][-1, 0]), 2)

# %% [markdown]
# ## What the reflex does not save
#
# At full speed, a motor has little force to spare. The reflex still stops the arm, but both arms have lost steps by
# then. Arm 2 was standing still, so its motor noticed nothing, and the status of X2 says that all is well. The
# interpreter of MAL therefore asks both wrists for the greatest force that they have felt, and marks as doubtful the
# count of each axis that may have slipped.

# %%
fast = handeye.Mal(collide.replace(" SLOW 50", ""), arm="gantries")
fast.run()
fast.stopped

# %%
fast.status("X2"), fast.doubtful, fast.believed["X2"], round(float(fast.history["place"][-1, 3]), 2)

# %% [markdown]
# `ORIGIN` ends the doubt: it moves an axis to the switch at the end of its rail, and counts from there. `ORIGIN`
# also finds lost steps that nothing else reveals. In the next program, the hand of arm 1 is lower, so the column of
# arm 1 hits the hand of arm 2. The column has no force sensor, so no reflex stops arm 1. The program does not notice
# the collision until `ORIGIN` checks the counts.

# %%
column = handeye.Mal(
    """
10 ORIGIN X1, X2, Z1
20 MOVE X2 TO 400, Z1 TO 100
30 MOVE X1 TO 200 SLOW 50
40 PRINT "ARRIVED AT", POS(X1)
50 ORIGIN X1, X2
""",
    arm="gantries",
)
column.run(), column.stopped

# %% [markdown]
# [The safety study](../docs/safety_study.md) has fourteen collisions in a table. In two of them, the central
# computer hangs in an endless loop. Even then, the wired reflex stops the arm.
