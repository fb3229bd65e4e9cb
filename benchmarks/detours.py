"""Runs stepped through with detours, compared with the run without them."""

import random
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from benchmarks.breaking import UnbrokenRun, Verdict, handeye
from handeye.program.events import WentBack
from handeye.runs.folder import EVENTS, TRACE
from handeye.trace.eventlist import effective, read_events

DETOURS: Final = 10
"""Times that the run goes back."""
ENOUGH: Final = 600
"""Times to go on from a break: more than a run has breaks."""


def stepped(whole: UnbrokenRun, folder: Path) -> Iterator[Verdict]:
    """Step through the assembly from standard input, stopping at AOJ and on error 23, and going back ten times."""
    place = folder / "stepped"
    done = handeye(
        "run", str(whole.folder / "plan.json"), *whole.world, "--out", str(place),
        "--step", "--judge", "--break", "AOJ", "--break", "error:23",
        said="\n".join(commands(whole.seed)),
    )  # fmt: skip
    events = read_events(place / EVENTS)
    back = sum(isinstance(event, WentBack) for event in events)
    faults = [] if done.returncode == 0 else [f"exit code {done.returncode}"]
    if back != DETOURS:
        faults.append(f"went back {back} times instead of {DETOURS}")
    if tuple(effective(events)) != whole.events:
        faults.append("other events")
    if (place / TRACE).read_bytes() != whole.trace:
        faults.append("another trace")
    yield Verdict(name=f"going back {back} times", faults=tuple(faults))


def commands(seed: int) -> list[str]:
    """Commands to the stepper: forward and back ten times, then on to the end."""
    choice = random.Random(seed)  # noqa: S311 - a way through a run, not a secret
    lines = []
    for _ in range(DETOURS):
        lines += [f"step {choice.randrange(6, 30)}", *["continue"] * choice.randrange(3)]
        lines.append(choice.choice(["back stage", f"back {choice.randrange(1, 6)}"]))
    return [*lines, *["continue"] * ENOUGH]
