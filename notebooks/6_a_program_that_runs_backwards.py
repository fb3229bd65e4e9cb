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
# At the end you will have taught a robot without writing a program, have seen the program grow from what you did, and
# will know why taking something back is more than playing it in reverse.
#
# [TRIG](../docs/trig.md) was made at MIT in 1982. At a terminal (`handeye trig`) somebody types short commands and
# drives the arm with a teach box; here the same lines stand in cells. Nothing here needs to be run to be read. Run, it
# takes half a minute.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## Taught by doing
#
# An arm over a platter that moves, with physics. A line with `*` is somebody who puts things on the platter; here a
# stack of three blocks. `M` is a move: where its place is not known, the teach box drives the arm there, and `RECORD`
# gives it its name. Each command is done at once, and is a step of the program from then on.

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
# `RUN -1000` undoes as much as there is. This is no simulator that is set back: the *arm* goes back, takes the block up
# where it put it, and puts it on the stack again, step by step, the last one first.

# %%
session.type("RUN -1000")

# %% [markdown]
# How well? Three photographs: before the program runs again, when it has ended, and when it was undone once more. What
# differs from the first is what the program has changed, and what is left of that.

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
# Nothing that a camera sees. This world has no errors; in others blocks come back some tenths of a millimetre off,
# which a referee measures ([TRIG](../docs/trig.md#jobs-in-seeded-worlds)).
#
# ## What cannot be taken back
#
# Undo goes by what was done, and believes that the world is as it left it. So it has to feel for what it needs. Let the
# program run, and somebody take the blocks away before it is undone:

# %%
session.type("RUN\n* CLEAR\nRUN -1000")

# %% [markdown]
# The hand closed where it had let the block go, and its fingers met nothing. The arm stands there, the program's cursor
# is at the step that is not undone, and somebody has to look. The fingers' gap is one of four guards: force, following,
# the gap, and the place where something is set down ([TRIG](../docs/trig.md#forwards-and-backwards)).
#
# ## Loops, too
#
# The paper's second example puts a stack into a pallet: a guarded move feels for the top of the stack, a position moves
# on with each block, two loops count rows and columns. On an arm that is only imagined twenty blocks take no time.

# %%
palletiser = handeye.TrigSession()
palletiser.type((handeye.scripts / "palletise.trig").read_text(encoding="utf-8"))
palletiser

# %%
palletiser.type("RUN\nRUN -1000")

# %% [markdown]
# With physics, in a world with errors, and with a referee: `handeye trig palletise --out DIR`, which leaves a report.
# For the pump, whose program is no list of places, the same idea takes more care: [take it apart
# again](../docs/dismantling.md).
