"""Writes the names in docs/python.md from their docstrings; what stands above them there is written by people.

python docs/make_reference.py
"""

import ast
import inspect
import re
import sys
import textwrap
from collections.abc import Iterator
from functools import cache, cached_property
from pathlib import Path
from typing import Any, get_args

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import handeye  # noqa: E402
from handeye import events  # noqa: E402
from handeye.door import provided  # noqa: E402
from handeye.door.state import Memory  # noqa: E402
from handeye.inspection.inspection import InspectedStage, InspectedStep  # noqa: E402
from handeye.report import result  # noqa: E402
from handeye.report.world_page import QuantityReport  # noqa: E402
from handeye.trace.forces import Forces  # noqa: E402
from handeye.trace.motion import Motion  # noqa: E402
from handeye.trace.replay import Moment  # noqa: E402
from handeye.trials.results import Results  # noqa: E402

PAGE = ROOT / "docs" / "python.md"
MARK = "<!-- Below: docs/make_reference.py -->\n"
PARTS = ("Args", "Returns", "Raises")
GROUPS: dict[str, dict[str, Any]] = {
    "Plans": {"handeye.plan": handeye.plan, "handeye.Plan": handeye.Plan, "InspectedStage": InspectedStage,
              "InspectedStep": InspectedStep, "handeye.Diagnostic": handeye.Diagnostic},
    "Runs": {"handeye.begin": handeye.begin, "handeye.assemble": handeye.assemble, "handeye.Run": handeye.Run,
             "handeye.State": handeye.State, "Memory": Memory},
    "Worlds": {"handeye.World": handeye.World, "QuantityReport": QuantityReport},
    "Results": {"handeye.Result": handeye.Result, "Stage": result.Stage, "Timing": result.Timing, "Check": result.Check,
                "handeye.Finding": handeye.Finding, "handeye.at_most": handeye.at_most,
                "handeye.at_least": handeye.at_least,
                "handeye.trials.assemble_each": handeye.trials.assemble_each, "Results": Results},
    "Traces": {"handeye.open": handeye.open, "handeye.Trace": handeye.Trace, "Motion": Motion, "Forces": Forces,
               "Moment": Moment},
    "Tasks": {"handeye.Task": handeye.Task, "handeye.tasks.task": handeye.tasks.task,
              "handeye.tasks.register": handeye.tasks.register},
    "Errors": {"handeye.HandeyeError": handeye.HandeyeError, "handeye.InvalidInput": handeye.InvalidInput,
               "handeye.ScriptError": handeye.ScriptError},
}  # fmt: skip
"""Names by what they are for; those without `handeye.` are records that others hold."""


def reference() -> str:
    """All names with what is said of them."""
    out = [f"`handeye.scripts`: {attributes(provided)['scripts']}", ""]
    for group, names in GROUPS.items():
        out += [f"## {group}", ""]
        for name, named in names.items():
            out += described(name, named)
        out += TABLES[group]() if group in TABLES else []
    return "\n".join(out).rstrip() + "\n"


def findings() -> Iterator[str]:
    """The findings of the task's referee, as a table."""
    judged = handeye.assemble(script="OPEN 1\n", camera="ray").result.referee
    yield from ("### Findings of the water pump's referee", "", "| name | finding |", "|---|---|")
    yield from (f"| `{name}` | {check.sentence} |" for name, check in judged.items())
    yield ""


def happenings() -> Iterator[str]:
    """The events, as a table."""
    yield from ("### Events", "", *told(events.Event))
    yield from paragraph(
        "The seconds since a run began are `event.time - run.events[0].time`. A guard trips at the end of the servo "
        "period in which it was met, so its `value` lies over its `limit`: N, N m, or the mask of the fingers."
    )
    yield from ("", "| `handeye.events` | fields | what happened |", "|---|---|---|")
    for event in get_args(events.AnyEvent):
        fields = ", ".join(f"`{each}`" for each in event.__struct_fields__ if each != "time")
        said = "; ".join(inspect.getdoc(event).splitlines())
        yield f"| `{event.__name__}` | {fields} | {said} |"
    yield ""


TABLES = {"Results": findings, "Runs": happenings}
"""What stands below the names of a group."""


def described(name: str, named: Any) -> Iterator[str]:
    """The section of a name."""
    yield from (f"### {name}", "")
    if inspect.isfunction(named):
        yield from (*signature(name, named), *told(named))
        return
    constructed = isinstance(vars(named).get("__init__"), type(told)) and name == "handeye.World"
    yield from told(named)
    if constructed:
        yield from (*signature(name, named.__init__), *told(named.__init__))
    yield from members(name.split(".")[-1], named)


def members(name: str, named: type) -> Iterator[str]:
    """What a class has: attributes as a list, then methods."""
    fields = {each: said for each, said in attributes(named).items() if not each.startswith("_")}
    own = {each: member for each, member in vars(named).items() if not each.startswith("_")}
    asked = {each: member for each, member in own.items() if isinstance(member, property | cached_property)}
    said = fields | {each: inline(member) for each, member in asked.items()}
    for each, text in said.items():
        yield from paragraph(f"- `{each}`: {text}" if text else f"- `{each}`", "  ")
    yield from [""] if said else []
    for each, member in own.items():
        function = member.__func__ if isinstance(member, classmethod) else member
        if inspect.isfunction(function) and each not in HIDDEN:
            yield from (*signature(f"{name}.{each}", function), *told(function))


HIDDEN = {"attend", "reach", "of"}
"""Methods for handeye's own use."""


def signature(name: str, function: Any) -> Iterator[str]:
    """How a function is called, without what its arguments are: the text says so."""
    shown = []
    star = False
    for each in inspect.signature(function).parameters.values():
        if each.name == "self":
            continue
        if each.kind is each.KEYWORD_ONLY and not star:
            shown.append("*")
            star = True
        shown.append(each.name if each.default is each.empty else f"{each.name}={each.default!r}")
    text = f"{name}({', '.join(shown)})"
    yield from ("```", *textwrap.wrap(text, 100, subsequent_indent=" " * (len(name) + 1)), "```", "")


def told(named: Any) -> Iterator[str]:
    """A docstring as paragraphs: what it is, arguments, what comes back, what is raised, an example."""
    text = inspect.getdoc(named) or ""
    prose, mark, example = text.partition(">>> ")
    for block in re.split(r"\n\n", prose.strip()):
        head, _, rest = block.partition(":\n")
        if head in PARTS:
            yield from (*part(head, textwrap.dedent(rest)), "")
        else:
            yield from (*paragraph(block), "")
    if mark:
        yield from ("```python", *(mark + example).rstrip().splitlines(), "```", "")


def paragraph(text: str, indent: str = "") -> list[str]:
    """Text in lines as long as the pages have them."""
    return textwrap.wrap(" ".join(text.split()), 120, subsequent_indent=indent, break_on_hyphens=False)


def part(head: str, text: str) -> Iterator[str]:
    """Arguments, or exceptions, as a list; what comes back as a sentence."""
    if head == "Returns":
        yield from paragraph(f"Returns {text}")
        return
    if head == "Raises":
        yield "Raises:"
        yield ""
    for entry in re.split(r"\n(?=\S)", text.strip()):
        name, _, said = entry.partition(": ")
        yield from paragraph(f"- `{name}`: {said}", "  ")


def inline(member: property | cached_property[Any]) -> str:
    """What is said of a property, with what it raises."""
    text = " ".join((inspect.getdoc(member) or "").partition(">>> ")[0].split())
    return text.replace(" Raises: ", " Raises ")


@cache
def attributes(named: Any) -> dict[str, str]:
    """What is said of the attributes of a class or module, by their names."""
    source = inspect.getsource(named)
    body = ast.parse(textwrap.dedent(source)).body
    body = body[0].body if isinstance(named, type) else body
    found: dict[str, str] = {}
    for node, after in zip(body, [*body[1:], None], strict=True):
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            said = (
                after.value.value
                if isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant)
                else ""
            )
            found[node.target.id] = " ".join(str(said).split())
    return found


def page() -> str:
    """The page as it should be."""
    return PAGE.read_text(encoding="utf-8").partition(MARK)[0] + MARK + "\n" + reference()


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
