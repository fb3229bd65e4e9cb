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
# At the end you will know how a program of 1973 finds a casting on a belt while it reads only a small part of its
# picture. You will know what a *beam* is, how to put a box around a *blob*, why to *bounce* inside a hole, and how
# to check a gasket without a model of it.
#
# You can read this notebook without running it. Running it takes a few seconds, because the pictures are from a
# recorded run that is included with handeye.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## Six pictures
#
# The camera is a television camera. Its pictures have 256 lines of 333 pixels in sixteen levels of grey. They have
# noise, so no two pictures are alike. A whole assembly takes six pictures: the wide view of the belt; the close-up
# of the base; the base in its standard position, first without and then with its gasket; and the finished pump,
# before and after the last time the arm pushes it.

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
# A program of today would filter all 85,000 pixels. In 1973 each pixel cost time on a shared computer, so the
# program read pixels only where it expected information. A `Scan` is a picture that records which of its pixels were
# read.
#
# ## A beam
#
# A beam starts at a point and follows a straight line until the brightness changes by a step. It compares the mean
# of three pixels ahead with the mean of three pixels behind, so that noise does not stop it. The next plot shows the
# grey levels along one line of the close-up, from the inside of the large hole to the right, and the place where a
# beam stops.

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
# A parabola through the three steepest differences locates the edge to a fraction of a pixel.
#
# ## A blob
#
# In the wide picture, the base is a bright blob on the dark belt. The *localiser* sends beams inwards from the
# border of a window until one meets a brighter area. There the localiser begins a box around the blob, and moves
# each side of the box outwards as long as a line just outside this side crosses the blob. Red marks all pixels that
# were read.

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
# The window is the region where the program expects the base, because it knows the belt and the camera. The box
# shows the place of the base to within an inch or two, which is good enough to aim the long lens at the base.
#
# ## Bouncing
#
# To find exactly where a hole is, start anywhere inside it. Send two beams, left and right, to its border, and go to
# the middle between their ends. Then send two beams up and down, and go to the middle again. For any convex shape,
# this procedure soon converges to the centre, with four beams for each bounce. This is the first bounce, from a
# start (the seed) far from the centre:

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
# To find this hole, the program read only this part of the picture:

# %%
print(f"{scan.beams} beams, {scan.points} of {close.size} points")

# %% [markdown]
# ## From two holes to a pose
#
# The base has two large holes. The line through their centres gives the place and the rotation of the base; the
# different sizes of the holes show which is which. The program then looks for the screw holes at the places that
# this pose predicts, and accepts the pose only if they are there. The next cell prints the pose that the program found
# in this run, and the true pose in the world of this run:

# %%
events = trace.table("events")
sentences = zip(events["event"], events["said"], strict=True)
print(*(said for event, said in sentences if event == "PartSeen"), sep="\n")
world = handeye.World(trace.head.world.seed)
print(f"in truth ({world['base.x']:.2f}, {world['base.y']:.2f}) in, turned {world['base.yaw']:.1f} degrees")

# %% [markdown]
# The error is a few hundredths of an inch and a few tenths of a degree. This is small enough for a finger to come
# down into a large hole. The program measures the remaining error by *touch*, as the next notebook shows.
#
# ## Is the gasket on?
#
# A dark gasket on a bright casting, seen from the side, with shadows and pins, is hard to describe. So the program
# uses no description. It takes one picture before the gasket is put on and one after, and analyses their
# *difference*, in which everything unchanged disappears. In the difference, the gasket is one blob with two holes.
# Beams find the borders of these holes, and the places of the holes show whether the gasket is in place.

# %%
before, after = pictures["BEFORE"], pictures["AFTER"]
figure, axis = plt.subplots(figsize=(5.2, 4), dpi=80, layout="constrained")
axis.imshow(before.astype(float) - after, cmap="gray", vmin=-4, vmax=12)
axis.axis("off")
sentences = zip(events["event"], events["said"], strict=True)
print(*(said for event, said in sentences if event == "PartInspected"))

# %% [markdown]
# The next notebook, [4. Force and search](4_force_and_search.ipynb), continues where vision ends.
