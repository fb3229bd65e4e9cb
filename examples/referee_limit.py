"""Give the referee other limits: how far has a pin moved after the hand has felt for it?"""

import handeye

SCRIPT = """\
        STAGE   "feel for a pin"
        OPEN    1
        MOVE    P1
        CENTER  .1              ;the fingers close until both touch, where the pin is
        OPEN    1
"""
TAUGHT = handeye.scripts / "water_pump.toml"

for limits in (None, {"pins": 0.05, "pins_tilt": 0.2}):
    run = handeye.begin(SCRIPT, seed=3, taught=TAUGHT, camera="ray", judge=True, referee=limits)
    run.until()
    print("limits of the task:" if limits is None else f"limits of {limits}:")
    for name in ("pins", "pins_tilt"):
        found = run.result.referee[name]
        print(f"  {'right' if found.ok else 'wrong'}: {found.sentence}: {found.value:g} {found.unit}")


def nothing_fell(truth):
    """A referee of your own: it measures the height of the lowest movable part, in the simulator's truth."""
    lowest = min(truth.data.body(name).xpos[2] for name in ("base", "gasket", "top", "pin0", "pin1"))
    return {"lowest": handeye.at_least(lowest * 1e3, 0.0, "mm", "height of the lowest part")}


run = handeye.begin(SCRIPT, seed=3, taught=TAUGHT, camera="ray", referee=nothing_fell)
run.until()
print("own referee:", run.assembled, run.result.referee["lowest"].value, "mm")
