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
# # 9. Ten milliseconds
#
# At the end you will know why a robot that stops at every touch may still press nine times as hard as its limit says,
# and how this force depends on its clock, its servo and its speed.
#
# IBM's assembly system of 1975 runs programs in [ML](../docs/ml.md). Every ten milliseconds its real-time level reads
# all sensors. When a reading is outside its limits, this level freezes all motors.
#
# You can read this notebook without running it. Running it takes a few seconds.

# %%
import matplotlib.pyplot as plt

import handeye

# %% [markdown]
# ## A guarded move
#
# Sensor 5 is a strain gauge in a finger. `SENSOR 5 -178 450` expects the gauge to read between -178 and 450 grams.
# Then motor 3 moves from 0 to 4.000 inches. The motors of this arm are perfect: each reaches its set-point in every
# cycle. The gauge feels 500 grams as soon as motor 3 is at 2.750 inches.

# %%
ml = handeye.Ml(senses=["5=500@3:2750"])
ml.do("SENSOR 5 -178 450")
ml.do("MOTOR 3 4000")
ml.position(3)

# %% [markdown]
# The arm has stopped .006 inches too far. The error can be larger: at 20 cm/s the arm moves .079 inches (2 mm) in a
# cycle, and the sensor is read only at the end of the cycle. A program can make the motor move more slowly. Word 8 of
# the motor's line in the table MT limits its speed, in thousandths of an inch a cycle:

# %%
slow = handeye.Ml(senses=["5=500@3:2750"])
slow.do("PUT MT 3 8 10")
slow.do("SENSOR 5 -178 450")
slow.do("MOTOR 3 4000")
slow.position(3)

# %% [markdown]
# ## The latch
#
# The flag of sensor 5 is on now, and it stays on. Every further motion does nothing until `SENSOR` clears the flag:

# %%
slow.do("MOTOR 3 0")
slow.position(3), slow.read("ST", 5, 11)

# %% [markdown]
# ## The same in a physics simulation
#
# Real motors are not perfect, and a real finger presses on what it touches. `Ml.touch` lets the hand of the simulated
# arm descend on a block until a gauge feels 300 grams. It returns three values: the time from the contact until the
# limit was noticed (ms), the distance by which the slide went on (mm), and the greatest force of both fingers (N).

# %%
found = handeye.Ml.touch(period=10, bandwidth=50, speed=50)
found.noticed, found.way, found.force

# %% [markdown]
# The limit of 300 grams is 5.9 N for two fingers. The fingers press more than twice as hard: after the limit was
# crossed, the slide went on until the sensors were read, and then as far as its servo lagged behind.
#
# The left picture shows the place of the slide for three periods; the slide reaches the block at 0 ms. The right
# picture shows the force on the block. The dotted lines mark the readings at which the limit was noticed.

# %%
touches = {period: handeye.Ml.touch(period=period, bandwidth=50, speed=50) for period in (2, 10, 50)}
figure, (place, force) = plt.subplots(1, 2, figsize=(9, 3), dpi=80, layout="constrained")
[place.plot(each.times, each.places, label=f"{period} ms") for period, each in touches.items()]
[force.plot(each.times, each.forces) for each in touches.values()]
[place.axvline(each.noticed, color=f"C{n}", linestyle=":") for n, each in enumerate(touches.values())]
[force.axvline(each.noticed, color=f"C{n}", linestyle=":") for n, each in enumerate(touches.values())]
force.axhline(5.9, linestyle="--", color="grey")
place.set(xlabel="time after the contact, ms", ylabel="place of the slide, mm", ylim=(-1.5, 3))
place.legend(title="period")
force.set(xlabel="time after the contact, ms", ylabel="force of both fingers, N")

# %% [markdown]
# ## A law
#
# The slide goes on for three reasons: the fingers must be pressed until the gauge feels the limit; up to one period
# passes until the next reading; and the servo lags behind. `bound` is the sum of the three distances. For each touch,
# the list has the speed in mm/s, the distance by which the slide went on and its bound in mm, and the force in
# newtons.

# %%
tried = [handeye.Ml.touch(period=10, bandwidth=50, speed=speed) for speed in (10, 25, 50, 100, 200)]
[(each.speed, each.way, round(each.bound, 2), each.force) for each in tried]

# %% [markdown]
# ## The start
#
# So are a faster clock and a stiffer servo better? A stiffer servo also starts more abruptly. The fingers have a mass,
# and when the slide starts suddenly, the gauges feel the force on this mass. If the guard is already set, the force
# can trip it in free air. For each touch, the list has the bandwidth in Hz, the force on a finger at the start in
# newtons, whether this force trips the guard, and the distance by which the slide went on in mm.

# %%
starts = [handeye.Ml.touch(period=10, bandwidth=bandwidth, speed=200) for bandwidth in (10, 50, 100)]
[(each.bandwidth, each.jolt, each.trips, each.way) for each in starts]

# %% [markdown]
# Which speed would you choose for a touch of at most 20 N? [What ten milliseconds are](../docs/ten_milliseconds.md)
# has the answer for five periods, and `handeye ml touch --page touch.html` writes a page on which you can change the
# period, the bandwidth and the speed yourself.
