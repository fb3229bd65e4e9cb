"""Measures the cost of a program of a given length, and of several cells in one process."""

import gc
import tempfile
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Final, Literal

from benchmarks.speed import carry_out, peak_memory_mib
from handeye.al import AL, compile_text
from handeye.core.source import Source
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.planning.planner import plan_source
from handeye.program.taught import Taught, load_taught
from handeye.runs.folder import CHECKPOINTS, TRACE
from handeye.runs.runner import Runner
from handeye.runs.scripts import default_script
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.tasks import task
from handeye.trace.account import account
from handeye.trace.compare import first_difference
from handeye.trace.reading import read_trace

Unit = Literal["cpu_s", "mib"]
Costs = Mapping[tuple[str, Unit], float]
"""Costs by what was done, and by unit."""
_IN_A_CELL: Final = 100
"""Number of statements that each of several cells executes."""


def script(statements: int) -> str:
    """Return a program with a number of statements. Each hundred have a stage, a free motion, five straight motions,
    and no picture.
    """
    return "".join(f"        {_statement(number)}\n" for number in range(statements))


def _statement(number: int) -> str:
    block, at = divmod(number, 100)
    if at == 0:
        return "PARK"
    if at == 50:
        return f'STAGE   "number {block}"'
    if at % 20 == 10:
        return f"CHANGE  [0 0 {1 if number // 20 % 2 == 0 else -1}] .05"
    return f"ASSIGN  N {number % 1000}"


def statements(number: int) -> Costs:
    """Return the costs of a program with a number of statements, from checking its text to reading its trace."""
    source, taught = Source(name="growth.al", text=script(number)), _taught()
    costs: Costs = {
        ("checked", "cpu_s"): _cpu_s(lambda: compile_text(source, taught)),
        ("planned", "cpu_s"): _cpu_s(lambda: _plan(source, taught)),
    }
    with tempfile.TemporaryDirectory(prefix="handeye-") as name:
        folder = Path(name) / "run"
        return {**costs, **_carried(_setup(_plan(source, taught)), folder), **_recorded(folder)}


def _carried(setup: Setup, folder: Path) -> Costs:
    cost, _ = carry_out(setup, folder=folder, calibrate=False)
    records = cost.spent.components()["records"]
    return {
        ("executed", "cpu_s"): cost.spent.work_cpu_s - records,
        ("trace and checkpoints written", "cpu_s"): records,
    }


def _recorded(folder: Path) -> Costs:
    """Return the costs of the files that a run has left in a folder."""
    file = folder / TRACE
    trace, other = read_trace(file), read_trace(file)
    return {
        ("trace opened", "cpu_s"): _cpu_s(lambda: read_trace(file)),
        ("trace compared, as `verify` does", "cpu_s"): _cpu_s(lambda: first_difference(trace, other)),
        ("events as text, motion and forces as arrays", "cpu_s"): _cpu_s(
            lambda: (account(trace.events), trace.motion, trace.forces())
        ),
        ("trace on disk", "mib"): _mib([file]),
        ("checkpoints on disk", "mib"): _mib((folder / CHECKPOINTS).iterdir()),
    }


def cells(number: int) -> Costs:
    """Return the costs of several cells in this process. Their programs take turns after each step."""
    setup = _setup(_plan(Source(name="growth.al", text=script(_IN_A_CELL)), _taught()))
    gc.collect()  # removes earlier cells
    seconds = _cpu_s(lambda: _in_turn([Runner(Checkpoint(setup=setup)) for _ in range(number)]))
    peak = peak_memory_mib()
    cost: Costs = {("built, and a program executed", "cpu_s"): seconds}
    return cost if peak is None else {**cost, ("memory of the process", "mib"): peak}


def _in_turn(runners: Iterable[Runner]) -> None:
    going = [*runners]
    while going:
        for runner in going:
            runner.step()
        going = [runner for runner in going if not runner.ended]


def _plan(source: Source, taught: Taught) -> Plan:
    plan = plan_source(source, taught, task().arm, AL, task=task().name).plan
    assert plan is not None
    return plan


def _taught() -> Taught:
    """Return the taught positions of the product's script, which include the parking position."""
    return load_taught(default_script().with_suffix(".toml"))


def _setup(plan: Plan) -> Setup:
    return Setup(
        plan=plan, world=WorldSpec(seed=0), camera="ray"
    )  # never used, because the programs take no picture


def _cpu_s(work: Callable[[], object]) -> float:
    begun = time.process_time()
    work()
    return time.process_time() - begun


def _mib(files: Iterable[Path]) -> float:
    return sum(file.stat().st_size for file in files) / 2**20
