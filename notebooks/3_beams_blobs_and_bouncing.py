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
# # 3. Beams, blobs and bouncing
#
# At the end you will know how a program of 1973 finds a casting on a belt while it looks at a small part of its
# picture: what a *beam* is, how a *blob* is surrounded, why one *bounces* inside a hole, and how a gasket is checked
# without knowing what a gasket is.
#
# Nothing here needs to be run to be read. Run, it takes some seconds: the pictures are those of a run that comes with
# handeye.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## Six pictures
#
# The camera is a television camera. Its pictures have 256 lines of 333 points and sixteen levels of grey, with noise;
# no two are alike. A whole assembly takes six of them: the belt from afar, the base from near by, the base in its
# standard position without and with its gasket, and the pump that it has become, before and after its last push.

# %%
trace = handeye.open(handeye.demo)
pictures = {taken.name: taken.picture for taken in trace.pictures}
figure, axes = plt.subplots(2, 3, figsize=(8.4, 4.6), dpi=70, layout="constrained")
shown = [
    axis.imshow(picture, cmap="gray") for axis, picture in zip(axes.flat, pictures.values(), strict=True)
]
named = [axis.set_title(name, fontsize=8) for axis, name in zip(axes.flat, pictures, strict=True)]
hidden = [axis.axis("off") for axis in axes.flat]

# %% [markdown]
# A program of today would hand all 85,000 points to a filter. In 1973 a point cost much of the time of a shared
# computer, so the program reads a point only where it expects to learn something. A `Scan` is a picture that keeps
# account of that.
#
# ## A beam
#
# A beam goes out from a point along a straight line until the brightness changes by a step: the mean of three points
# ahead against the mean of three points behind, so that noise does not stop it. That is all. Below, the levels along
# one line of the close picture, from the inside of the large hole to the right; and where a beam stops.

# %%
close = pictures["CLOSE_UP"]
scan = handeye.vision.Scan(close)
seed = (150, 115)
met = handeye.vision.beams(scan, [seed], [(1, 0)], handeye.vision.BRIGHTER, 4, 80)
figure, axis = plt.subplots(figsize=(6.4, 2.2), dpi=80, layout="constrained")
axis.step(range(seed[0], 240), close[seed[1], seed[0] : 240], where="mid", linewidth=0.9)
axis.axvline(met.uv[0, 0], color="tab:red")
axis.set(
    xlabel="point of the line",
    ylabel="level",
    title="a beam from inside the hole stops where it becomes brighter",
)
print(
    f"from {met.before[0]:.1f} to {met.after[0]:.1f}, {met.length[0]:.1f} points out; {scan.points} points read"
)

# %% [markdown]
# The place of the edge is known to a part of a point: a parabola through the three steepest differences says where
# between two points it lies.
#
# ## A blob
#
# In the picture from afar the base is a bright blob on the dark belt. The *localiser* sends beams inwards from the
# border of a window until one meets something brighter; from there it lets a box grow, each side outwards as long as
# a line a little ahead still crosses the blob. In red, all that it has read.

# %%
wide = pictures["WIDE"]
scan = handeye.vision.Scan(wide)
belt = [(160, 15), (262, 15), (212, 240), (85, 240)]
box = handeye.vision.localise(scan, belt, 2)
figure, axis = plt.subplots(figsize=(5.2, 4), dpi=80, layout="constrained")
axis.imshow(wide, cmap="gray")
axis.imshow(scan.read, cmap="autumn_r", alpha=scan.read * 0.45)
axis.add_patch(plt.Polygon(belt, fill=False, color="tab:blue"))
axis.add_patch(plt.Rectangle(box[:2], box.width, box.height, fill=False, color="yellow"))
axis.axis("off")
print(f"{box}: {scan.beams} beams, {scan.points / wide.size:.0%} of the picture read")

# %% [markdown]
# The window is where the program expects the base, by what it knows of belt and camera. The box says where the base
# is to an inch or two, enough to aim the camera at it through the long lens.
#
# ## Bouncing
#
# Where exactly is a hole? Start anywhere inside. Two beams, left and right, meet its border; go to the middle between
# them. Two beams up and down; to the middle again. For anything convex this comes to rest at the centre soon, with
# four beams a bounce. Here is the first bounce, from a seed that is far off:

# %%
scan = handeye.vision.Scan(close)
brighter = handeye.vision.BRIGHTER
level = handeye.vision.beams(scan, [seed, seed], [(-1, 0), (1, 0)], brighter, 4, 80).uv
middle = level.mean(axis=0)
upright = handeye.vision.beams(scan, [middle, middle], [(0, -1), (0, 1)], brighter, 4, 80).uv
hole = handeye.vision.characterise(scan, seed, 4, 80)
figure, axis = plt.subplots(figsize=(5.2, 4), dpi=80, layout="constrained")
axis.imshow(close, cmap="gray")
axis.plot(*seed, "o", color="yellow", label="seed")
axis.plot(*level.T, "-", color="tab:red", label="left and right")
axis.plot(*upright.T, "-", color="tab:cyan", label="up and down")
axis.plot(hole.u, hole.v, "+", color="lime", markersize=14, label=f"at rest after {hole.bounces} bounces")
axis.set(xlim=(90, 250), ylim=(210, 60))
axis.legend(fontsize=7)
axis.axis("off")
print(f"centre ({hole.u:.1f}, {hole.v:.1f}), {hole.width:.1f} points wide, {hole.height:.1f} high")

# %% [markdown]
# And so little of the picture was read for it:

# %%
print(f"{scan.beams} beams, {scan.points} of {close.size} points")

# %% [markdown]
# ## From two holes to a pose
#
# The base has two large holes. The line through their centres says where it lies and how it is turned; the sizes say
# which is which. The program looks for the screw holes where this pose wants them, and believes it only if they are
# there. What it said in this run, and what is true in the world of its seed:

# %%
events = trace.table("events")
sentences = zip(events["event"], events["said"], strict=True)
print(*(said for event, said in sentences if event == "PartSeen"), sep="\n")
world = handeye.World(trace.head.world.seed)
print(f"in truth ({world['base.x']:.2f}, {world['base.y']:.2f}) in, turned {world['base.yaw']:.1f} degrees")

# %% [markdown]
# Some hundredths of an inch, and some tenths of a degree: near enough for a finger to come down into a large hole.
# What is left is *felt*, as the next notebook shows.
#
# ## Is the gasket on?
#
# A dark gasket on a bright casting, seen from the side, with shadows and pins: hard to describe. So the program
# describes nothing. It takes a picture before and one after, and looks at the *difference*, where all that has not
# changed is gone. There the gasket is one blob with two holes in it; their borders, met by beams, tell whether it
# lies right.

# %%
before, after = pictures["BEFORE"], pictures["AFTER"]
figure, axis = plt.subplots(figsize=(5.2, 4), dpi=80, layout="constrained")
axis.imshow(before.astype(float) - after, cmap="gray", vmin=-4, vmax=12)
axis.axis("off")
sentences = zip(events["event"], events["said"], strict=True)
print(*(said for event, said in sentences if event == "PartInspected"))

# %% [markdown]
# The next notebook, [4. Force and search](4_force_and_search.ipynb), goes on where seeing ends.
