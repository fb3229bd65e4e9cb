"""Compiles a script to a checked program."""

from pathlib import PurePath
from typing import Final

from msgspec.structs import replace

from handeye.al.checks.names import check_names
from handeye.al.checks.program_checks import CompiledScript, check_whole
from handeye.al.lower import lower
from handeye.al.lower_statement import position
from handeye.al.macros import as_called, expand
from handeye.al.parser import parse_whole
from handeye.al.statements import by_word, named_vectors, used_names, with_vectors
from handeye.core.diagnostics import LIMIT, Diagnostic, arranged, has_errors, problem
from handeye.core.source import Source, Span
from handeye.program.program import Program
from handeye.program.taught import Taught

# Part of the text is missing, so the names that it defines would be reported as unknown.
MISSING: Final = ("unreadable-file", "too-much-required")
_OF_OTHERS: Final = (*MISSING, "require-circle", "required-twice")
LANGUAGE: Final = "wave"  # name of the language in programs and plans: that of the arm program of 1973


def check_form(source: Source) -> list[Diagnostic]:
    """Find the syntax errors of one text. The texts that this text requires are read only to learn the names of their
    macros. The errors of these required texts are not reported.
    """
    found = parse_whole(source)[1]
    lost = ("unknown-instruction",) if any(d.code in MISSING for d in found) else ()
    left_out = {*_OF_OTHERS, *lost}
    return [d for d in found if d.code not in left_out and not source.find(d.primary.span.start)[0].key]


def compile_text(source: Source, taught: Taught) -> tuple[Program | None, list[Diagnostic]]:
    """Compile a text. Returns two values: the program, which is None if one of the diagnostics is an error, and the
    diagnostics.

    The texts that the script requires are in `source.required` (see `includes.sewn`). Spans are offsets in the text
    that `sewn` makes of the script and the required texts. The program contains the taught positions and parts, and
    the positions and parts that the text adds. There are at most `LIMIT` diagnostics, sorted by position.
    """
    script, found = parse_whole(source)
    if any(d.code in MISSING for d in found):
        return None, arranged(d for d in found if d.code != "unknown-instruction")
    if sum(d.severity == "error" for d in found) >= LIMIT:
        return None, arranged(found)
    placed = expand(script, found.append)
    statements = list(as_called(script, placed))
    words = by_word(statements)
    used = used_names(words)
    found += check_names(statements, words, used, taught)
    vectors = named_vectors(words)
    placed = [replace(item, statement=with_vectors(item.statement, vectors)) for item in placed]
    bodies = (macro.body for macro in script.macros.values())
    inner = {label.text: label for body in bodies for statement in body for label in statement.labels}
    lowered = lower(placed, source, found.append, inner=inner)
    found = _without_lost_labels(source, found)
    if not lowered.steps and not has_errors(found):
        nothing = "the program has no instructions"
        found.append(problem("empty-program", nothing, Span(start=0, end=0)))
    if has_errors(found):  # later checks would report the consequences of the same mistakes again
        return None, arranged(found)
    positions = {**taught.positions, **dict(map(position, words.get("TRANS", ())))}
    whole = CompiledScript(
        source=source, script=script, statements=statements, words=words, used=used, vectors=vectors, placed=placed,
        lowered=lowered,
    )  # fmt: skip
    found += check_whole(whole, taught, positions)
    if has_errors(found):
        return None, arranged(found)
    program = Program(
        name=PurePath(source.name).stem,
        language=LANGUAGE,
        source=source.text,
        stages=lowered.stages,
        steps=lowered.steps,
        positions=positions,
        parts=dict(taught.parts),
        fixtures=dict(taught.fixtures),
        held=dict(taught.held),
        required={text.key: text.text for text in source.required},
    )
    return program, arranged(found)


def _without_lost_labels(source: Source, found: list[Diagnostic]) -> list[Diagnostic]:
    """Drop the diagnostic of an unknown label if another mistake explains it: the colon after the label is missing, or
    the operand that names the label is wrong.
    """
    lost = [d for d in found if d.code == "unknown-label"]
    if not lost:
        return found
    unknown = {source.marked(d.primary.span) for d in found if d.code == "unknown-instruction"}
    wrong = [d.primary.span for d in found if d.code == "wrong-operand"]
    dropped = [
        d
        for d in lost
        if source.marked(d.primary.span) in unknown
        or any(s.start <= d.primary.span.start < s.end for s in wrong)
    ]
    return [d for d in found if d not in dropped]
