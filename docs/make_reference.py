"""Write the names in docs/python.md from their docstrings; the text above them is written by hand.

python docs/make_reference.py
"""

import re
import sys
import textwrap
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Final, get_args

import griffe

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import handeye  # noqa: E402
from handeye.program import events  # noqa: E402

PAGE = ROOT / "docs" / "python.md"
MARK = "<!-- Below: docs/make_reference.py -->\n"
OPTIONS: Final = {"returns_multiple_items": False, "returns_named_value": False, "warnings": False}
with warnings.catch_warnings():
    warnings.simplefilter(
        "ignore", SyntaxWarning
    )  # griffe tries to read texts within annotations as annotations
    PACKAGE: Final = griffe.load(
        "handeye", search_paths=[ROOT], docstring_parser="google", docstring_options=OPTIONS
    )
GROUPS: Final = {
    "Plans": {
        "handeye.plan": "api.plans.plan",
        "handeye.Plan": "api.plans.Plan",
        "FlowDrawing": "api.plans.FlowDrawing",
        "InspectedStage": "inspection.inspection.InspectedStage",
        "InspectedStep": "inspection.inspection.InspectedStep",
        "handeye.Diagnostic": "api.diagnostic.Diagnostic",
    },
    "Runs": {
        "handeye.begin": "api.begin.begin",
        "handeye.assemble": "api.begin.assemble",
        "handeye.Run": "api.run.Run",
        "handeye.Command": "api.control.Command",
        "handeye.State": "api.state.State",
        "Memory": "api.state.Memory",
    },
    "Worlds": {
        "handeye.World": "api.worlds.World",
        "QuantityReport": "results.world_page.QuantityReport",
        "Export": "results.export.Export",
        "Weight": "results.export.Weight",
    },
    "Results": {
        "handeye.Result": "results.result.Result",
        "Stage": "results.result.Stage",
        "Timing": "results.result.Timing",
        "Check": "results.result.Check",
        "handeye.Finding": "judge.finding.Finding",
        "handeye.at_most": "judge.finding.at_most",
        "handeye.at_least": "judge.finding.at_least",
        "handeye.trials.assemble_each": "trials.results.assemble_each",
        "Results": "trials.results.Results",
    },
    "Traces": {
        "handeye.open": "api.trace.open",
        "handeye.Trace": "api.trace.Trace",
        "Motion": "trace.replay.Motion",
        "Forces": "trace.forces.Forces",
        "Moment": "trace.replay.Moment",
        "Table": "trace.table.Table",
        "Video": "video.making.Video",
        "handeye.compare": "api.trace.compare",
        "handeye.Comparison": "comparison.comparison.Comparison",
        "First": "comparison.first.First",
        "QuantityDifference": "trace.quantities.QuantityDifference",
        "Divergence": "comparison.parting.Divergence",
        "Place": "comparison.pairing.Place",
    },
    "Programs that are taught": {
        "handeye.TrigSession": "systems.trig.session_api.TrigSession",
    },
    "A bus of microcomputers": {
        "handeye.Microbus": "systems.sigma.microbus_api.Microbus",
        "handeye.Mal": "systems.sigma.mal_api.Mal",
    },
    "A terminal of ML": {
        "handeye.Ml": "systems.ml.ml_api.Ml",
    },
    "The arm": {
        "handeye.arm.forward": "arm.door.forward",
        "handeye.arm.inverse": "arm.door.inverse",
        "IKResult": "arm.ik.result.IKResult",
        "handeye.arm.jacobian": "arm.door.jacobian",
        "handeye.arm.gravity": "arm.door.gravity",
        "handeye.arm.mass_matrix": "arm.door.mass_matrix",
    },
    "Vision": {
        "handeye.vision.Scan": "vision.scan.Scan",
        "handeye.vision.beams": "vision.door.beams",
        "Edges": "vision.beam.Edges",
        "handeye.vision.localise": "vision.door.localise",
        "BoundingBox": "vision.blob.BoundingBox",
        "handeye.vision.characterise": "vision.door.characterise",
        "Blob": "vision.characteriser.Blob",
    },
    "Tasks": {
        "handeye.Task": "tasks.interface.Task",
        "handeye.tasks.task": "tasks.task",
        "handeye.tasks.register": "tasks.register",
    },
    "Errors": {
        "handeye.HandeyeError": "core.errors.HandeyeError",
        "handeye.InvalidInput": "core.errors.InvalidInput",
        "handeye.BadArgument": "core.errors.BadArgument",
        "handeye.NoSuchName": "core.errors.NoSuchName",
        "handeye.BadFile": "core.errors.BadFile",
        "handeye.CannotWrite": "core.errors.CannotWrite",
        "handeye.Refused": "core.errors.Refused",
        "handeye.ScriptError": "api.diagnostic.ScriptError",
        "handeye.PhysicsFailed": "core.errors.PhysicsFailed",
    },
}
"""Names by what they are for, and where each is defined; those without `handeye.` are records that others hold."""


def reference() -> str:
    """All names with their descriptions."""
    out = []
    for name in ("scripts", "demo"):
        out += [*paragraph(f"`handeye.{name}`: {sentence(PACKAGE[f'api.provided.{name}'])}"), ""]
    for group, names in GROUPS.items():
        out += [f"## {group}", ""]
        for name, place in names.items():
            out += described(name, place)
        out += TABLES[group]() if group in TABLES else []
    return "\n".join(out).rstrip() + "\n"


def findings() -> Iterator[str]:
    """The findings of the task's referee, as a table."""
    judged = handeye.assemble(script="OPEN 1\n", camera="ray").result.referee
    yield from ("### Findings of the water pump's referee", "")
    yield from paragraph(
        "In `overlap_bores` and `overlap`, the names after the colon are those of the two bodies that overlap most; "
        "they differ from run to run."
    )
    yield from ("", "| name | finding |", "|---|---|")
    yield from (f"| `{name}` | {check.sentence} |" for name, check in judged.items())
    yield ""


def happenings() -> Iterator[str]:
    """The events, as a table."""
    yield from ("### Events", "", *told(PACKAGE["program.events.Event"]))
    yield from paragraph(
        "To get the seconds since the run began, calculate `event.time - run.events[0].time`. A guard trips at the end "
        "of the servo period in which its condition was met, so its `value` exceeds its `limit` (N or N m). A guard "
        "on touch is different: its `value` is the mask of the closed finger switches, and its `limit` the mask of "
        "those selected."
    )
    yield from ("", "| `handeye.program.events` | fields | what happened |", "|---|---|---|")
    for event in get_args(events.CommonEvent):
        fields = ", ".join(f"`{each}`" for each in event.__struct_fields__ if each != "time")
        said = sentence(PACKAGE["program.events"][event.__name__])
        yield f"| `{event.__name__}` | {fields} | {said} |"
    yield ""


TABLES: Final = {"Results": findings, "Runs": happenings}
"""What stands below the names of a group."""
UNITS: Final = {"s", "m", "mm", "deg", "rad"}
"""Words that a sentence may begin with in small letters."""
CONSTRUCTED: Final = {"handeye.World", "handeye.vision.Scan"}
"""Classes of which people make objects."""
HIDDEN: Final = {"attend", "reach", "of"}
"""Methods for handeye's own use."""


def described(name: str, place: str) -> Iterator[str]:
    """The section of a name."""
    named = PACKAGE[place]
    yield from (f"### {name}", "")
    if named.is_function:
        yield from (*signature(name, named), *told(named))
        return
    yield from told(named)
    if name in CONSTRUCTED:
        yield from (*signature(name, named.members["__init__"]), *told(named.members["__init__"]))
    yield from members(name.split(".")[-1], named)


def members(name: str, named: griffe.Class) -> Iterator[str]:
    """The members of a class: attributes as a list, with properties last, then methods."""
    own = {
        each: member
        for each, member in (abstract(named) | named.members).items()
        if not (each.startswith("_") or member.is_alias)
    }
    attributes = {each: member for each, member in own.items() if member.is_attribute}
    asked = {each for each, member in attributes.items() if "property" in member.labels}
    held = {each for each, member in attributes.items() if member.annotation is not None} - asked
    for each in sorted(attributes, key=lambda each: each in asked):
        if each in held | asked:
            said = sentence(attributes[each])
            yield from paragraph(f"- `{each}`: {said}" if said else f"- `{each}`", "  ")
    yield from [""] if held | asked else []
    for each, member in own.items():
        if member.is_function and each not in HIDDEN:
            yield from (*signature(f"{name}.{each}", member), *told(member))


def abstract(named: griffe.Class) -> dict[str, griffe.Object]:
    """The members of a class that come from an abstract base in the same module, or from a base of the same name."""
    beside = (named.parent.members.get(str(base)) for base in named.bases)
    bases = (base for base in beside if base is not None and not base.is_alias)
    found = {k: v for base in bases if "ABC" in map(str, base.bases) for k, v in base.members.items()}
    namesakes = (base for base in named.resolved_bases if base.name == named.name)
    return found | {k: v for base in namesakes for k, v in base.members.items()}


def signature(name: str, function: griffe.Function) -> Iterator[str]:
    """How to call a function, without the types of its arguments, which the text describes."""
    shown: list[str] = []
    for each in function.parameters:
        if each.name in ("self", "cls"):
            continue
        if each.kind is griffe.ParameterKind.keyword_only and "*" not in shown:
            shown.append("*")
        shown.append(each.name if each.default is None else f"{each.name}={default(each.default)}")
    text = f"{name}({', '.join(shown)})"
    yield from ("```", *textwrap.wrap(text, 100, subsequent_indent=" " * (len(name) + 1)), "```", "")


def default(value: str | griffe.Expr) -> str:
    """A default value as a person would write it: a constant of the package appears as its value."""
    named = isinstance(value, griffe.ExprName | griffe.ExprAttribute)
    if named and value.canonical_path.startswith("handeye."):
        value = PACKAGE[value.canonical_path.removeprefix("handeye.")].value
    return str(value).replace('"', "'")


def told(named: griffe.Object) -> Iterator[str]:
    """A docstring as paragraphs: the description, the arguments, the result, the errors, an example."""
    for section in parsed(named):
        match section:
            case griffe.DocstringSectionText(value=text):
                yield from prose(text)
            case griffe.DocstringSectionParameters(value=arguments):
                yield from (*listed((each.name, each.description) for each in arguments), "")
            case griffe.DocstringSectionReturns(value=[returned]):
                yield from (*paragraph(f"Returns {returned.description}"), "")
            case griffe.DocstringSectionRaises(value=errors):
                yield from ("Raises:", "")
                yield from (*listed((str(each.annotation), each.description) for each in errors), "")
            case _:
                raise ValueError(f"{named.path}: there is no rule for a section of {section.kind.value}")


def parsed(named: griffe.Object) -> list[griffe.DocstringSection]:
    """The sections of a docstring."""
    return named.docstring.parsed if named.docstring else []


def prose(text: str) -> Iterator[str]:
    """The paragraphs, and the example that ends them."""
    said, mark, example = text.partition(">>> ")
    for block in re.split(r"\n\n", said.strip()):
        yield from (*paragraph(block), "") if block else ()
    if mark:
        yield from ("```python", *(mark + example).rstrip().splitlines(), "```", "")


def listed(entries: Iterator[tuple[str, str]]) -> Iterator[str]:
    """Arguments, or exceptions, as a list."""
    for name, said in entries:
        yield from paragraph(f"- `{name}`: {said}", "  ")


def sentence(named: griffe.Object) -> str:
    """An attribute described in one line, with the errors it raises; without a docstring, the comment of a field."""
    said = [] if named.docstring or not named.is_attribute else [comment(named)]
    for section in parsed(named):
        if isinstance(section, griffe.DocstringSectionText):
            said.append(section.value.partition(">>> ")[0])
        elif isinstance(section, griffe.DocstringSectionRaises):
            said += [f"Raises {each.annotation} if {each.description}" for each in section.value]
    return " ".join(" ".join(said).split())


def comment(named: griffe.Attribute) -> str:
    """The comment after a field, as a sentence."""
    line = named.filepath.read_text(encoding="utf-8").splitlines()[named.endlineno - 1]
    said = line.partition("  # ")[2]
    first = said.partition(" ")[0].rstrip(";:,.")
    start = said[:1] if first in UNITS else said[:1].upper()
    return f"{start}{said[1:].rstrip('.')}." if said else ""


def paragraph(text: str, indent: str = "") -> list[str]:
    """The text, wrapped at the line length of the pages."""
    return textwrap.wrap(" ".join(text.split()), 120, subsequent_indent=indent, break_on_hyphens=False)


def page() -> str:
    """The page as it should be."""
    return PAGE.read_text(encoding="utf-8").partition(MARK)[0] + MARK + "\n" + reference()


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
