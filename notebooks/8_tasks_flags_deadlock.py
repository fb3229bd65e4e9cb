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
# # 8. Tasks, flags, deadlock
#
# At the end you will have made two robot arms work at the same time, seen two tasks wait for each other forever, and
# let a search try every order in which they could run.
#
# [MAL](../docs/mal.md), the language of SUPERSIGMA (Milan, 1981), looks like BASIC, but it has parallel tasks. The
# lines after `TASK` belong to a task, and `START` starts the task. The tasks take turns, one statement each.
#
# You can read this notebook without running it. Running it takes a few seconds.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## Two arms at once
#
# While one task waits for a motor, the other task goes on. So both arms move at the same time.

# %%
both = handeye.Mal("""
10 ORIGIN X1, X2
20 START LEFT, RIGHT
30 END
100 TASK LEFT
110 MOVE X1 TO 200
120 PRINT "LEFT", TIME
130 END
200 TASK RIGHT
210 MOVE X2 TO 100
220 PRINT "RIGHT", TIME
230 END
""")
both.run()

# %% [markdown]
# ## A flag
#
# `SET` sets a flag. `TAKE` waits until the flag is set, and clears it in the same statement, so only one task can
# take it. Here the flag FREE means that a place which both arms use is free. RIGHT waits until LEFT has moved away
# from this place.

# %%
shared = handeye.Mal("""
10 ORIGIN X1, X2
20 SET FREE
30 START LEFT, RIGHT
40 END
100 TASK LEFT
110 TAKE FREE
120 MOVE X1 TO 300
130 MOVE X1 TO 100
140 SET FREE
150 END
200 TASK RIGHT
210 TAKE FREE
220 MOVE X2 TO 300
230 MOVE X2 TO 100
240 SET FREE
250 END
""")
shared.run(until=130)
shared.tasks

# %% [markdown]
# Does the flag keep the arms apart at any speed of the motors? A run shows only one order of events.
# `interleavings` searches through all orders:

# %%
shared.interleavings()

# %% [markdown]
# Without the flag, the search finds an order in which both hands are at the same place:

# %%
race = handeye.Mal("""
10 ORIGIN X1, X2
20 START LEFT, RIGHT
30 END
100 TASK LEFT
110 MOVE X1 TO 300
120 MOVE X1 TO 100
130 END
200 TASK RIGHT
210 MOVE X2 TO 300
220 MOVE X2 TO 100
230 END
""")
race.interleavings()

# %% [markdown]
# On the gantries with physics, the hands collide:

# %%
crash = handeye.Mal(race.text, arm="gantries")
crash.run()
crash.stopped

# %%
figure, axis = plt.subplots(figsize=(6, 3), dpi=80, layout="constrained")
axis.plot(crash.history["time"], crash.history["place"][:, 0], label="hand 1")
axis.plot(crash.history["time"], 600 - crash.history["place"][:, 3], label="hand 2")
axis.set(xlabel="time, s", ylabel="place along the rail, mm")
axis.legend()
crash.doubtful

# %% [markdown]
# ## A deadlock
#
# Now the tasks share a jig and a screwdriver, and each task needs both. LEFT takes the jig first, and RIGHT takes the
# screwdriver first. Each then waits for what the other one has.

# %%
dead = handeye.Mal((handeye.scripts / "dead.mal").read_text(encoding="utf-8"))
dead.run()
dead.tasks

# %%
dead.stopped

# %% [markdown]
# The program stops, and the message names tasks, lines and flags. The search finds the same deadlock without
# running the program, and shows an order of statements that leads there:

# %%
dead.interleavings()

# %% [markdown]
# If both tasks take the flags in the same order, the deadlock is gone. Try it: swap the two `TAKE` statements of RIGHT
# in [dead.mal](../plans/dead.mal). [Handing pieces from arm to arm](../docs/handover.md) has a longer program, with a
# race and a deadlock to find.
