"""Text in, checked program out."""

from pathlib import PurePath

from handeye.al.faint import faint
from handeye.al.flow import check_flow
from handeye.al.form import MISSING
from handeye.al.graph import Graph
from handeye.al.here import check_here
from handeye.al.layout import check_layout
from handeye.al.lower import lower
from handeye.al.macros import expand
from handeye.al.names import check_names
from handeye.al.operations import position
from handeye.al.parser import parse_whole
from handeye.al.restores import check_restores
from handeye.al.sights import check_sights
from handeye.al.statements import by_word, used_names
from handeye.al.syntax import Name, Script
from handeye.al.unused import check_unused, with_unused
from handeye.al.vectors import named_vectors, with_vectors
from handeye.diagnostics import LIMIT, Diagnostic, Label, arranged, has_errors
from handeye.plan.program import Program
from handeye.plan.taught import Taught
from handeye.source import Source, Span


def compile_text(source: Source, taught: Taught) -> tuple[Program | None, list[Diagnostic]]:
    """The program of a text in the arm language, and what there is to say about it; spans are of the whole.

    What the text requires is in `source.required`, where `sewing.sewn` puts it. The program has the taught positions
    and parts in it, and those the text adds. There is none if any diagnostic is an error. Diagnostics are sorted by
    position, at most `diagnostics.LIMIT`.
    """
    script, found = parse_whole(source)
    if any(d.code in MISSING for d in found):
        return None, arranged(d for d in found if d.code != "unknown-instruction")
    if sum(d.severity == "error" for d in found) >= LIMIT:
        return None, arranged(found)
    words = by_word(script)
    used = used_names(words)
    found += check_names(script, words, used, taught)
    vectors = named_vectors(words)
    placed = expand(with_vectors(script, vectors), found.append)
    lowered = lower(placed, source, found.append, inner=_inner_labels(script))
    found = _without_lost_labels(source, found)
    if not lowered.steps and not has_errors(found):
        found.append(_empty())
    if has_errors(found):  # what follows would tell a mistake twice, as what it leads to
        return None, arranged(found)
    written = dict(map(position, words.get("TRANS", ())))
    graph = Graph(lowered.steps)
    found += check_flow(graph, lowered.origins)
    found += faint(words, vectors)
    found += check_sights(words, taught)
    found += check_layout(script, source)
    found += check_restores(lowered, graph)
    lost = {_line(source, d) for d in found if d.code == "unreachable-code"}
    unused = [
        d for d in check_unused(script, words, used) if _line(source, d) not in lost and _is_for_us(source, d)
    ]
    found = with_unused(found, unused)
    if "HERE" in words:
        found += check_here(placed, {*taught.positions, *written})
    if has_errors(found):
        return None, arranged(found)
    program = Program(
        name=PurePath(source.name).stem,
        language="wave",
        source=source.text,
        stages=lowered.stages,
        steps=lowered.steps,
        positions={**taught.positions, **written},
        parts=dict(taught.parts),
        fixtures=dict(taught.fixtures),
        held=dict(taught.held),
        required={text.key: text.text for text in source.required},
    )
    return program, arranged(found)


def _inner_labels(script: Script) -> dict[str, Name]:
    """The labels of macros, called or not."""
    bodies = (macro.body for macro in script.macros.values())
    return {label.text: label for body in bodies for statement in body for label in statement.labels}


def _without_lost_labels(source: Source, found: list[Diagnostic]) -> list[Diagnostic]:
    """A label without its colon is one mistake, and not another one at every jump to it; nor is one that stands
    where another name should."""
    lost = [d for d in found if d.code == "unknown-label"]
    if not lost:
        return found
    unknown = {_word(source, d) for d in found if d.code == "unknown-instruction"}
    wrong = [d.primary.span for d in found if d.code == "wrong-operand"]
    said = [
        d
        for d in lost
        if _word(source, d) in unknown or any(s.start <= d.primary.span.start < s.end for s in wrong)
    ]
    return [d for d in found if d not in said]


def _word(source: Source, diagnostic: Diagnostic) -> str:
    """What a diagnostic marks."""
    span = diagnostic.primary.span
    text, start = source.find(span.start)
    return text.text[start : start + span.end - span.start]


def _line(source: Source, diagnostic: Diagnostic) -> tuple[str, int]:
    """The text a diagnostic is about, and the line in it."""
    text, offset = source.find(diagnostic.primary.span.start)
    return text.key, text.position(offset)[0]


def _is_for_us(source: Source, unused: Diagnostic) -> bool:
    """A required file may make things for other scripts; what it jumps to is its own."""
    return unused.code == "unused-label" or not _line(source, unused)[0]


def _empty() -> Diagnostic:
    message = "the program has no instruction to carry out"
    return Diagnostic(code="empty-program", message=message, primary=Label(span=Span(start=0, end=0)))
