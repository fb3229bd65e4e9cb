"""Plans of long programs, made once in a session of tests: whoever asks for one again gets a copy of its own."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from functools import wraps
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from handeye.core.files import write_whole
from handeye.planfile.plan import Plan
from handeye.planning import planner

if TYPE_CHECKING:
    from handeye.program.diagnosis.plan_findings import PlanFinding
    from handeye.program.program import Program

LONG = 300
"""Steps from which a program is long: the pump's takes seconds to plan."""

Made = tuple[Plan | None, list["PlanFinding"]]
MakePlan = Callable[..., Made]


def keep_plans(folder: Path) -> None:
    """Have long programs planned once, for all processes of tests that share a folder.

    `test_kept_plans.py` shows that a kept plan equals one that is made again.
    """
    if not hasattr(planner.make_plan, "__wrapped__"):
        planner.make_plan = keeping(planner.make_plan, folder)


def keeping(make: MakePlan, folder: Path, long: int = LONG) -> MakePlan:
    """The same planner. A plan without findings is kept in the folder, and read when it is asked for again."""

    @wraps(make)
    def made(program: Program, *words: object, **more: object) -> Made:
        if len(program.steps) < long:
            return make(program, *words, **more)
        asked = msgspec.msgpack.encode(program) + pickle.dumps((words, sorted(more.items())))
        kept = folder / sha256(asked).hexdigest()
        if kept.exists():
            return msgspec.msgpack.decode(kept.read_bytes(), type=Plan), []
        plan, findings = make(program, *words, **more)
        if plan is not None and not findings:
            write_whole(kept, msgspec.msgpack.encode(plan))
        return plan, findings

    return made
