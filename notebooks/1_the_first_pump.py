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
# stages of the pump, where its minutes go, and how far that is from the five and a half of 1973.
#
# Nothing here needs to be run to be read. Run, it takes a minute of a processor, nearly all of it for one assembly;
# the photographs take OpenGL.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## A script becomes a plan
#
# The script is a text in the arm language of 1973. *Planning* compiles it and works out every motion that can be
# known beforehand: no arm, no clock and no random number has a part in it, so the plan is the same each time. Shown
# by itself it tells its stages, and how long the arm moves in each if nothing has to be done twice.

# %%
plan = handeye.plan(handeye.scripts / "water_pump.al")
plan

# %% [markdown]
# A step is a line of the script. What makes this program different from a recording is in the `conditions` of its
# steps: most of the motions that touch something end when they *feel* something, and not at a place.

# %%
for_pins = [step for step in plan.stages[3].steps if step.conditions]
[(step.line, step.text, step.conditions[0]) for step in for_pins][:6]

# %% [markdown]
# ## A plan meets a world
#
# A world is a cell with all its errors: where the base lies on the belt, by how much each joint reads wrong, how far
# the holes were drilled beside their places. A seed draws it. The program is told nothing of these figures; it has to
# find out with its senses what of them matters.

# %%
world = handeye.World(0)
print(len(world.values), "quantities, among them")
print("\n".join(f"{name:24} {world[name]:7.3f} {world.unit(name)}" for name in [*world.values][:8]))

# %% [markdown]
# Now the whole assembly. `out` keeps the run in a folder: what happened, every servo period of it, the pictures, the
# result.

# %%
run = handeye.assemble(world=world, out="pump", overwrite=True)
run

# %% [markdown]
# The first line is the verdict of the *referee*, who measures the finished pump in the simulator, where the program
# cannot look. His findings stand at the end, each with its limit.
#
# Between them is the timing table, beside the one that was printed in 1973. *Manipulation* is what the arm does; the
# rest of the working phase it waits for the television camera, whose lens turret, pan, tilt and focus are slow
# motors. The program of today lets the mechanism work while the arm moves, where it can; the paper of 1973 says that
# this could be done. So the camera now costs less than it did then. The nearly three minutes that are lost are all in
# manipulation: the arm is slower than that of 1973, and the program feels more. The last stage, in which it inspects
# the pump, is one that the program of 1973 does not have, and takes the arm 48 s.
#
# ## Look at it
#
# The trace holds where everything was, sixty times a second. So any moment can be photographed afterwards, from any
# of the cell's cameras; nothing is simulated again.

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
# In a notebook of your own write `trace` alone into a cell: it shows the report of the run in a frame of its own,
# where you walk round the arm while the script goes by. It weighs a megabyte, so that it is not kept in this file.
#
# The hand has no sensor of force. The program works the force out from the torques of the motors, while it is in a
# motion that is to feel something. Each spike is something that was met.

# %%
felt = trace.forces()
figure, axis = plt.subplots(figsize=(7.6, 2.6), layout="constrained")
axis.plot(felt.times / 60, -felt.force[:, 2], linewidth=0.6)
axis.set(
    xlabel="minutes", ylabel="N, downwards", title="force of the hand on what it touches", ylim=(-10, 30)
)
lines = [axis.axvline(stage.begin / 60, color="0.85", zorder=0) for stage in trace.stages]

# %% [markdown]
# What was felt is told in words, too. `trace.table()` is everything that happened; a slice shows part of it, a column
# is an array, and `to_pandas()` makes a DataFrame of it where pandas is installed.

# %%
events = trace.table("events")
begin = events["stage"].index("insert the aligning pins")
events[begin + 20 : begin + 36]

# %% [markdown]
# ## And again?
#
# The same world, the same plan and the same version of handeye give the same run, to the last bit of its trace.
# Another seed gives another: `handeye.assemble(1)`. What was different then, and where it began to be,
# `handeye.compare("pump", "other")` tells.
#
# The next notebook, [2. The language by doing](2_the_language_by_doing.ipynb), writes programs.
