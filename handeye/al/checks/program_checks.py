"""All there is to say of a program whose statements are all right."""

from collections.abc import Container, Sequence
from dataclasses import dataclass

from handeye.al.checks.flow import check_flow
from handeye.al.checks.here import check_here
from handeye.al.checks.layout import check_layout
from handeye.al.checks.parameters import check_parameters, unused_parameters
from handeye.al.checks.restores import check_restores
from handeye.al.checks.unused import check_unused, with_unused
from handeye.al.checks.vision_requirements import check_sights
from handeye.al.lower import Lowered
from handeye.al.macros import Placed
from handeye.al.statements import ByWord, Used
from handeye.al.syntax import Script, Statement
from handeye.al.vectors import Vectors
from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source
from handeye.program.graph import Graph
from handeye.program.taught import Taught


@dataclass(frozen=True, slots=True, kw_only=True)
class CompiledScript:
    """A script, and what has been made of it on the way to a program."""

    source: Source
    script: Script
    statements: Sequence[Statement]
    """Those of its macros with parameters as they are called."""
    words: ByWord
    used: Used
    vectors: Vectors
    placed: Sequence[Placed]
    lowered: Lowered


def check_whole(whole: CompiledScript, taught: Taught, positions: Container[str]) -> list[Diagnostic]:
    """Everything that cannot be meant in a script or on a way through it; `positions` are those taught or written."""
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
    """Things written for nothing; not those in lines that are never carried out."""
    lost = {_line(whole.source, d) for d in found if d.code == "unreachable-code"}
    unused = [
        *unused_parameters(whole.script),
        *check_unused(whole.script, whole.statements, whole.words, whole.used, whole.source),
    ]
    return [d for d in unused if _line(whole.source, d) not in lost and _is_for_us(whole.source, d)]


def _line(source: Source, diagnostic: Diagnostic) -> tuple[str, int]:
    """The text a diagnostic is about, and the line in it."""
    text, offset = source.find(diagnostic.primary.span.start)
    return text.key, text.position(offset)[0]


def _is_for_us(source: Source, unused: Diagnostic) -> bool:
    """A required file may make things for other scripts; what it jumps to is its own."""
    return unused.code == "unused-label" or not _line(source, unused)[0]
