"""Checks of a whole program whose statements have no errors."""

import re
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from typing import Final

from handeye.al.checks.flow import check_flow
from handeye.al.checks.layout import check_layout
from handeye.al.checks.restores import check_restores
from handeye.al.definition import Refers
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.lower import Lowered
from handeye.al.macros import ExpandedStatement
from handeye.al.parameters import across, braced_in, parameters_in, uses
from handeye.al.statements import ByWord, Used, Vectors, all_statements, pairs
from handeye.al.syntax import Name, Script, Statement
from handeye.core.diagnostics import Diagnostic, Label, alternatives, names_sentence, problem, quoted
from handeye.core.source import Source
from handeye.program.graph import Graph
from handeye.program.program import Part
from handeye.program.taught import Taught


@dataclass(frozen=True, slots=True, kw_only=True)
class CompiledScript:
    """A script with the intermediate results of its compilation. In `statements`, macros with parameters appear
    with the operands of each call filled in.
    """

    source: Source
    script: Script
    statements: Sequence[Statement]
    words: ByWord
    used: Used
    vectors: Vectors
    placed: Sequence[ExpandedStatement]
    lowered: Lowered


def check_whole(whole: CompiledScript, taught: Taught, positions: Container[str]) -> list[Diagnostic]:
    """Run all checks of a whole program and return their diagnostics. `positions` are the taught positions and the
    positions written in the script.
    """
    graph = Graph(whole.lowered.steps)
    found = check_flow(graph, whole.lowered.origins)
    found += check_sights(whole.words, taught)
    found += check_layout(whole.script, whole.source)
    found += check_parameters(whole.script)
    found += check_restores(whole.lowered, graph)
    if "HERE" in whole.words:
        found += check_here(whole.placed, positions)
    return with_unused(found, _unused(whole, found))


def _unused(whole: CompiledScript, found: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Return warnings for unused names, except on lines that are never executed."""
    lost = {_line(whole.source, d) for d in found if d.code == "unreachable-code"}
    unused = [
        *unused_parameters(whole.script),
        *check_unused(whole.script, whole.statements, whole.words, whole.used, whole.source),
    ]
    # Other scripts may use the definitions of a required file; its labels are its own.
    return [
        d
        for d in unused
        if (line := _line(whole.source, d)) not in lost and (d.code == "unused-label" or not line[0])
    ]


def _line(source: Source, diagnostic: Diagnostic) -> tuple[str, int]:
    """Return the place of a diagnostic: the key of its file, and its line."""
    text, offset = source.find(diagnostic.primary.span.start)
    return text.key, text.position(offset)[0]


_POSITION_KINDS: Final = (Refers.POSITION, Refers.TARGET)


def check_here(placed: Sequence[ExpandedStatement], known: Container[str]) -> Iterator[Diagnostic]:
    """Report each position that is used further up in the text than the `HERE` that defines the position. `known` are
    the taught positions and the positions written in the script.
    """
    defined: dict[str, int] = {}
    for number, item in enumerate(placed):
        word, operands = item.statement.word, item.statement.operands
        if word is not None and word.text == "HERE" and isinstance(operands[0], Name):
            defined.setdefault(operands[0].text, number)
    for number, item in enumerate(placed):
        for operand, value in pairs(item.statement):
            if isinstance(value, Name) and operand.refers in _POSITION_KINDS and value.text not in known:
                here = defined.get(value.text, number)
                if here > number:
                    yield _early(value, placed[here].statement)


def _early(use: Name, here: Statement) -> Diagnostic:
    return problem(
        "position-before-here",
        f"position {quoted(use.text)} is used before `HERE` defines it",
        use.span,
        Label(span=here.span, text="defined here"),
        *uses(use),
        help="move the `HERE` up, or define the position before this line with `TRANS`",
    )


_DECLARED = {
    "TRANS": ("position", (Refers.POSITION, Refers.TARGET)),
    "VECT": ("vector", (Refers.VECTOR,)),
}  # declaring instruction: what it declares, and how that is used
_COMMENTED_OUT = re.compile(
    r"""^ (?: [^\n;"] | "[^\n"]*" )* ; [ \t]* (\w+) [ \t]+ (\w+)""", re.ASCII | re.MULTILINE | re.VERBOSE
)
_TOO_FAR = ("search-begun-anew", "count-begun-anew")


def check_unused(
    script: Script, statements: Iterable[Statement], words: ByWord, used: Used, source: Source
) -> Iterator[Diagnostic]:
    """Report the unused names of a script that has no errors. Unused taught positions are not reported, because
    another script may use them.
    """
    targets = {name.text for name in used[Refers.LABEL]}
    for statement in statements:
        for label in statement.labels:
            if label.text not in targets:
                message = f"no instruction jumps to label {quoted(label.text)}"
                yield problem("unused-label", message, label.span)
    for op, (what, as_) in _DECLARED.items():
        found = {name.text for refers in as_ for name in used[refers]}
        commented = cache(partial(_in_comments, source, as_))
        for statement in words.get(op, ()):
            name = statement.operands[0]
            if isinstance(name, Name) and name.text not in found:
                line = commented().get(name.text)
                help = (
                    None if line is None else f"line {line} uses the name, but only in a comment, after a `;`"
                )
                message = f"{what} {quoted(name.text)} is defined but never used"
                yield problem(f"unused-{what}", message, name.span, help=help)
    called = {statement.word.text for statement in all_statements(script) if statement.word is not None}
    for word, macro in script.macros.items():
        if word not in called:
            yield problem("unused-macro", f"macro {quoted(word)} is never used", macro.name.span)


def with_unused(found: list[Diagnostic], unused: list[Diagnostic]) -> list[Diagnostic]:
    """Join the diagnostics. A jump may go too far back, past an unused label that the user perhaps meant. Report such
    a jump and the label as one mistake.
    """
    left, merged = list(unused), []
    for diagnostic in found:
        if diagnostic.code in _TOO_FAR:
            begin, end = diagnostic.secondary[0].span.start, diagnostic.primary.span.start
            meant = [d for d in left if d.code == "unused-label" and begin < d.primary.span.start < end]
            if len(meant) == 1:
                left.remove(meant[0])
                label = Label(span=meant[0].primary.span, text="nothing jumps here")
                diagnostic = replace(diagnostic, secondary=(*diagnostic.secondary, label))
        merged.append(diagnostic)
    return merged + left


def _in_comments(source: Source, refers: tuple[Refers, ...]) -> dict[str, int]:
    """Find the instructions that are commented out. Returns a dictionary from the first operand of each instruction to
    the instruction's line.
    """
    words = {i.op for i in INSTRUCTIONS.values() if i.operands and i.operands[0].refers in refers}
    found: dict[str, int] = {}
    for comment in _COMMENTED_OUT.finditer(source.text):
        if comment[1].upper() in words:
            found.setdefault(comment[2], source.position(comment.start(1))[0])
    return found


Need = tuple[str, Callable[[Part], bool]]  # what must be taught of a part, and whether it is
_REGION: Final[Need] = ("`region`", lambda part: part.region is not None)
_OUTLINE: Final[Need] = ("`outline`", lambda part: part.outline is not None)
_HOLES: Final[Need] = ("two `holes`", lambda part: len(part.holes) >= 2)
_NEEDS: Final = {
    "GENERAL": (_REGION, _OUTLINE),
    "SPECIFIC": (_HOLES,),
    "INSPECT": (_HOLES,),
    "MATCH": (_OUTLINE,),
}


def check_sights(words: ByWord, taught: Taught) -> Iterator[Diagnostic]:
    """Check the vision instructions of a script whose names are valid."""
    for op, needs in _NEEDS.items():
        for statement in words.get(op, ()):
            name = statement.operands[0] if statement.operands else None
            if isinstance(name, Name) and name.text in taught.parts:
                yield from _not_described(op, name, needs, taught.parts)
    yield from _not_comparable(words)


def _not_described(
    op: str, name: Name, needs: tuple[Need, ...], parts: Mapping[str, Part]
) -> Iterator[Diagnostic]:
    lacking = [what for what, has in needs if not has(parts[name.text])]
    if lacking:
        others = [quoted(other) for other, part in parts.items() if all(has(part) for _, has in needs)]
        known = f"; parts with complete data: {', '.join(others)}" if others else ""
        message = f"`{op}` cannot find {quoted(name.text)} without its {' and '.join(lacking)}"
        help = f"add the missing data under `[parts.{name.text}]` in the taught file{known}"
        yield problem("part-not-described", message, name.span, help=help)


def _not_comparable(words: ByWord) -> Iterator[Diagnostic]:
    """Report comparisons with a picture that was taken without `HOLD`."""
    looks: dict[str, list[tuple[Name, bool]]] = {}
    for look in words.get("LOOK", ()):
        name, hold = look.operands
        assert isinstance(name, Name)
        looks.setdefault(name.text, []).append((name, hold is not None))
    for comparison in (*words.get("INSPECT", ()), *words.get("MATCH", ())):
        _, before, after = comparison.operands
        assert isinstance(before, Name)
        assert isinstance(after, Name)
        taken = looks.get(after.text, [])
        if not taken or any(held for _, held in taken):
            continue
        if any(held for _, held in looks.get(before.text, [])):
            message = (
                f"picture {quoted(before.text)} is named as the earlier picture, but is taken with `HOLD`, after "
                f"picture {quoted(after.text)}"
            )
            help = "name the earlier picture first"
            yield problem("compared-without-hold", message, across(before, after), help=help)
        else:
            yield problem(
                "compared-without-hold",
                f"picture {quoted(after.text)} is not taken at the target voltage of picture {quoted(before.text)}",
                after.span,
                Label(span=taken[0][0].span, text="the camera sets its target voltage again here"),
                help=f"`LOOK {after.text} HOLD` keeps the voltage of the earlier picture",
            )


def check_parameters(script: Script) -> Iterator[Diagnostic]:
    """Check the words in braces in the texts of macros. Each must be the name of a parameter of its macro."""
    for macro in script.macros.values():
        known = {parameter.text for parameter in macro.parameters}
        for name, span in (found for s in macro.body if known for found in braced_in(s)):
            if name not in known:
                meant = alternatives(name, known)
                lacks = f"{quoted(macro.name.text)} has no parameter {quoted(name)}"
                message = f"{lacks}, so the text keeps the braces as they are"
                yield problem("unknown-parameter", message, span, help=names_sentence(meant))


def unused_parameters(script: Script) -> Iterator[Diagnostic]:
    """Report parameters that no line of their macro uses."""
    for macro in script.macros.values():
        used = {name for line in macro.body for name, _ in braced_in(line)}
        used |= {token.text for line in macro.body for token in parameters_in(line)}
        for parameter in macro.parameters:
            if parameter.text not in used:
                words = {token.text for line in macro.body for token in line.tokens}
                braces = f"in a text, write a parameter in braces: `{{{parameter.text}}}`"
                help = braces if parameter.text in words else None
                message = f"parameter {quoted(parameter.text)} is never used"
                yield problem("unused-parameter", message, parameter.span, help=help)
