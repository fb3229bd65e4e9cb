"""Writes a proof in words: a paragraph for each finding that the program shows to hold, and a diagnostic for each
finding that it does not.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import Final

from handeye.core.diagnostics import Diagnostic, Label, problem
from handeye.core.plain_text import counted
from handeye.core.source import Source, Span, line_name
from handeye.program.program import Program, Step
from handeye.proof.proof import ClaimProof, FindingProof, Proof, WayStep

MOST_RUNS: Final = 10  # runs of lines of a path that a message shows
GAP: Final = 4  # lines: a run of lines may contain comments and modifiers


def argument(proof: Proof, program: Program) -> Iterator[str]:
    """Yield the paragraphs of an argument, with blank lines between them."""
    yield _summary(proof)
    for finding in proof.findings:
        if proof.verdict(finding) == "shown":
            yield ""
            yield _paragraph(proof, finding, program)
    unnoticed = [finding for finding in proof.findings if not finding.claims]
    if unnoticed:
        yield ""
        yield "A program need not show that these findings hold:"
        for rests, some in groupby(unnoticed, key=lambda finding: finding.rests):
            yield f"  {_listed([finding.finding for finding in some])}: {rests}"
    if any(finding.claims for finding in proof.findings):
        yield ""
        yield _RESTS


_RESTS: Final = (
    "The argument assumes that the senses work, that the limits are right, and that RESTORE and the searches shift "
    "a position by the right amount. A call to the operator counts as a stop, and so does an error that no step "
    "tests. The proof does not follow the answers of the operator."
)


def _summary(proof: Proof) -> str:
    verdicts = [proof.verdict(finding) for finding in proof.findings]
    if not proof.ends:
        return f"{proof.program}: no path leads to the end of the program"
    parts = [f"every path to the end shows {counted(verdicts.count('shown'), 'finding')} of the referee"]
    if count := verdicts.count("avoided"):
        parts.append(f"{counted(count, 'finding')} can remain unnoticed")
    if count := verdicts.count("undecided"):
        parts.append(f"{counted(count, 'finding')} cannot be decided")
    parts.append(f"no program is asked to show {counted(verdicts.count(None), 'finding')}")
    return f"{proof.program}: {'; '.join(parts)}"


def _paragraph(proof: Proof, finding: FindingProof, program: Program) -> str:
    claims = [proof.claims[number] for number in finding.claims]
    said = []
    for says, some in groupby(claims, key=lambda claim: claim.says):
        group = list(some)
        lines = list(dict.fromkeys(_passed(claim, program) for claim in group))
        passed = f"Every path passes {_listed(lines)}." if any(lines) else "No step undoes this."
        said.append(f"{said_of(says, group)}. {passed}")
    return f"{finding.finding}: {' '.join([said[0], *map(_capital, said[1:])])} {finding.rests}"


def said_of(says: str, claims: Sequence[ClaimProof]) -> str:
    """Return one clause that states several claims. The claims differ only in their places."""
    places = [claim.where for claim in claims if claim.where]
    first = {place.split(" ")[0] for place in places}
    if len(places) > 1 and len(first) == 1 and all(place.count(" ") == 1 for place in places):
        places = [f"{first.pop()}s {_listed([place.split(' ')[1] for place in places])}"]
    return f"{says} ({'; '.join(places)})" if places else says


def _passed(claim: ClaimProof, program: Program) -> str:
    """Describe, phase by phase, the lines of the program that show that a claim is true. Every path passes one of the
    lines of each phase.
    """
    said = []
    for step, steps in zip(claim.passed, claim.phases, strict=True):
        lines = list(dict.fromkeys(_line(program, number) for number in (steps if step is None else [step])))
        said.append(f"one of {_listed(lines)}" if len(lines) > 1 else "".join(lines))
    return ", then ".join(said)


def _line(program: Program, number: int) -> str:
    """Describe a step: its line, its word, the macro that its stage calls, and what happens if its action raises an
    error.
    """
    step = program.steps[number]
    behind = None if step.next is None else program.steps[step.next].operation
    tested = behind is not None and behind.branch is not None and behind.branch.error is not None
    notes = [f"in {step.called}"] if step.macro else []
    if step.operation.raising:
        notes.append("tested" if tested else "an error stops the arm")
    return f"line {step.place} {step.word}" + (f" ({', '.join(notes)})" if notes else "")


def _listed(items: Sequence[str]) -> str:
    return " and ".join([", ".join(items[:-1]), items[-1]] if len(items) > 1 else items)


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def unproved(proof: Proof, program: Program) -> list[Diagnostic]:
    """Return a diagnostic for each finding that is not proved: on some path to the end, the program does not show that
    the finding holds.
    """
    source = program.whole
    if not proof.ends:
        span = _span(source, program.steps[-1]) if program.steps else Span(start=0, end=0)
        return [problem("finding-undecided", "no path leads to the end of the program", span)]
    found = []
    for finding in proof.findings:
        verdict = proof.verdict(finding)
        if verdict in ("avoided", "undecided"):
            claims = [proof.claims[n] for n in finding.claims if proof.claims[n].verdict == verdict]
            make = _avoided if verdict == "avoided" else _undecided
            found.append(make(finding, claims, program, source))
    return found


def _avoided(
    finding: FindingProof, claims: Sequence[ClaimProof], program: Program, source: Source
) -> Diagnostic:
    first = claims[0]
    steps = [program.steps[each.step] for each in first.way]
    at = first.leaves if first.leaves is not None else len(steps) - 1
    text = (
        "the program can end here"
        if first.leaves is None
        else "after this line, the path below cannot reach a step that shows the claim"
    )
    since = max((index for index in (first.leaves, first.undone) if index is not None), default=0)
    marks = []
    if first.undone is not None:
        marks.append(
            Label(span=_span(source, steps[first.undone]), text="after this, the claim must be shown again")
        )
    nowhere = not all(first.phases)
    says = "no step of the program shows" if nowhere else "a path to the end does not show"
    message = (
        f"the program can end without noticing that `{finding.finding}` does not hold: {says} that "
        f"{said_of(first.says, [claim for claim in claims if claim.says == first.says])}"
    )
    way = "the whole program" if nowhere else _way_text(first.way[since:], program)
    return problem(
        "finding-unnoticed",
        message,
        _span(source, steps[at]),
        *marks,
        text=text,
        notes=(f"the path: {way}",),
    )


def _undecided(
    finding: FindingProof, claims: Sequence[ClaimProof], program: Program, source: Source
) -> Diagnostic:
    first = claims[0]
    says = said_of(first.says, [first])
    silent = f"the program can end without noticing that `{finding.finding}` does not hold"
    undecided = f"it cannot be decided whether {silent}"
    if first.too_many:
        span = _span(source, program.steps[-1])
        message = f"{undecided}: the counters have too many values"
        return problem("finding-undecided", message, span, notes=(f"not decided: {says}",))
    unknown = [program.steps[number] for number in first.unknown]
    message = (
        f"it cannot be decided whether every path shows `{finding.finding}`: the program does not fix a place on "
        "the path"
    )
    return problem(
        "finding-undecided", message, _span(source, unknown[0]), text="where is the hand here?",
        notes=(f"not decided: {says}", f"the lines in question: {_listed([step.place for step in unknown])}"),
    )  # fmt: skip


def _way_text(way: Sequence[WayStep], program: Program) -> str:
    shown = _runs(program.steps[each.step] for each in way)
    if len(shown) > MOST_RUNS:
        shown = [*shown[: MOST_RUNS // 2], "…", *shown[-(MOST_RUNS // 2) :]]
    return f"lines {', '.join(shown)}, the end"


def _runs(steps: Iterable[Step]) -> list[str]:
    """Write the line numbers of the given steps. Lines that are close together are joined into a range."""
    runs: list[tuple[str, int, int]] = []
    for step in steps:
        if runs and runs[-1][0] == step.file and 0 <= step.line - runs[-1][2] <= GAP:
            runs[-1] = (step.file, runs[-1][1], step.line)
        else:
            runs.append((step.file, step.line, step.line))
    return [
        line_name(first, file) if first == last else f"{line_name(first, file)}-{last}"
        for file, first, last in runs
    ]


def _span(source: Source, step: Step) -> Span:
    """Return the span of a step in the combined text."""
    text = next(text for text in source.texts if text.key == step.file)
    begin = source.begins[step.file] + sum(len(line) + 1 for line in text.text.split("\n")[: step.line - 1])
    first, last = step.span
    return Span(start=begin + first, end=begin + last)
