"""Text in, checked program out."""

from pathlib import PurePath

from handeye.al.flow import check_flow
from handeye.al.lower import lower
from handeye.al.macros import expand
from handeye.al.names import all_statements, check_names
from handeye.al.operations import position
from handeye.al.parser import parse
from handeye.al.unused import check_unused
from handeye.al.vectors import with_vectors
from handeye.diagnostics import LIMIT, Diagnostic, Label, arranged, has_errors
from handeye.plan.program import Program
from handeye.plan.taught import Taught
from handeye.source import Source, Span


def compile_text(source: Source, taught: Taught) -> tuple[Program | None, list[Diagnostic]]:
    """The program of a text in the arm language, and what there is to say about it.

    The program has the taught positions and parts in it, and those the text adds. There is none if any
    diagnostic is an error. Diagnostics are sorted by position, at most `diagnostics.LIMIT`.
    """
    script, found = parse(source.text)
    if len(found) >= LIMIT:
        return None, arranged(found)
    found += check_names(script, taught)
    lowered = lower(expand(with_vectors(script), found.append), source.text, found.append)
    if not lowered.steps and not has_errors(found):
        found.append(_empty())
    if not has_errors(found):  # else a mistake would be told twice, as what it leads to
        found += check_flow(lowered.steps, lowered.origins)
        lost = {source.position(d.primary.span.start)[0] for d in found if d.code == "unreachable-code"}
        found += [d for d in check_unused(script) if source.position(d.primary.span.start)[0] not in lost]
    if has_errors(found):
        return None, arranged(found)
    written = [s for s in all_statements(script) if s.word is not None and s.word.text == "TRANS"]
    program = Program(
        name=PurePath(source.name).stem,
        language="wave",
        source=source.text,
        stages=lowered.stages,
        steps=lowered.steps,
        positions={**taught.positions, **dict(map(position, written))},
        parts=dict(taught.parts),
        fixtures=dict(taught.fixtures),
        held=dict(taught.held),
    )
    return program, arranged(found)


def _empty() -> Diagnostic:
    message = "the program has no instruction to carry out"
    return Diagnostic(code="empty-program", message=message, primary=Label(span=Span(start=0, end=0)))
