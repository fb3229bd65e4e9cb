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
# # 4. Force and search
#
# At the end you will know how a hand without a force sensor feels, how a pin finds a hole that it cannot see, and
# one rule that connects clearance, chamfer and the step of a search: each step must be smaller than the catch of the
# hole times the square root of two.
#
# You can read this notebook without running it. Running it takes half a minute.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## A pin goes back into its holder
#
# The hand takes an aligning pin out of its holder, lifts it, and puts it down again: over the hole, or beside it.
# `STOP [0 0 -50]` ends the motion below it when the hand presses down with 50 ounces. If nothing stops it, it raises
# error 23, and here that means *success*: the pin is in the hole.
#
# The arm of this world makes no errors, so that only geometry counts. The place over the hole is filled in later.

# %%
script = """\
        OPEN    1
        MOVE    PIN
        CLOSE   .1
        CHANGE  [0 0 1] 1.5     ;out of the holder
        MOVE    OVER
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6     ;and down again
        SKIPE   23
        WAIT    "IT STANDS ON THE HOLDER"
"""
taught = """\
[positions]
PIN = {{ at = [15, 35, 3, 90, 90, 0] }}
OVER = {{ at = [{x}, {y}, 4.2, 90, 90, 0] }}
"""
world = handeye.World(0, without=["arm"])
beside = handeye.begin(script, world=world, taught=taught.format(x=15.12, y=35), out="beside", overwrite=True)
inside = handeye.begin(script, world=world, taught=taught.format(x=15.03, y=35), out="inside", overwrite=True)
print(beside.until().why, inside.until().why, sep="\n")

# %% [markdown]
# ## What the hand felt
#
# There is no force sensor in the wrist. Sixty times a second the program compares the torques of the motors with
# those that the motion itself needs; the difference comes from outside. Beside the hole it grows as soon as the pin
# meets the holder, and trips the guard; in the hole nothing comes near the limit.

# %%
beside.close(), inside.close()
felt = {"beside the hole": beside.trace.forces(line=7), "into the hole": inside.trace.forces(line=7)}
figure, axis = plt.subplots(figsize=(6.4, 2.6), dpi=80, layout="constrained")
lines = [axis.plot(each.times - each.times[0], each.value, label=name) for name, each in felt.items()]
axis.axhline(felt["beside the hole"].limit[-1], color="tab:red", linestyle="--", label="50 ounces")
axis.set(xlabel="s", ylabel="N, downwards")
axis.legend(fontsize=8)
print(f"{felt['beside the hole'].value[-1] / 0.278:.1f} ounces when it stopped")

# %% [markdown]
# The motion stops at more than 50 ounces: the program measures once in each servo period, and in that time a stiff
# arm on a stiff holder adds ten more.
#
# ## What a hole catches
#
# How far off may the pin come down and still slide in? The hole is larger than the pin by its *clearance*; its rim
# has a *chamfer*, a slope that leads inwards; and the end of the pin has a *bevel*. A pin that comes down anywhere
# on a slope slides into the hole. From the [drawing of the scene](../scenes/water_pump/dimensions.toml), in
# millimetres:

# %%
clearance, chamfer, bevel = 0.3, 2.0, 0.35
catches = (clearance + chamfer + bevel) / 25.4
print(f"should be caught up to {catches:.3f} in")

# %%
offsets = [0.06, 0.08, 0.10, 0.11, 0.12, 0.14]
runs = [handeye.begin(script, world=world, taught=taught.format(x=15 + off, y=35)) for off in offsets]
ends = [run.until() for run in runs]
print(
    "\n".join(
        f"{off:.2f} in beside: {'in' if run.completed else 'stands on the holder'}"
        for off, run in zip(offsets, runs, strict=True)
    )
)

# %% [markdown]
# The simulated physics, which does not use this sum, agrees with it.
#
# ## The rule
#
# `SEARCH s` tries places on a square grid of step *s*, in a spiral. The worst place for a hole is in the middle
# between four of them, at a distance of *s* / √2 from each. So the search finds a hole anywhere if
#
# **s / √2 ≤ clearance + chamfer + bevel.**
#
# A wider chamfer or more clearance allows a coarser search, but both cost precision or machining. A finer step costs
# time: half the step means four times the places. Here a step of .14 in is just fine enough, and .18 is not. Both
# searches begin with the hole at the worst place.

# %%
searching = """\
        OPEN    1
        MOVE    PIN
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        SEARCH  {step}
L:      MOVE    OVER
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .6
        SKIPE   23
        AOJ     L
"""
fine = handeye.begin(searching.format(step=0.14), world=world, taught=taught.format(x=14.93, y=34.93))
coarse = handeye.begin(searching.format(step=0.18), world=world, taught=taught.format(x=14.91, y=34.91))
print(fine.until().why, coarse.until().why, sep="\n")

# %% [markdown]
# The first four places of each search, with the catch of the hole around each, and the hole:

# %%
places = [(0, 0), (1, 0), (1, 1), (0, 1)]
figure, (left, right) = plt.subplots(1, 2, figsize=(6.4, 3.2), dpi=80, layout="constrained")
covering = [left.add_patch(plt.Circle((0.14 * x, 0.14 * y), catches, alpha=0.2)) for x, y in places]
missing = [right.add_patch(plt.Circle((0.18 * x, 0.18 * y), catches, alpha=0.2)) for x, y in places]
left.plot(0.07, 0.07, "x", color="tab:red", markersize=9)
right.plot(0.09, 0.09, "x", color="tab:red", markersize=9)
left.set(title="step .14 in: no gap", aspect="equal", xlim=(-0.15, 0.33), ylim=(-0.15, 0.33))
right.set(title="step .18 in: a gap", aspect="equal", xlim=(-0.15, 0.33), ylim=(-0.15, 0.33))
print(f"fine: ended at place {fine.state.memory.place + 1}; coarse: at place {coarse.state.memory.place + 1}")

# %% [markdown]
# The fine search found the hole from its first place, though that is at the edge of the catch. The coarse one struck
# the holder at all four, and continued outwards until it met no resistance. Where is that?

# %%
x, y, _ = coarse.state.hand[:3, 3] / 0.0254
print(f"({x:.2f}, {y:.2f}) in; the hole is at (15, 35)")

# %% [markdown]
# Beside the holder. The pin hangs in the air over its edge, and *no resistance* meant not a hole but nothing at all.
#
# ## Why the pump's program presses twice
#
# For this reason the listing of 1973 has a second motion: TRY TO GO DOWN WITHOUT MEETING RESISTANCE, and then IT
# SHOULD MEET SOME RESISTANCE. A hole has a bottom; the air beside the holder has none.

# %%
text = (handeye.scripts / "water_pump_1973.al").read_text()
print(text[text.index("        SEARCH  .07\nL1:") : text.index("        SAVE    E1")])

# %% [markdown]
# And its step? The screw holes of the base are narrow: .05 mm of clearance with a pin, a chamfer of 1 mm, the bevel
# of .35. By the rule:

# %%
catches = (0.05 + 1.0 + 0.35) / 25.4
print(f"catches {catches:.3f} in; a step of .07 needs {0.07 / 2**0.5:.4f}")

# %% [markdown]
# The rule holds, with a tenth to spare for the errors of the arm. The drawing says which figures of the cell were
# printed in 1973, and which were chosen so that the program of 1973 can work.
#
# The next notebook, [5. What each sense is worth](5_what_each_sense_is_worth.ipynb), takes the senses away, one by
# one. [The tutorial](../docs/language/tutorial.md) teaches the language again, with every run shown;
# [stepping](../docs/stepping.md) goes through a run step by step.
