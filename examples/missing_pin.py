"""No pin is where the hand reaches for one: the arm program calls the operator, and this Python program answers."""

import handeye

SCRIPT = """\
        STAGE   "take a pin"
        OPEN    1
        MOVE    PIN
        CLOSE   .1              ;it holds nothing: error 2
        CHANGE  [0 0 1] 1
"""
TAUGHT = """\
[positions]
PIN = { at = [15.0, 32.0, 3.0, 90, 90, 0] }  # there is no pin at this place
"""
THERE = "15 35 3"  # x, y and z of the first holder, in

run = handeye.begin(SCRIPT, seed=3, taught=TAUGHT, camera="ray")
state = run.until()
print(f"{state.stage}, at {state.time:.1f} s: {state.why}")
assert run.result.error == 2

state = run.back("take a pin")
print(state)
run.say(f"set position PIN {THERE}")

state = run.until()
print(f"{state.why}; the fingers hold {state.gap / 0.0254:.2f} in")
print("by a person:", *run.result.interventions)
assert run.completed
