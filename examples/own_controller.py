"""A controller of your own, called 60 times a second between two steps of an arm program: a spring pulls the hand down
until it presses on the table."""

import numpy as np

import handeye
from handeye.arm import forward, gravity, jacobian

SCRIPT = """\
        OPEN    .1              ;the program closes the fingers
        CHANGE  [0 0 1] 1       ;later, it lifts the hand by an inch
"""
STIFF = np.array([2e3, 2e3, 2e3, 60, 60, 60])  # spring of the hand: N/m, N m/rad
DAMPED = np.array([200, 200, 200, 3, 3, 3])  # its damper: N s/m, N m s/rad
DOWN = np.array([0, 0, -0.05, 0, 0, 0])  # m/s, rad/s
PRESS = 20.0  # N

run = handeye.begin(SCRIPT, task="insertion", camera="ray", seed=3)
run.step()
start, arm = run.state, run.arm
X_start = forward(start.joints, arm)


def press(seen):
    """Takes the readings of a servo period (1/60 s), and returns the command for the next one, or None to end."""
    X, J = forward(seen.q, arm), jacobian(seen.q, arm)
    turn = sum(np.cross(X[:3, k], X_start[:3, k]) for k in range(3)) / 2
    error = np.concatenate([X_start[:3, 3] - X[:3, 3], turn]) + DOWN * (seen.time - start.time)
    force = STIFF * error + DAMPED * (DOWN - J @ seen.qd)
    return handeye.Command(torque=gravity(seen.q, arm) + J.T @ force) if force[2] > -PRESS else None


state = run.control(press, seconds=20)
print(f"{state.why}, at {1000 * state.hand[2, 3]:.1f} mm")
state = run.until()
print(f"{state.why}, at {1000 * state.hand[2, 3]:.1f} mm; {run.result.interventions[0]}")
