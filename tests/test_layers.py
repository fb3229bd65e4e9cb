"""The import rules of docs/design.md, read off the source."""

import ast
import re
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest
from import_reading import imported, imports, makers, run_time_imports
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

PACKAGE = Path(__file__).parent.parent / "handeye"

LAYERS: list[set[str]] = [
    {"core"},
    {"program", "planfile", "ports"},
    {"arm", "vision", "touch", "al"},
    {"planning", "inspection", "execution", "proof"},
    {"cell", "judge"},
    {"machines", "tasks"},
    {"trace"},
    {"runs"},
    {"results", "report", "comparison", "video"},
    {"debugger"},
    {"teaching", "view"},
    {"editor"},
    {"api"},
    {"trials"},
    {"datasets"},
    {"agents"},
    {"exercises"},
    {"env"},
    {"cli"},
    {"systems"},
    {"__init__", "__main__"},
]
"""Downwards only: a folder may import from its own layer and those before it in this list."""

UPWARDS: dict[str, set[str]] = {}
"""Imports that break the order today; each is a debt, and none may be added."""

MODULES = sorted(".".join(p.relative_to(PACKAGE).with_suffix("").parts) for p in PACKAGE.rglob("*.py"))
KNOWN = frozenset(MODULES)
SKILLS = {"arm", "vision", "touch", "al"}
WORKING_PHASE = {"execution", "planning", *SKILLS}
ARITHMETIC = {
    "abc", "collections", "contextlib", "cv2", "dataclasses", "enum", "fractions", "functools", "hashlib",
    "itertools", "math", "msgspec", "numpy", "scipy", "statistics", "types", "typing", "zlib",
}  # fmt: skip
MAKERS = {
    "__init__": {"importlib.import_module"},  # a name of the API when it is used
    "cell.opengl": {"importlib"},  # one of two libraries of OpenGL, whichever is there
    "core.entries": {
        "importlib.import_module",
        "importlib.metadata",
    },  # a system or task when it is asked for
    "core.versions": {"importlib.metadata.version"},
}
"""Modules that name another one at run time, and by which means."""


POLICIES = {"env.program_policy", "env.scripted_pin"}


def room(module: str) -> str:
    """The folder of a module at the top of the package."""
    return module.split(".")[0]


def layer(module: str) -> int:
    """The layer of a module: that of its folder."""
    found = [number for number, folders in enumerate(LAYERS) if room(module) in folders]
    assert len(found) == 1, f"{room(module)} stands in {len(found)} layers"
    return found[0]


def source(module: str) -> str:
    """The text of a module."""
    return (PACKAGE / (module.replace(".", "/") + ".py")).read_text(encoding="utf-8")


@dataclass(frozen=True)
class Reading:
    """What these rules ask of a module. Its nodes themselves would take half a gigabyte for all modules."""

    imported: set[str]
    """Full names of what it imports."""
    made: set[str]
    """What it uses that imports under a name made at run time."""
    called: set[str]
    """Names of the methods that it calls."""
    systems: set[str]
    """Its classes that derive from those of a system."""
    asked: set[str]
    """Names in the second argument of its calls of `isinstance`."""


@cache
def read(module: str) -> Reading:
    """A module, parsed once for all rules."""
    nodes = list(ast.walk(ast.parse(source(module))))
    calls = [node for node in nodes if isinstance(node, ast.Call)]
    kinds = [
        call.args[1] for call in calls if isinstance(call.func, ast.Name) and call.func.id == "isinstance"
    ]
    return Reading(
        imported=imported(nodes, module),
        made=set(makers(nodes)),
        called={call.func.attr for call in calls if isinstance(call.func, ast.Attribute)},
        systems={
            node.name
            for node in nodes
            if isinstance(node, ast.ClassDef)
            and {ast.unparse(base) for base in node.bases} & {"System", "RunningSystem", "SystemState"}
        },
        asked={name.id for kind in kinds for name in ast.walk(kind) if isinstance(name, ast.Name)},
    )


def outside(module: str) -> set[str]:
    """Packages that are not ours and that a module imports."""
    return {name.split(".")[0] for name in read(module).imported} - {"handeye"}


@cache
def own(module: str) -> set[str]:
    """Modules of ours that a module imports."""
    return owned(read(module).imported)


def owned(names: set[str]) -> set[str]:
    """Modules of ours that full names are of."""
    result = set()
    for name in names:
        if name.split(".")[0] == "handeye":
            parts = name.split(".")[1:]
            while parts and ".".join(parts) not in KNOWN and ".".join([*parts, "__init__"]) not in KNOWN:
                parts.pop()
            result.add(".".join(parts) if ".".join(parts) in KNOWN else ".".join([*parts, "__init__"]))
    return result


def among(*rooms: str) -> list[str]:
    """Modules of some rooms."""
    return [module for module in MODULES if room(module) in rooms]


def crossing(modules: list[str], *rooms: str) -> dict[str, set[str]]:
    """Imports of some modules from some rooms, by module."""
    found = {module: {other for other in own(module) if room(other) in rooms} for module in modules}
    return {module: others for module, others in found.items() if others}


def upwards(module: str, others: set[str]) -> set[str]:
    """Those of some modules that lie above a module."""
    return {other for other in others if layer(other) > layer(module)}


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
        ("import handeye.core.units\nhandeye.cell.arm", "__init__"),
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


def test_a_planted_upward_import_is_seen() -> None:
    planted = owned(imports("from handeye.cli import app", "trace.eventlist"))
    assert upwards("trace.eventlist", planted) == {"cli.__init__"}


def test_modules_named_at_run_time_are_those_listed() -> None:
    found = {module: read(module).made for module in MODULES}
    assert {module: names for module, names in found.items() if names} == MAKERS


def test_imports_go_downwards_only() -> None:
    found = {module: upwards(module, own(module)) for module in MODULES}
    assert {module: others for module, others in found.items() if others} == UPWARDS


def test_the_core_imports_nothing_of_the_rest() -> None:
    assert {other for module in among("core") for other in own(module) if room(other) != "core"} == set()


def test_skills_and_language_do_not_know_each_other() -> None:
    found = {skill: crossing(among(skill), *(SKILLS - {skill})) for skill in SKILLS}
    assert {skill: others for skill, others in found.items() if others} == {}


def test_planner_and_executor_know_no_language() -> None:
    assert crossing(among("planning", "execution"), "al") == {}


def test_only_cell_referee_machines_tasks_and_systems_know_mujoco() -> None:
    knowing = {module for module in MODULES if "mujoco" in outside(module)}
    assert {m for m in knowing if room(m) not in {"cell", "judge", "machines", "tasks", "systems"}} == set()


def test_the_working_phase_needs_nothing_but_arithmetic_from_outside() -> None:
    """Nothing that could look into the simulator: no files, no processes, no foreign functions."""
    found = {module: outside(module) - ARITHMETIC for module in among(*(WORKING_PHASE - {"al"}))}
    assert {module: names for module, names in found.items() if names} == {}


PEERS = {"pandas", "roboticstoolbox"}
"""What handeye hands tables to, or is measured beside, where somebody has it; elsewhere it says so."""
PACKAGE_OF = {"cv2": "opencv-python-headless", "google": "protobuf", "PIL": "pillow"}
"""Packages whose modules have other names."""


def test_what_the_package_imports_and_what_it_asks_for_are_the_same() -> None:
    project = tomllib.loads((PACKAGE.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    del extras["notebooks"]  # which runs the notebooks, and is imported by none of the package
    wanted = [Requirement(text) for texts in (project["dependencies"], *extras.values()) for text in texts]
    foreign = set().union(*map(outside, MODULES)) - sys.stdlib_module_names - PEERS
    asked = {canonicalize_name(each.name) for each in wanted}
    assert {canonicalize_name(PACKAGE_OF.get(name, name)) for name in foreign} == asked


def test_nothing_stands_in_the_wall_but_what_ports_are_made_of() -> None:
    assert {o for m in among("ports") for o in own(m) if room(o) not in {"core", "ports"}} == set()


def test_the_working_phase_sees_the_cell_through_its_ports_only() -> None:
    assert crossing(among(*WORKING_PHASE), "cell", "judge", "tasks") == {}


def test_the_referee_speaks_only_to_tasks_results_trials_exercises_and_benches() -> None:
    listeners = crossing(MODULES, "judge")
    allowed = {
        "judge",
        "tasks",
        "results",
        "trials",
        "agents",
        "exercises",
        "env",
        "cli",
        "systems",
        "__init__",
    }
    assert {module for module in listeners if room(module) not in allowed} <= {"runs.system"}  # its hooks


def test_the_referee_is_asked_by_the_results_alone() -> None:
    assert {m for m in MODULES if "judge" in read(m).called} == {"results.judging"}


def test_only_the_environments_know_gymnasium() -> None:
    assert {room(m) for m in MODULES if "gymnasium" in outside(m)} == {"env"}


def test_the_included_policies_know_the_cell_by_what_they_observe() -> None:
    policies = [m for m in MODULES if m in ("env.policies", "env.seen_cell") or m in POLICIES]
    assert len(policies) == 2 + len(POLICIES)
    seen = crossing(policies, "cell", "judge", "tasks", "results")
    arithmetic, drawings = "cell.compiled_arm", "tasks.__init__"
    assert {
        m: others - {arithmetic, drawings} for m, others in seen.items() if others - {arithmetic, drawings}
    } == {}
    truthful = {"truth", "capture", "setup", "values", "reset"}
    assert {m: calls for m in policies if (calls := read(m).called & truthful)} == {}


def test_cell_and_referee_know_no_task() -> None:
    assert crossing(among("cell", "judge"), "tasks") == {}


def test_the_cell_knows_nothing_of_seeing_but_how_a_camera_is_built() -> None:
    seen = {o for m in among("cell") for o in own(m) if room(o) == "vision"}
    assert seen <= {"vision.camera_model"}


def test_tasks_are_known_by_name_only() -> None:
    doors = {"tasks.__init__", "tasks.inserting", "tasks.interface", "tasks.trial"}
    outsiders = [module for module in MODULES if room(module) not in {"tasks", "systems"}]
    assert {m: o - doors for m, o in crossing(outsiders, "tasks").items() if o - doors} == {}


def test_only_tasks_and_systems_name_their_robots() -> None:
    robots = {
        m: {o for o in own(m) if o.startswith("arm.robots.")} - {"arm.robots.__init__"}
        for m in MODULES
        if room(m) not in {"arm", "tasks", "systems"}
    }
    assert {module: named for module, named in robots.items() if named} == {}


def test_no_system_is_named_outside_of_its_folder() -> None:
    trig = r"\bTRIG\b|\btrig\b|Trig[A-Z]|[Tt]aught job|[Pp]alletis|\bbucket\b"
    name = re.compile(rf"{trig}|SUPERSIGMA|\bMAL\b|systems\.(stanford|sigma)")
    found = {m for m in MODULES if room(m) != "systems" and name.search(source(m))}
    assert found == {"__init__", "core.entries"}  # a name of the Python API, and where entries are found


def test_nobody_asks_of_which_class_a_system_is() -> None:
    classes = {"System", "RunningSystem", "Listing", "ExecutionState"}.union(
        *(read(module).systems for module in among("systems"))
    )
    outsiders = [module for module in MODULES if room(module) != "systems"]
    assert {m: asked for m in outsiders if (asked := read(m).asked & classes)} == {}


def test_what_shows_runs_drives_none() -> None:
    drivers = {"execution", "runs", "debugger", "teaching", "cli", "api"}
    assert crossing(among("report", "video"), *drivers) == {}


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
from handeye.core.source import Source

SCRIPT = "TRANS P [25 38 6 90 90 0]\\nMOVE P\\nCLOSE\\nSKIPE 2\\nOPEN 1\\nFREE 1,X\\nCHANGE Z,1\\nOPEN 1"
program, _ = compile_text(Source(name="wall.al", text=SCRIPT), Taught(positions={}, parts={}))
plan, _ = make_plan(program, STANFORD, task="water_pump")
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
