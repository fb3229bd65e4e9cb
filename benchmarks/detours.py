"""Steps through a run, goes back several times, and compares the result with the run without detours."""

import random
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from benchmarks.breaking import UnbrokenRun, Verdict, handeye
from handeye.core.plain_text import counted
from handeye.program.events import WentBack
from handeye.runs.folder import EVENTS, TRACE
from handeye.trace.eventlist import effective, read_events

DETOURS: Final = 10
"""Number of times that the run goes back."""
ENOUGH: Final = 600
"""Number of `continue` commands at the end: more than a run has breakpoints."""


def stepped(whole: UnbrokenRun, folder: Path) -> Iterator[Verdict]:
    """Step through the assembly with commands on standard input. The run stops at AOJ and at error 23, and goes back
    ten times.
    """
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
        faults.append(f"went back {counted(back, 'time')} instead of {DETOURS}")
    if tuple(effective(events)) != whole.events:
        faults.append("different events")
    if (place / TRACE).read_bytes() != whole.trace:
        faults.append("a different trace")
    yield Verdict(name=f"going back {counted(back, 'time')}", faults=tuple(faults))


def commands(seed: int) -> list[str]:
    """Return the commands for the stepper: forwards and back ten times, and then on to the end."""
    choice = random.Random(seed)  # noqa: S311 - a way through a run, not a secret
    lines = []
    for _ in range(DETOURS):
        lines += [f"step {choice.randrange(6, 30)}", *["continue"] * choice.randrange(3)]
        lines.append(choice.choice(["back stage", f"back {choice.randrange(1, 6)}"]))
    return [*lines, *["continue"] * ENOUGH]
