"""The import rules of docs/design.md, read off the source."""

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parent.parent / "handeye"

FOUNDATIONS = {
    "units",
    "pose",
    "boxes",
    "record",
    "source",
    "codes",
    "diagnostics",
    "errors",
    "files",
    "resources",
    "variation",
    "distributions",
    "world_options",
    "versions",
    "mutable_records",
}
LAYERS = [
    {*FOUNDATIONS},
    {"program", "planfile", "events", "system_state", "ports"},
    {"arm", "vision", "touch", "al"},
    {"planning", "inspection", "execution"},
    {"cell", "tasks", "judge"},
    {"runs", "debugger", "teaching", "report", "trace", "trials", "editor", "cli", "__init__", "__main__"},
]
"""Downwards only: a folder may import from its own layer and those above it in this list."""

MODULES = sorted(".".join(p.relative_to(PACKAGE).with_suffix("").parts) for p in PACKAGE.rglob("*.py"))
SKILLS = {"arm", "vision", "touch", "al"}


def layer(module: str) -> int:
    """The layer of a module: that of its folder."""
    folder = module.split(".")[0]
    found = [number for number, folders in enumerate(LAYERS) if folder in folders]
    assert len(found) == 1, f"{folder} stands in {len(found)} layers"
    return found[0]


def imports(module: str) -> set[str]:
    """Full names of everything a module imports."""
    path = PACKAGE / (module.replace(".", "/") + ".py")
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.update(f"{node.module}.{alias.name}" for alias in node.names)
    return found


def own(module: str) -> set[str]:
    """Modules of ours that a module imports."""
    result = set()
    for name in imports(module):
        if name.startswith("handeye."):
            parts = name.split(".")[1:]
            while parts and ".".join(parts) not in MODULES and ".".join([*parts, "__init__"]) not in MODULES:
                parts.pop()
            result.add(".".join(parts) if ".".join(parts) in MODULES else ".".join([*parts, "__init__"]))
    return result - {"__init__"}


def called(module: str) -> set[str]:
    """Names of the methods that a module calls."""
    tree = ast.parse((PACKAGE / (module.replace(".", "/") + ".py")).read_text())
    calls = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return {function.attr for function in calls if isinstance(function, ast.Attribute)}


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
    assert {name for name in imports(module) if name.split(".")[0] == "mujoco"} == set()


@pytest.mark.parametrize(
    "module", [m for m in MODULES if m.split(".")[0] in SKILLS | {"execution", "planning"}]
)
def test_the_working_phase_sees_the_cell_through_its_ports_only(module: str) -> None:
    assert {o for o in own(module) if o.split(".")[0] in {"cell", "judge", "tasks"}} == set()


def test_the_referee_speaks_only_to_reports() -> None:
    listeners = {m for m in MODULES if any(o.startswith("judge") for o in own(m))}
    assert {
        m for m in listeners if m.split(".")[0] not in {"judge", "tasks", "report", "trials", "cli"}
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
    assert {o for o in own(module) if o.split(".")[0] == "tasks"} <= {"tasks.__init__", "tasks.task"}


@pytest.mark.parametrize("module", [m for m in MODULES if m.split(".")[0] not in {"arm", "tasks"}])
def test_nobody_but_a_task_names_its_robot(module: str) -> None:
    assert {other for other in own(module) if other.startswith("arm.robots.")} <= {"arm.robots.__init__"}
