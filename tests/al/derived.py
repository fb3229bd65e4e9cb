"""What of the manual is derived: the tables of instructions and codes, and the head of each page."""

import re
from pathlib import Path

from suites import MANUAL, Case, cases, compiled, shown

from handeye.al.definition import Instruction, Operand
from handeye.al.formatter import format_text
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.operand_help import part, takes
from handeye.core.codes import CODES, Code
from handeye.core.diagnostics import render
from handeye.core.errors import ERRORS
from handeye.editor.explain import example

REFERENCE = MANUAL / "reference"
END = "## Meaning\n"
"""Where what is derived of a page ends."""
LONGEST = 20
"""Lines and files of an example that is shown whole."""
INTRODUCTION = """\
# What can be wrong with a program

The checker finds {} kinds of mistake. For each kind, this page gives the code, an example, and the message for this
example. `handeye explain CODE` prints the example and the message of one code, and says how to correct the mistake if a
usual correction exists. An *error* prevents a plan; a *warning* does not. Mistakes *in the text* are found while the
script is read, and mistakes *in planning* while its motions are planned.
"""


def page(op: str) -> Path:
    """The page of an instruction."""
    return REFERENCE / f"{op.lower()}.md"


def manual() -> str:
    """The instructions as Markdown tables, one for each group."""
    out = []
    for group in dict.fromkeys(instruction.group for instruction in INSTRUCTIONS.values()):
        out += [f"### {group}", "", "| instruction | origin | what it does |", "|---|---|---|"]
        out += [f"| `{i.usage}` | {i.origin} | {i.help} |" for i in INSTRUCTIONS.values() if i.group == group]
        out.append("")
    return "\n".join(out)


def index() -> str:
    """The tables of instructions, each with a link to its page."""
    return re.sub(
        r"^\| (`([A-Z]+)[^`]*`)",
        lambda found: f"| [{found[1]}](reference/{found[2].lower()}.md)",
        manual(),
        flags=re.MULTILINE,
    )


def errors() -> str:
    """The table of errors a program can test."""
    rows = [f"| error {number} | {meaning} |" for number, meaning in sorted(ERRORS.items())]
    return "\n".join(["| error | meaning |", "|---|---|", *rows, ""])


def head(definition: Instruction) -> str:
    """The beginning of a page, up to where the prose begins."""
    said = definition.help[0].upper() + definition.help[1:]
    out = [f"# `{definition.usage}`", "", f"{said}.", ""]
    if definition.operands:
        out += ["| operand | accepts | origin |", "|---|---|---|"]
        out += [_row(definition, operand) for operand in definition.operands]
        out.append("")
    out.append(part(definition))
    raised = _raised(definition.op)
    if raised:
        out += ["", "| error | when |", "|---|---|"]
        out += [f"| {number} | {ERRORS[number]} |" for number in raised]
    return "\n".join([*out, "", END])


def _row(definition: Instruction, operand: Operand) -> str:
    return f"| `{operand.shown}` | {takes(definition, operand)} | {definition.origin_of(operand)} |"


def _raised(op: str) -> list[int]:
    """The errors that an instruction can raise in the examples of its page."""
    found: set[int] = set()
    for case in cases(page(op)):
        program = compiled(case)[0]
        steps = () if program is None else program.steps
        found.update(*(step.operation.raises for step in steps if step.text.split()[0].upper() == op))
    return sorted(found)


def diagnostics() -> str:
    """The page of all diagnostics: a table, and an example of each with what it gets."""
    out = [*INTRODUCTION.format(len(CODES)).split("\n"), "| code | | meaning | found |", "|---|---|---|---|"]
    out += [
        f"| [`{code}`](#{code}) | {entry.severity} | {entry.meaning} | {_FOUND[entry.phase]} |"
        for code, entry in sorted(CODES.items())
    ]
    for code, entry in sorted(CODES.items()):
        out += [
            "",
            f"## {code}",
            "",
            f"{entry.meaning[0].upper()}{entry.meaning[1:]}.",
            "",
            *_example(code, entry),
        ]
    return "\n".join(out) + "\n"


_FOUND = {
    "language": "in the text",
    "planning": "in planning",
    "strict": "with `--strict-1973`",
    "proof": "with `--prove`",
}


def _example(code: str, entry: Code) -> list[str]:
    if entry.phase == "proof":
        source, found = example(code)
        assert found is not None
        return ["```text", entry.example, "```", "", "```text", render(found, source), "```"]
    strict = entry.phase == "strict"
    required = {key: format_text(text) for key, text in entry.required.items()}
    case = Case(name="", program=format_text(entry.example), strict=strict, required=required)
    said = shown(case).get("diagnostic")
    if said is None:  # it is about the layout, and there is nothing wrong with that of the formatter
        said = shown(Case(name="", program=f"{entry.example}\n"))["diagnostic"]
        return ["```text", entry.example, "```", "", "```text", f"{said}```"]
    lines = case.program.split("\n")[:-1]
    if len(lines) + len(required) > LONGEST:
        cut = [*lines[:4], "...", *lines[-4:]]
        lines = cut if len(lines) > LONGEST else [*lines, f"; and so on, {len(required)} files"]
        return ["```text", *lines, "```", "", "```text", f"{said}```"]
    files = [line for key, text in required.items() for line in (f"```al {key}", f"{text}```", "")]
    return [*files, f"```al{' strict' * strict}", *lines, "```", "```diagnostic", f"{said}```"]
