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
# # 6. A program that runs backwards
#
# At the end you will have taught a robot without writing a program, seen the program grow from your actions, and
# understood why undoing is more than replaying in reverse.
#
# [TRIG](../docs/trig.md) was made at MIT in 1982. At a terminal (`handeye trig`), you type short commands and drive
# the arm with a teach box. In this notebook, the cells contain these commands.
#
# You can read this notebook without running it. Running it takes half a minute.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## Taught by doing
#
# The arm works over a moving platter, with simulated physics. A line with `*` changes the objects on the platter by
# hand; here it adds a stack of three blocks. `M` adds a move to a position. If the position is undefined, you drive
# the arm to the right place with the teach box, and `RECORD` defines the position. The arm does each command at once,
# and the command becomes a step of the program.

# %%
session = handeye.TrigSession("purbrick")
session.type("""
* STACK 3 X 90 Y 0
M OVER
    X 90 Y 0 Z 80 RECORD
M DOWN
    Z 30 RECORD
GRASP
M OVER
    Yes
M ASIDE
    X -60 Z 80 RECORD
M PUT
    Z 6 RECORD
UNGRASP
M ASIDE
    Yes
""")
session

# %%
after = session.photograph(width=480, height=360)
figure, axis = plt.subplots(figsize=(6, 4.5), dpi=80, layout="constrained")
axis.imshow(after)
axis.set_axis_off()

# %% [markdown]
# ## And back
#
# `RUN -1000` undoes everything. It does not reset the simulator: the *arm* goes back step by step, the last step
# first. It picks up each block that it has moved, and puts the block back on the stack.

# %%
session.type("RUN -1000")

# %% [markdown]
# How exactly does the arm put the blocks back? The next cell takes three photographs: before the program runs
# again, after its end, and after the arm has undone it once more. The differences from the first photograph show
# what the program changed, and what remains after undoing.

# %%
before = session.photograph()[150:400, 210:560].astype(int)
told = session.type("RUN")
ended = session.photograph()[150:400, 210:560].astype(int)
told += session.type("RUN -1000")
undone = session.photograph()[150:400, 210:560].astype(int)
figure, axes = plt.subplots(1, 3, figsize=(9, 2.5), dpi=80, layout="constrained")
axes[0].imshow(before)
axes[0].set_title("before")
axes[1].imshow(abs(ended - before).max(axis=2), cmap="gray_r", vmin=0, vmax=160)
axes[1].set_title("what it has changed")
axes[2].imshow(abs(undone - before).max(axis=2), cmap="gray_r", vmin=0, vmax=160)
axes[2].set_title("what is left of that")
axes[0].set_axis_off()
axes[1].set(xticks=[], yticks=[])
axes[2].set(xticks=[], yticks=[])
told

# %% [markdown]
# No visible change remains. This world has no errors. In other worlds, a referee measures how far each block is from
# its place after the undo: a few tenths of a millimetre ([TRIG](../docs/trig.md#jobs-in-seeded-worlds)).
#
# ## What cannot be undone
#
# Undo reverses recorded actions, and assumes that the world has not changed since then. So the arm must verify this
# assumption by touch. The next cell runs the program, and takes the blocks away before undoing it:

# %%
session.type("RUN\n* CLEAR\nRUN -1000")

# %% [markdown]
# The hand closed where it had released the block, and its fingers met nothing. The arm stops there, with the cursor
# at the step that could not be undone, and waits for the user. The gap between the fingers is one of four guards of
# an undo. The others watch the force, the lag of each axis behind its goal, and the support under a block
# ([TRIG](../docs/trig.md#forwards-and-backwards)).
#
# ## Loops, too
#
# The second example in the paper on TRIG moves a stack of blocks onto a pallet. A guarded move feels for the top of
# the stack, a position advances with each block, and two loops count rows and columns. This arm is simulated without
# physics, so twenty blocks take no time.

# %%
palletiser = handeye.TrigSession()
palletiser.type((handeye.scripts / "palletise.trig").read_text(encoding="utf-8"))
palletiser

# %%
palletiser.type("RUN\nRUN -1000")

# %% [markdown]
# `handeye trig palletise --out DIR` does the same with physics, errors and a referee, and also writes a report. The
# program of the pump is more than a list of places, so undoing it needs more care:
# [dismantling](../docs/dismantling.md).
