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
# # 5. What each sense is worth
#
# At the end you will know which error each sense of the arm corrects, what the program assumes without this sense,
# and how many pumps it then assembles in the same worlds.
#
# You can read this notebook without running it. Running it takes half a minute.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## An arm that does not know where it is
#
# The potentiometers in the joints read wrong, by an offset, a scale error and a ripple that differ in each world.
# When the joints show the right readings for a place, the hand is at another place. And no object is exactly where
# it is in the drawing: not the holder of the pins, not the rack, not the blocks against which the arm pushes the
# base. A seed determines all these errors.

# %%
worlds = [handeye.World(seed) for seed in range(150)]
print(f"world 3: the first joint reads {worlds[3]['arm.offset.1']:.3f} {worlds[3].unit('arm.offset.1')} off")
print(len(worlds[3].values), "quantities are drawn in each world")

# %% [markdown]
# ## Vision
#
# The base may lie anywhere in a region of the belt. Without vision, the hand goes to the planned place of the base.
# The program feels for a wall of the base there, and its search reaches 25 mm to either side.

# %%
figure, axis = plt.subplots(figsize=(6.4, 2.6), dpi=80, layout="constrained")
axis.scatter(*([world[name] for world in worlds] for name in ("base.x", "base.y")), s=8, color="0.4")
axis.set(xlabel=f"base, x, {worlds[0].unit('base.x')}", ylabel=f"y, {worlds[0].unit('base.y')}")
far = [
    max(world[name] for world in worlds) - min(world[name] for world in worlds)
    for name in ("base.x", "base.y")
]
print("the base lies within {:.1f} by {:.1f} in".format(*far))

# %% [markdown]
# To calibrate the camera, the same arm carries a lamp through the picture. So the calibration contains the errors of
# the arm, and an error that arm and camera share cancels out.
#
# ## Touch
#
# With the two switches in the fingers, CENTER can move the *hand* to a part instead of the part to the hand. SAVE
# keeps the displacement, and RESTORE applies it later. In the next cell, the hand centres on the screwdriver in its
# rack, in four worlds with large errors. The output shows the displacement, which the program knows from then on.

# %%
centring = """\
        OPEN    1.6
        MOVE    D
        CENTER  .5
        SAVE    DRV
"""
taught = "[positions]\nD = { at = [6, 33, 7, 90, 90, 0] }\n"
runs = [handeye.begin(centring, taught=taught, world=handeye.World(seed, level="high")) for seed in range(4)]
ends = [run.until() for run in runs]
felt = [abs(run.state.memory.saved["DRV"][1]) * 1e3 for run in runs]
print("\n".join(f"seed {seed}: {far:.1f} mm" for seed, far in enumerate(felt)))

# %% [markdown]
# ## Force
#
# In the next cell, the hand goes down to the table, whose height is 0. `STOP` ends the motion at 40 ounces. What
# height do the joints report at this moment?

# %%
script = """\
TRANS   ABOVE [25 38 .5 90 90 0]
        MOVE    ABOVE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 1 .2
"""
feeling = [handeye.begin(script, world=handeye.World(seed, level="high")) for seed in range(2)]
stopped = [run.until().why for run in feeling]
print("\n".join(f"{run.state.hand[2, 3] / 0.0254:+.3f} in, on a table at 0" for run in feeling))

# %% [markdown]
# With force, the motion ends where the table really is, whatever the joints report. Without force, a hand that moves
# to the assumed height of the table would stop too high, or press on the table with its full torque. The program can
# also compare two heights that it has measured by touch. In this way it knows whether one gasket lies on the base,
# or two.
#
# ## Search
#
# A search corrects the error that the other senses leave. It tries one place after the other, in a square spiral,
# until the hand goes down into the hole. If vision and touch have worked well, most searches end at their first
# place. The next cell lists all further places that the searches tried in the recorded run included with handeye.

# %%
demo = handeye.open(handeye.demo)
tried = [
    said
    for event, said in zip(demo.table("events")["event"], demo.table("events")["said"], strict=True)
    if event == "SearchAdvanced"
]
print("\n".join(tried))

# %% [markdown]
# ## The count
#
# The worth of a sense is the number of pumps that fail without it. With `--without`, the program uses its assumption
# instead of the sense; everything else is the same, including the worlds:
#
# ```
# $ handeye trials assembly --n 60 --seed 890000 --out whole
# $ handeye trials assembly --n 60 --seed 890000 --without touch --out without-touch
# $ handeye trials compare whole without-touch
# ```
#
# These commands take an evening on two processor cores. The next cell plots [their
# result](../docs/trials.md#what-they-are-worth), as the number of pumps assembled in 60 worlds. For the senses that
# hardly matter in these worlds, the plot also shows the number in 20 worlds with doubled errors.

# %%
nominal = {"nothing": 60, "centring": 59, "touch": 56, "search": 20, "vision": 2, "force": 0}
high = {"nothing": 20, "centring": 14, "touch": 11}
figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 2.6), dpi=80, layout="constrained")
bars = left.barh(list(nominal), list(nominal.values()), color="0.6")
more = right.barh(list(high), list(high.values()), color="0.6")
left.set(xlabel="assembled of 60, nominal errors", ylabel="without", xlim=(0, 60))
right.set(xlabel="of 20, errors twice as large", xlim=(0, 20))
flipped = left.invert_yaxis(), right.invert_yaxis()

# %% [markdown]
# Force, vision and search are decisive in any world; touch and centring are decisive where errors are large. The
# program noticed every failure and called the operator. [Trials](../docs/trials.md) explains how uncertain these
# counts are, and McNemar's test, which shows whether a difference between two sets of runs could be chance.
#
# [Force and search](4_force_and_search.ipynb) shows how the hand feels.
