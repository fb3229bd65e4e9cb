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
# # 1. The first pump
#
# At the end you will know what a *script*, a *plan*, a *world* and a *run* are, what happens in each of the twelve
# stages of the assembly, how long each stage takes, and how the total compares with the five and a half minutes of
# 1973.
#
# You can read this notebook without running it. Running it takes a minute of processor time, nearly all of it for one
# assembly. The photographs need OpenGL.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## A script becomes a plan
#
# The script is a text in the arm language of 1973. *Planning* compiles the script and computes every motion in
# advance. Planning uses no arm, no clock and no random numbers, so the plan is the same each time. In a notebook, a
# plan shows its stages, and for each stage how long the arm's motions take if no step is repeated.

# %%
plan = handeye.plan(handeye.scripts / "water_pump.al")
plan

# %% [markdown]
# A step is a line of the script. The `conditions` of the steps distinguish this program from a recording of motions:
# most motions that touch something end when the hand *feels* something, not at a given place.

# %%
for_pins = [step for step in plan.stages[3].steps if step.conditions]
[(step.line, step.text, step.conditions[0]) for step in for_pins][:6]

# %% [markdown]
# ## A plan meets a world
#
# A world is a cell with its errors: where the base really lies on the belt, how wrong the sensor of each joint
# reads, how far each hole is from its place in the drawing. A seed determines all errors. The program does not know
# these errors; it must measure what it needs with its sensors.

# %%
world = handeye.World(0)
print(len(world.values), "quantities, among them")
print("\n".join(f"{name:24} {world[name]:7.3f} {world.unit(name)}" for name in [*world.values][:8]))

# %% [markdown]
# The next cell runs the whole assembly. `out` saves the run in a folder: events, every servo period, the pictures,
# the result.

# %%
run = handeye.assemble(world=world, out="pump", overwrite=True)
run

# %% [markdown]
# The first line is the verdict of the *referee*, which measures the finished pump in the simulator, where the
# program cannot look. The referee's findings are at the end, each with its limit.
#
# The table in the middle compares the times with those printed in 1973. *Manipulation* is the motion of the arm.
# During the rest of the working phase, the arm waits for the television camera, whose lens turret, pan, tilt and
# focus have slow motors. As the paper of 1973 suggests, our program lets these motors work while the arm moves,
# where possible. So the arm waits less for the camera than in 1973. Manipulation, however, takes minutes longer than
# in 1973, because the simulated arm is slower than that of 1973, and our program measures more by touch. The whole
# run therefore also takes minutes longer. The last stage, which inspects the pump, was not in the program of 1973.
#
# ## Look at it
#
# The trace holds the places of all bodies, sixty times a second. So you can photograph any moment of the run later,
# from any camera of the cell, without simulating again.

# %%
trace = run.trace
[(stage.name, f"{stage.begin:.0f} s") for stage in trace.stages]

# %%
moments = {
    "a pin goes into its hole": trace.stages[3].end - 14,
    "the gasket goes over the pins": trace.stages[4].end - 11.5,
    "the top goes over both": trace.stages[6].end - 14,
    "a screw is driven": trace.stages[9].end - 8.5,
}
figure, axes = plt.subplots(2, 2, figsize=(7.6, 5.9), dpi=80, layout="constrained")
named = [axis.set_title(name, fontsize=9) for axis, name in zip(axes.flat, moments, strict=True)]
frames = [trace.frame(moment, "work", width=400, height=300, exposures=4) for moment in moments.values()]
shown = [axis.imshow(frame) for axis, frame in zip(axes.flat, frames, strict=True)]
hidden = [axis.axis("off") for axis in axes.flat]

# %% [markdown]
# In a notebook of your own, a cell that contains only `trace` shows the report of the run: a 3D replay next to the
# script. The report is a megabyte, so this notebook leaves it out.
#
# The hand has no force sensor. During guarded and compliant motions, the program computes the force from the torques
# of the motors. In the next plot, each spike is a contact.

# %%
felt = trace.forces()
figure, axis = plt.subplots(figsize=(7.6, 2.6), layout="constrained")
axis.plot(felt.times / 60, -felt.force[:, 2], linewidth=0.6)
axis.set(
    xlabel="minutes", ylabel="N, downwards", title="force of the hand on what it touches", ylim=(-10, 30)
)
lines = [axis.axvline(stage.begin / 60, color="0.85", zorder=0) for stage in trace.stages]

# %% [markdown]
# The trace also describes events in words. `trace.table("events")` lists all events. A slice of this table shows
# part of it. A column is an array or a list, and `to_pandas()` makes a DataFrame if pandas is installed.

# %%
events = trace.table("events")
begin = events["stage"].index("insert the aligning pins")
events[begin + 20 : begin + 36]

# %% [markdown]
# ## Repeating the run
#
# The same world, plan and version of handeye give the same run, to the last bit of its trace. Another seed gives
# another run: `handeye.assemble(1)`. `handeye.compare("pump", "other")` reports the first difference between two
# runs, and the event at which they diverge.
#
# In the next notebook, [2. The language by doing](2_the_language_by_doing.ipynb), you write programs.
