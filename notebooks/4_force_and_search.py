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
# At the end you will know how a hand without a force sensor feels, and how a pin finds a hole that no camera sees.
# You will know a rule that connects clearance, chamfer and the step of a search: the step must be smaller than √2
# times the distance from which a hole catches the pin.
#
# You can read this notebook without running it. Running it takes half a minute.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## A pin goes back into its holder
#
# The hand takes an aligning pin out of its holder, lifts it, and puts it down again: over the hole, or beside it.
# `STOP [0 0 -50]` ends the motion below it when the hand presses down with 50 ounces. If nothing stops the motion,
# it raises error 23. Here this error means *success*: the pin is in the hole.
#
# The arm of this world has no errors, so that only geometry counts. The coordinates of the position `OVER` are
# filled in later.

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
# There is no force sensor in the wrist. Sixty times a second, the program compares the torques of the motors with
# the torques that the motion itself needs; the difference is due to an external force. Beside the hole, this force
# grows as soon as the pin meets the holder, and trips the guard. In the hole, the force stays far below the limit.

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
# The motion stops at more than 50 ounces, because the program measures the force only once in each servo period.
# Within one period, a stiff arm that presses on a stiff holder adds ten more ounces.
#
# ## What a hole catches
#
# How far from the hole may the pin come down and still slide in? The hole is larger than the pin by its *clearance*.
# Its rim has a *chamfer*, a slope that leads inwards, and the end of the pin has a *bevel*. A pin that comes down
# anywhere on a slope slides into the hole. These are the dimensions in the [drawing of the
# scene](../scenes/water_pump/dimensions.toml), in millimetres:

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
# The simulated physics agrees with the sum of clearance, chamfer and bevel, although the simulator never computes
# this sum.
#
# ## The rule
#
# `SEARCH s` tries places on a square grid with the step *s*, in a spiral. The worst place for a hole is in the
# middle between four of these places, at a distance of *s* / √2 from each. So the search finds the hole, wherever the
# hole is, if
#
# **s / √2 ≤ clearance + chamfer + bevel.**
#
# A wider chamfer or more clearance allows a coarser search, but a chamfer costs machining, and clearance costs
# precision. A finer step costs time: half the step means four times as many places. Here a step of .14 in is just
# fine enough, and a step of .18 in is not. In both searches, the hole is at the worst place.

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
# The next plot shows the first four places of each search, the area around each place in which a hole would be
# found, and the hole:

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
# The fine search found the hole from its first place, although the hole is near the edge of the area around this
# place. The coarse search struck the holder at all four places, and continued outwards until it met no resistance.
# Where did it end?

# %%
x, y, _ = coarse.state.hand[:3, 3] / 0.0254
print(f"({x:.2f}, {y:.2f}) in; the hole is at (15, 35)")

# %% [markdown]
# The search ended beside the holder. The pin hangs in the air beyond the edge of the holder. The motion met no
# resistance because there was nothing under the pin, not because there was a hole.
#
# ## Why the pump's program presses twice
#
# For this reason, the listing of 1973 has a second motion. The comment of the first is TRY TO GO DOWN WITHOUT
# MEETING RESISTANCE, and that of the second IT SHOULD MEET SOME RESISTANCE. A hole has a bottom; the air beside the
# holder has none.

# %%
text = (handeye.scripts / "water_pump_1973.al").read_text()
print(text[text.index("        SEARCH  .07\nL1:") : text.index("        SAVE    E1")])

# %% [markdown]
# Is the step of this program fine enough? The screw holes of the base are narrow: they have .05 mm of clearance for
# a pin and a chamfer of 1 mm, and the pin has its bevel of .35 mm. The rule gives:

# %%
catches = (0.05 + 1.0 + 0.35) / 25.4
print(f"catches {catches:.3f} in; a step of .07 needs {0.07 / 2**0.5:.4f}")

# %% [markdown]
# The step satisfies the rule, with a margin of a tenth for the errors of the arm. The drawing says which dimensions of
# the cell were printed in 1973, and which we chose so that the program of 1973 can work.
#
# The next notebook, [5. What each sense is worth](5_what_each_sense_is_worth.ipynb), removes the senses one by one.
# [The tutorial](../docs/language/tutorial.md) teaches the language again, and shows every run.
# [Stepping](../docs/stepping.md) goes through a run step by step.
