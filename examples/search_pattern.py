"""A search pattern of your own: if the guess is wrong along x, a row of places finds a pin sooner than a spiral."""

import handeye

SCRIPT = """\
        STAGE   "feel for the pin"
        OPEN    .1
        SEARCH  .2
L:      MOVE    GUESS
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] .8
        SKIPN   23              ;it met something: this is the pin
        AOJ     L               ;it met nothing: try the next place
"""
TAUGHT = """\
[positions]
GUESS = { at = [15.85, 35.0, 4.2, 90, 90, 0] }
"""


def row(place: int) -> tuple[float, float]:
    """Places along x, farther and farther on both sides: 0, 1, -1, 2, -2, ... steps of the search."""
    return (place + 1) // 2 * (1 if place % 2 else -1), 0


for name, pattern in {"spiral": None, "row": row}.items():
    run = handeye.begin(SCRIPT, seed=3, taught=TAUGHT, camera="ray", search=pattern)
    state = run.until()
    x, y, z = state.hand[:3, 3] / 0.0254
    print(
        f"{name:6}  {state.memory.place + 1:2} places, {state.time:5.1f} s: at ({x:.2f}, {y:.2f}, {z:.2f}) in"
    )
    print(f"        {state.why}; parts that are not handeye's own: {run.result.replaced or 'none'}")
