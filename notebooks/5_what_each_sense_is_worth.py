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
# At the end you will know which error each sense of the arm is there to beat, what a program without it would miss and
# by how much, and how one finds that out for hundreds of worlds without carrying out a single pump.
#
# Nothing here needs to be run to be read. Run, it takes half a minute.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## An arm that does not know where it is
#
# The potentiometers in the joints read wrong: by an offset, a scale and a waviness of their own, in each world others.
# Where the joints read right for a place, the hand is somewhere else. And nothing stands just where the drawing has
# it: not the holder of the pins, not the rack, not the blocks that the base is pushed against.
#
# `handeye.trials.predict` takes these errors from the same table that the simulator takes them from, follows the
# program through its motions, and works out how far each thing would come down beside where it should go. It is
# arithmetic: joints, frames, and what the program felt and saved before. Nothing is simulated.

# %%
n = 150
whole = handeye.trials.predict(n=n)
worlds = whole.worlds()
print(len(worlds), "worlds, seeds", worlds["seed"][0], "to", worlds["seed"][-1])

# %% [markdown]
# ## Search
#
# The first pin is brought over its hole. The hole's chamfer and the pin's bevel catch 1.4 mm. Beyond the first line
# the pin stands beside its hole; the search of the program reaches to the second.

# %%
figure, axis = plt.subplots(figsize=(6.4, 2.6), dpi=80, layout="constrained")
axis.hist(worlds["pin 1, T1: off"], bins=24, color="0.6")
axis.axvline(1.4, color="tab:red", label="caught at the first place")
axis.axvline(6.7, color="tab:red", linestyle="--", label="reached by the search")
axis.set(xlabel="mm beside the hole, first pin", ylabel="worlds")
axis.legend(fontsize=8)
missed = (worlds["pin 1, T1: off"] > 1.4).mean()
print(f"without a search, the first pin misses its hole in {missed:.0%} of the worlds")

# %% [markdown]
# ## Vision
#
# The base lies anywhere on the belt. The eye is calibrated by a lamp that this same arm carries through the picture,
# so that it learns to see in the arm's wrong coordinates; what both have wrong is not wrong between them. Without it,
# the hand goes where the base was planned to be.

# %%
without_vision = handeye.trials.predict(n=n, lacking=["vision"])
blind = without_vision.worlds()
figure, axis = plt.subplots(figsize=(6.4, 2.6), dpi=80, layout="constrained")
axis.hist(worlds["grasp, A: off"], bins=range(0, 160, 5), alpha=0.6, label="where it was seen")
axis.hist(blind["grasp, A: off"], bins=range(0, 160, 5), alpha=0.6, label="where it was planned")
axis.axvline(24.8, color="tab:red", linestyle="--", label="reached by the search")
axis.set(xlabel="mm beside the wall that is felt for", ylabel="worlds", yscale="log")
axis.legend(fontsize=8)
print(
    f"largest with vision {worlds['grasp, A: off'].max():.0f} mm, without {blind['grasp, A: off'].max():.0f} mm"
)

# %% [markdown]
# ## Touch
#
# Two switches in the fingers let CENTER move the *hand* to the thing instead of the thing to the hand. SAVE keeps how
# far that was, and RESTORE goes by it later: at the first screw the hand knows its error there from two pins that it
# has felt, one along x and one along y, and its error at the rack from the screwdriver.

# %%
without_touch = handeye.trials.predict(n=n, lacking=["touch"])
numb = without_touch.worlds()
figure, axis = plt.subplots(figsize=(6.4, 2.6), dpi=80, layout="constrained")
axis.hist(worlds["screw 1, H0: off"], bins=[k / 4 for k in range(21)], alpha=0.6, label="felt before")
axis.hist(numb["screw 1, H0: off"], bins=[k / 4 for k in range(21)], alpha=0.6, label="not felt")
axis.axvline(2.4, color="tab:red", label="caught at the first place")
axis.set(xlabel="mm beside the hole, first screw", ylabel="worlds")
axis.legend(fontsize=8)
caught = [(each["screw 1, H0: off"] < 2.4).mean() for each in (worlds, numb)]
print("caught at the first place: {:.0%} with what was felt, {:.0%} without".format(*caught))

# %% [markdown]
# ## Side by side
#
# Two measures: in how many worlds something does not fit at all, and how many further places the searches of a whole
# pump try, each of which takes the arm a second and a half or two. (Checks of heights are left aside: whether their
# windows are wide enough is a question to the program, and not to a sense.)

# %%
found = {
    "nothing": whole,
    "vision": without_vision,
    "touch": without_touch,
    "centring": handeye.trials.predict(n=n, lacking=["centring"]),
    "search": handeye.trials.predict(n=n, lacking=["search"]),
}
things = [*zip(*(whole.table()[name] for name in ("operation", "at", "what")), strict=True)]
kinds = [f"{operation}, {at}: {what}" for operation, at, what in things]
rooms = {name: dict(zip(kinds, each.table()["room"], strict=True)) for name, each in found.items()}
tables = {name: each.worlds() for name, each in found.items()}
fits = {
    name: [each[kind] <= rooms[name][kind] for kind in kinds if "height" not in kind]
    for name, each in tables.items()
}
fail = {name: 1 - sum(all(column) for column in zip(*each, strict=True)) / n for name, each in fits.items()}
searched = [f"{operation}, {at}: places" for operation, at, what in things if what == "off"]
further = {name: sum(each[kind].mean() - 1 for kind in searched) for name, each in tables.items()}

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(7.6, 2.6), dpi=80, layout="constrained")
bars = left.barh(list(fail), [100 * share for share in fail.values()], color="0.6")
more = right.barh(list(further)[:-1], list(further.values())[:-1], color="0.6")
left.set(xlabel="% of worlds where something fails", ylabel="without")
right.set(xlabel="further places searched, mean")
flipped = left.invert_yaxis(), right.invert_yaxis()
print(
    "\n".join(
        f"without {name:9} {fail[name]:4.0%} fail, {further[name]:5.1f} further places" for name in found
    )
)

# %% [markdown]
# Vision and search decide whether a pump comes about. Touch saves searching, and the last stage needs it: a hand that
# has not felt where the pump stands takes it, now and then, for one that was moved. `centring` is worth as much as
# `touch` here, because what is saved is known by CENTER alone. Without `search` nothing is searched, so that it has no
# bar on the right: each hole has one chance.
#
# ## Force
#
# The prediction takes it that a motion ends where it should. That is what force is for, so this sense has to be seen
# at work. The hand goes down to the table, whose height is 0. `STOP` ends the motion at 40 ounces; where do the joints
# then believe the hand to be?

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
# With force the motion ends where the table really is, whatever the joints say. A hand that went down to where the
# table should be would hang over it by as much, or press on it with all that its motors have. And a height that was
# felt is one that can be compared with another: so the program knows whether a gasket lies on the base, or two.
#
# ## Is it true?
#
# A model that nobody has checked is an opinion. Here the hand really centres on the screwdriver in its rack, in the
# simulator, in four worlds with large errors; beside it, what was predicted for the same seeds.

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
told = handeye.trials.predict(handeye.World(0, level="high"), 4).worlds()["driver, D: along"]
print("\n".join(f"seed {k}: predicted {told[k]:.1f} mm, felt {felt[k]:.1f} mm" for k in range(4)))

# %% [markdown]
# It holds to half a millimetre or so. The screwdriver hangs loosely, and the finger that comes first moves it a little
# before its switch fires.
#
# And a whole pump: the run that comes with handeye. How many further places did its searches try, and how many had been
# predicted?

# %%
demo = handeye.open(handeye.demo)
events = demo.table("events")
advanced = events["event"].count("SearchAdvanced")
same = handeye.trials.predict(handeye.World(demo.head.world.seed), 1).worlds()
wanted = sum(int(same[kind][0]) - 1 for kind in searched)
print(f"{len(searched)} searches, further places: {wanted} predicted, {advanced} tried")

# %% [markdown]
# How well it agrees over a batch of whole trials, and what it leaves out, is told in [trials](../docs/trials.md).
#
# ## The dear way
#
# Prediction says where to look. What counts is pumps. The same question is put to whole trials by
#
# ```
# $ handeye trials assembly --n 60 --out whole
# $ handeye trials assembly --n 60 --without touch --out without-touch
# $ handeye trials compare whole without-touch
# ```
#
# with the same seeds on both sides, and a test (McNemar's) of whether the pairs that differ fall too unevenly for
# chance. An evening's work for two processors; the cells above took seconds. `handeye trials predict --worst 100
# --simulate` joins both: ten thousand worlds by arithmetic, and the hundred worst of them carried out.
#
# [What came of it](../docs/trials.md#what-they-are-worth): without force no pump of 60 is assembled, without vision 2,
# without search 20. Touch and centring are missed where errors are twice as large: without touch 11 of 20 are
# assembled, without centring 14, with all senses 20. Every failure was noticed.
#
# You have come to the end. [Force and search](4_force_and_search.ipynb) shows how the hand feels;
# [trials](../docs/trials.md) how to count, and how sure a count is.
