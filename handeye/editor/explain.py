"""Explanations of codes, error numbers and instructions."""

from functools import cache
from typing import Final

from handeye.al import extensions
from handeye.al.compiler import compile_text
from handeye.al.definition import Instruction
from handeye.al.includes import sewn_of
from handeye.al.instructions import EXPLAINED
from handeye.al.operand_help import origin, part, takes
from handeye.core.codes import CODES
from handeye.core.diagnostics import WIDTH, Diagnostic, quoted, render, suggestion
from handeye.core.errors import ERRORS, NoSuchName
from handeye.core.source import Source
from handeye.editor.error_numbers import error_text
from handeye.editor.samples import SAMPLE
from handeye.program.language import own_languages

_FOUND: Final = {
    "language": "while the script is checked",
    "planning": "when its motions are planned",
    "strict": "by `handeye check --strict-1973` only",
}
_NUMBERS: Final = {str(number): number for number in ERRORS}
_MAX_FILES = 2  # required files of an example that are shown


def explanation(word: str) -> str:
    """Explanation of a code, error number or instruction; raises NoSuchName with the nearest."""
    if word in CODES:
        return _code(word)
    if word.upper() in EXPLAINED:
        return _instruction(EXPLAINED[word.upper()])
    if (number := word.lstrip("0")) in _NUMBERS:
        return error_text(_NUMBERS[number])
    for language in own_languages():
        if (text := language.explanation(word)) is not None:
            return text
    near = suggestion(word, {*CODES, *EXPLAINED, *map(str, ERRORS)}) or suggestion(
        word, [code for code in CODES if word.lower() in code]
    )
    raise NoSuchName(
        f"there is no code, error number or instruction {quoted(word)}"
        + (f"; {near}" if near else "; `handeye explain` lists the codes")
    )


def listing() -> str:
    """All codes with their meaning, errors and warnings apart, and all error numbers."""
    width = max(map(len, CODES))
    out = []
    for severity in ("error", "warning"):
        out.append(f"{severity}s a script can have")
        out += [f"  {c:<{width}}  {e.meaning}" for c, e in sorted(CODES.items()) if e.severity == severity]
        out.append("")
    out.append("error numbers a script can test")
    out += [f"  {number:>2}  {meaning}" for number, meaning in sorted(ERRORS.items())]
    return "\n".join(out)


def _instruction(definition: Instruction) -> str:
    width = max((len(operand.shown) for operand in definition.operands), default=0)
    operands = [
        f"  {operand.shown:{width}}  {takes(definition, operand)} ({origin(definition, operand)})"
        for operand in definition.operands
    ]
    page = f"More and examples: docs/language/reference/{definition.op.lower()}.md"
    said = [definition.usage, "", definition.help, "", *operands, *[""] * bool(operands)]
    return "\n".join([*said, part(definition), page])


def _code(code: str) -> str:
    entry = CODES[code]
    out = [f"{entry.severity}[{code}]: {entry.meaning}", f"found {_FOUND[entry.phase]}", "", "for example"]
    out += ["", *(f"    {line}".rstrip() for line in _shortened(entry.example.split("\n"))), ""]
    for file, text in [*entry.required.items()][:_MAX_FILES]:
        out += [f"where {file} says", "", *(f"    {line}".rstrip() for line in text.split("\n")), ""]
    if len(entry.required) > _MAX_FILES:
        out += ["and so on", ""]
    source, diagnostic = example(code)
    if diagnostic is not None:
        # none of this is needed for numbers and instructions
        from handeye.editor.document import Document
        from handeye.editor.fix import cured
        from handeye.editor.fixes import fixes

        out += ["gives", "", *(f"    {line}".rstrip() for line in render(diagnostic, source).split("\n")), ""]
        cures = fixes(Document(source=source, taught=SAMPLE), diagnostic)
        if cures and not cures[0].choice:
            becomes = cured(source.text, cures[0]).rstrip("\n").split("\n")
            out += [f"cure: {cures[0].title}", "", *(f"    {line}".rstrip() for line in _shortened(becomes))]
    return "\n".join(out).rstrip()


def _shortened(lines: list[str], most: int = 16) -> list[str]:
    shown = [line if len(line) <= WIDTH else f"{line[:WIDTH]}..." for line in lines]
    return shown if len(shown) <= most else [*shown[: most - 4], "...", *shown[-3:]]


@cache
def example(code: str) -> tuple[Source, Diagnostic | None]:
    """The example of a code, and its diagnostic; None if the example alone does not cause it."""
    source = sewn_of(Source(name="example.al", text=CODES[code].example), CODES[code].required)
    program, found = compile_text(source, SAMPLE)
    if program is not None:
        from handeye.editor.checking import planning

        found = [*found, *planning(program)]
    if CODES[code].phase == "strict":
        found = [*found, *extensions(source)]
    return source, next((diagnostic for diagnostic in found if diagnostic.code == code), None)
