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
# [TRIG](../docs/trig.md) was made at MIT in 1982. At a terminal (`handeye trig`) you type short commands and drive
# the arm with a teach box; here the same lines are in cells. You can read this notebook without running it. Running
# it takes half a minute.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## Taught by doing
#
# The arm works over a moving platter, with physics. A line with `*` changes the platter by hand; here it adds a
# stack of three blocks. `M` is a move: if its position is undefined, the teach box drives the arm there, and
# `RECORD` defines it. Each command is carried out at once, and becomes a step of the program.

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
# `RUN -1000` undoes everything. The simulator is not reset: the *arm* goes back, picks up each block and puts it on
# the stack again, step by step, the last one first.

# %%
session.type("RUN -1000")

# %% [markdown]
# How well? Three photographs: before the program runs again, after its end, and after undoing it once more. The
# differences from the first show what the program changed, and what is left of that.

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
# Nothing visible is left. This world has no errors; in others, blocks return some tenths of a millimetre off, which
# a referee measures ([TRIG](../docs/trig.md#jobs-in-seeded-worlds)).
#
# ## What cannot be undone
#
# Undo reverses recorded actions, and assumes that the world has not changed since. So it must verify by touch. Run
# the program, and take the blocks away before undoing it:

# %%
session.type("RUN\n* CLEAR\nRUN -1000")

# %% [markdown]
# The hand closed where it had released the block, and its fingers met nothing. The arm stops there, with the cursor
# at the step that could not be undone, and waits for the user. The gap of the fingers is one of four guards: force,
# following error, gap, and support under a block ([TRIG](../docs/trig.md#forwards-and-backwards)).
#
# ## Loops, too
#
# The paper's second example moves a stack onto a pallet: a guarded move feels for the top of the stack, a position
# advances with each block, and two loops count rows and columns. On an arm without physics twenty blocks take no
# time.

# %%
palletiser = handeye.TrigSession()
palletiser.type((handeye.scripts / "palletise.trig").read_text(encoding="utf-8"))
palletiser

# %%
palletiser.type("RUN\nRUN -1000")

# %% [markdown]
# With physics, errors and a referee: `handeye trig palletise --out DIR`, which also writes a report. For the pump,
# whose program is more than a list of places, undoing needs more care: [dismantling](../docs/dismantling.md).
