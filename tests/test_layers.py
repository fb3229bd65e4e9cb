"""The import rules of docs/design.md, read off the source."""

import ast
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest
from import_reading import imports, run_time_imports

PACKAGE = Path(__file__).parent.parent / "handeye"

FOUNDATIONS = {
    "units",
    "pose",
    "straight_ways",
    "boxes",
    "record",
    "source",
    "codes",
    "diagnostics",
    "errors",
    "extras",
    "files",
    "line_file",
    "folders",
    "resources",
    "variation",
    "distributions",
    "random_streams",
    "world_options",
    "faults",
    "fault_options",
    "versions",
    "whole_numbers",
    "mutable_records",
    "packed",
    "plain_text",
    "markup",
    "host_time",
    "user_cache",
}
LAYERS = [
    {*FOUNDATIONS},
    {"program", "planfile", "events", "system_state", "ports"},
    {"arm", "vision", "touch", "al"},
    {"planning", "inspection", "execution", "trig"},
    {"cell", "tasks", "judge"},
    {
        "runs",
        "debugger",
        "teaching",
        "report",
        "see",
        "video",
        "view",
        "comparison",
        "trace",
        "trials",
        "editor",
        "cli",
        "door",
        "__init__",
        "__main__",
    },
]
"""Downwards only: a folder may import from its own layer and those above it in this list."""

MODULES = sorted(".".join(p.relative_to(PACKAGE).with_suffix("").parts) for p in PACKAGE.rglob("*.py"))
SKILLS = {"arm", "vision", "touch", "al"}
WORKING_PHASE = {"execution", "planning", *SKILLS}
ARITHMETIC = {
    "abc", "collections", "contextlib", "cv2", "dataclasses", "enum", "functools", "hashlib", "itertools", "math",
    "msgspec", "numpy", "scipy", "types", "typing", "zlib",
}  # fmt: skip
MAKERS = {
    "__init__": {"importlib.import_module"},  # a name of the door when it is used
    "cell.opengl": {"importlib"},  # one of two libraries of OpenGL, whichever is there
    "tasks.__init__": {"importlib.import_module"},  # a task when it is asked for
    "versions": {"importlib.metadata.version"},
}
"""Modules that name another one at run time, and by which means."""


def layer(module: str) -> int:
    """The layer of a module: that of its folder."""
    folder = module.split(".")[0]
    found = [number for number, folders in enumerate(LAYERS) if folder in folders]
    assert len(found) == 1, f"{folder} stands in {len(found)} layers"
    return found[0]


def source(module: str) -> str:
    """The text of a module."""
    return (PACKAGE / (module.replace(".", "/") + ".py")).read_text(encoding="utf-8")


@cache
def outside(module: str) -> set[str]:
    """Packages that are not ours and that a module imports."""
    return {name.split(".")[0] for name in imports(source(module), module)} - {"handeye"}


@cache
def own(module: str) -> set[str]:
    """Modules of ours that a module imports."""
    return owned(imports(source(module), module))


def owned(names: set[str]) -> set[str]:
    """Modules of ours that full names are of."""
    result = set()
    for name in names:
        if name.split(".")[0] == "handeye":
            parts = name.split(".")[1:]
            while parts and ".".join(parts) not in MODULES and ".".join([*parts, "__init__"]) not in MODULES:
                parts.pop()
            result.add(".".join(parts) if ".".join(parts) in MODULES else ".".join([*parts, "__init__"]))
    return result


def called(module: str) -> set[str]:
    """Names of the methods that a module calls."""
    tree = ast.parse(source(module))
    calls = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return {function.attr for function in calls if isinstance(function, ast.Attribute)}


@pytest.mark.parametrize(
    ("sneaky", "reached"),
    [
        ("def f():\n    import mujoco", "mujoco"),
        ("def f():\n    from mujoco import mj_step", "mujoco.mj_step"),
        ("if TYPE_CHECKING:\n    from handeye.cell.arm import SimulatedArm", "cell.arm"),
        ("try:\n    import handeye.judge.measured as m\nexcept ImportError:\n    pass", "judge.measured"),
        ("from handeye import cell", "cell.__init__"),
        ("from handeye.tasks import interface", "tasks.interface"),
        ("from handeye.tasks import register", "tasks.__init__"),
        ("from ..cell import arm", "cell.arm"),
        ("from .. import judge", "judge.__init__"),
        ("from ...handeye.tasks.water_pump.cell import build_cell", "tasks.water_pump.cell"),
        ("from handeye import assemble", "__init__"),
        ("from handeye import *", "__init__"),
        ("import handeye\nhandeye.cell.arm", "__init__"),
        ("import handeye.units\nhandeye.cell.arm", "__init__"),
    ],
)
def test_an_import_is_seen_however_it_is_written(sneaky: str, reached: str) -> None:
    found = imports(sneaky, "execution.drive")
    assert reached in found | owned(found)


@pytest.mark.parametrize(
    "sneaky",
    [
        "__import__('mujoco')",
        "import importlib\nimportlib.import_module('mujoco')",
        "from importlib import import_module as bring",
        "import sys\nsys.modules['mujoco']",
        "from sys import modules",
        "exec('import mujoco')",
        "import builtins",
        "import pkgutil\npkgutil.resolve_name('mujoco:mj_step')",
    ],
)
def test_an_import_by_a_name_made_at_run_time_is_seen(sneaky: str) -> None:
    assert run_time_imports(sneaky)


@pytest.mark.parametrize("module", MODULES)
def test_nobody_imports_by_a_name_made_at_run_time(module: str) -> None:
    assert run_time_imports(source(module)) == MAKERS.get(module, set())


@pytest.mark.parametrize("module", MODULES)
def test_imports_go_downwards_only(module: str) -> None:
    assert {other: layer(other) for other in own(module) if layer(other) > layer(module)} == {}


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] in SKILLS])
def test_skills_and_language_do_not_know_each_other(module: str) -> None:
    mine = module.split(".")[0]
    assert {o for o in own(module) if o.split(".")[0] in SKILLS - {mine}} == set()


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] in {"planning", "execution"}])
def test_planner_and_executor_know_no_language(module: str) -> None:
    assert {o for o in own(module) if o.split(".")[0] == "al"} == set()


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] not in {"cell", "judge", "tasks"}])
def test_only_the_cell_and_the_referee_know_mujoco(module: str) -> None:
    assert "mujoco" not in outside(module)


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] in WORKING_PHASE - {"al"}])
def test_the_working_phase_needs_nothing_but_arithmetic_from_outside(module: str) -> None:
    """Nothing that could look into the simulator: no files, no processes, no foreign functions."""
    assert outside(module) <= ARITHMETIC


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] == "ports"])
def test_nothing_stands_in_the_wall_but_what_ports_are_made_of(module: str) -> None:
    assert {o for o in own(module) if o.split(".")[0] not in FOUNDATIONS | {"ports"}} == set()


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] in WORKING_PHASE])
def test_the_working_phase_sees_the_cell_through_its_ports_only(module: str) -> None:
    assert {o for o in own(module) if o.split(".")[0] in {"cell", "judge", "tasks"}} == set()


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] == "trig"])
def test_trig_knows_an_arm_by_its_own_port_only(module: str) -> None:
    assert {
        o for o in own(module) if o.split(".")[0] not in FOUNDATIONS | {"trig", "ports", "arm", "touch"}
    } == set()


def test_the_referee_speaks_only_to_reports() -> None:
    listeners = {m for m in MODULES if any(o.startswith("judge") for o in own(m))}
    assert {
        m
        for m in listeners
        if m.split(".")[0] not in {"judge", "tasks", "report", "trials", "cli", "__init__"}
    } == set()


def test_the_referee_is_asked_by_the_report_alone() -> None:
    assert {m for m in MODULES if "judge" in called(m)} == {"report.judging"}


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] in {"cell", "judge"}])
def test_cell_and_referee_know_no_task(module: str) -> None:
    assert {o for o in own(module) if o.split(".")[0] == "tasks"} == set()


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] == "cell"])
def test_the_cell_knows_nothing_of_seeing_but_how_a_camera_is_built(module: str) -> None:
    assert {o for o in own(module) if o.split(".")[0] == "vision"} <= {"vision.camera_model"}


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] != "tasks"])
def test_nobody_knows_a_task_but_by_its_name(module: str) -> None:
    assert {o for o in own(module) if o.split(".")[0] == "tasks"} <= {
        "tasks.__init__",
        "tasks.benches",
        "tasks.inserting",
        "tasks.interface",
        "tasks.trial",
    }


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] not in {"arm", "tasks"}])
def test_nobody_but_a_task_names_its_robot(module: str) -> None:
    assert {other for other in own(module) if other.startswith("arm.robots.")} <= {"arm.robots.__init__"}


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] in {"see", "video"}])
def test_what_shows_runs_drives_none(module: str) -> None:
    drivers = {"execution", "runs", "debugger", "teaching", "cli", "door"}
    assert {o for o in own(module) if o.split(".")[0] in drivers} == set()


WITHOUT_A_SIMULATOR = """
import sys
from importlib import import_module

class Wall:
    def find_spec(self, name, path=None, target=None):
        first, second, *_ = [*name.split("."), ""]
        if first == "mujoco" or (first == "handeye" and second in {"cell", "tasks", "judge"}):
            raise ImportError(f"{name} is behind the wall")

sys.meta_path.insert(0, Wall())
for module in sys.argv[1:]:
    import_module("handeye." + module)

import numpy as np
from fakes import FakeCell
from handeye.al import compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.execution.context import ExecutionContext
from handeye.execution.executor import Executor
from handeye.planning.planner import make_plan
from handeye.program.taught import Taught
from handeye.source import Source

SCRIPT = "TRANS P [25 38 6 90 90 0]\\nMOVE P\\nCLOSE\\nSKIPE 2\\nOPEN 1\\nFREE 1,X\\nCHANGE Z,1\\nOPEN 1"
program, _ = compile_text(Source(name="wall.al", text=SCRIPT), Taught(positions={}, parts={}))
plan, _ = make_plan(program, STANFORD)
cell = FakeCell(np.array(plan.motions[0].knots[0])).devices
executor = Executor(run=ExecutionContext(plan=plan, arm=STANFORD, cell=cell, camera=None, emit=lambda _: None))
while executor.state.at is not None:
    executor.step()
assert executor.finish(), executor.state.stopped
"""


def test_a_plan_is_made_and_carried_out_where_there_is_no_simulator() -> None:
    rooms = [m.removesuffix(".__init__") for m in MODULES if m.split(".")[0] in WORKING_PHASE]
    paths = [str(PACKAGE.parent), str(PACKAGE.parent / "tests" / "support")]
    done = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path[:0] = {paths}\n{WITHOUT_A_SIMULATOR}", *rooms],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
