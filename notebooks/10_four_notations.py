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
# # 10. Four notations
#
# At the end you will know how four languages say the same guarded motion, what each of them cannot say, and how to
# compare them on the same pump.
#
# A pin goes down over its hole. If it meets no resistance, it is in a hole. If it meets resistance then, it stands on
# the bottom of this hole. [Four notations, one pump](../docs/four_notations.md) compares whole programs.
#
# You can read this notebook without running it. Running it takes a few seconds.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## The same two motions
#
# The programs are included with handeye. These are the lines of the arm language of 1973, whose words for it are
# `STOP`, `CHANGE` and `SKIPE` (skip the next line if this error happened):

# %%
careful = (handeye.scripts / "water_pump.al").read_text(encoding="utf-8")
print(careful.split("L1:", 1)[1].split("SAVE    E1")[0])

# %% [markdown]
# A TRIG program is a graph, which grows as you type. A guarded motion has two sons, one for *it arrived* and one for
# *a force stopped it*:

# %%
trig = handeye.TrigSession()
trig.type("""\
MA HOLE
    Z 101 RECORD
MRG DOWN
    Z BY -17 RECORD
    50
    (0 0 1)
CN TRY
MRG DEEPER n
    Z BY -15 RECORD
    60
    (0 0 1)
GOTO TRY
MR BACK g
    Z BY 40 RECORD
""")
trig

# %% [markdown]
# In ML, a sensor has limits. A reading outside its limits sets a flag and freezes all motors. Here the motors are
# perfect, and sensor 4 reads 1500 grams as soon as motor 2 is at 1.700 in:

# %%
ml = handeye.Ml(senses=["4=1500@2:1700"])
ml.do("SENSOR 4 -2000 1417")
ml.do("MOTOR 2 2000")
ml.position(2)

# %% [markdown]
# All motors freeze, the fingers, too. So they no longer press, and a pin slides out of the hand when the hand goes up.
# The program in ML therefore closes the hand again after each touch:

# %%
pins = (handeye.scripts / "pins.ml").read_text(encoding="utf-8")
print("\n".join(line for line in pins.splitlines() if line.startswith(("176 ", "177 ", "200 ", "201 "))))

# %% [markdown]
# In MAL, an axis has a limit. If a force stops the axis, the program continues at the line that `ON ABORT` names:

# %%
mal = (handeye.scripts / "pins.mal").read_text(encoding="utf-8")
print(mal[mal.index("440 REM") : mal.index("530 LIMIT")])

# %% [markdown]
# ## How long is a stage?
#
# Remarks and blank lines do not count. The program in the arm language does more than the others: it centres the
# fingers on each pin, which no other language can say.

# %%
files = {"TRIG": "pins.trig", "ML": "pins.ml", "MAL": "pins.mal"}
lines = {
    name: [line.split() for line in (handeye.scripts / file).read_text(encoding="utf-8").splitlines()]
    for name, file in files.items()
}
counts = {
    name: sum(bool(line) and not line[0].startswith((";", "*")) and line[1:2] != ["REM"] for line in each)
    for name, each in lines.items()
}
figure, axis = plt.subplots(figsize=(5, 2), dpi=80, layout="constrained")
axis.barh([*counts], [*counts.values()], color="0.6")
axis.set(xlabel="lines of the program that inserts the pins")
counts

# %% [markdown]
# ## Which one works?
#
# Only trials can tell. This command lets the careful program do all stages before a stage, in each of 40 worlds. Then
# each language does the stage, from the same state, and the referee judges the pump:
#
# ```
# $ handeye trials stages --n 40 --seed 979000 --checkpoints sound --out stages
# ```
#
# The [page on the four notations](../docs/four_notations.md#stages-by-language) has the result.
