"""Checks of names: each must refer to an existing position, part, picture, saved difference or error number."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from handeye.al.definition import AXES, NIL, Refers
from handeye.al.hints import no_units
from handeye.al.instructions import INSTRUCTIONS, SKIPS
from handeye.al.parameters import across, uses
from handeye.al.statements import ByWord, Used, pairs
from handeye.al.syntax import Name, Number, Statement
from handeye.core.diagnostics import LIMIT, Diagnostic, Label, alternatives, names_sentence, problem, quoted
from handeye.core.errors import ERRORS
from handeye.program.taught import Taught

_BUILT_IN_VECTORS = {**dict.fromkeys(AXES, "is an axis of the table"), NIL: "is not a vector"}
_MESSAGES = {
    Refers.POSITION: "position {} is not in the taught file, and no `TRANS` defines it",
    Refers.PART: "there is no part {}",
    Refers.TARGET: "{} is neither a position nor a part",
    Refers.PICTURE: "no `LOOK` takes a picture {}",
    Refers.VECTOR: "there is no vector {}",
    Refers.COUNTER: "no `ASSIGN` sets a counter {}",
    Refers.SAVED: "no `SAVE` saves a difference {}",
}
_DECLARING = ("TRANS", "HERE", "LOOK", "VECT", "ASSIGN", "SAVE")


def check_names(
    statements: Sequence[Statement], words: ByWord, used: Used, taught: Taught
) -> list[Diagnostic]:
    """Check names, including the names in macros. Returns a diagnostic for each name that is unknown or defined
    twice.
    """
    declared = {
        op: [name for s in words.get(op, ()) if s.operands and isinstance(name := s.operands[0], Name)]
        for op in _DECLARING
    }
    known = _known(declared, taught)
    unknown = [
        (name, refers) for refers, there in known.items() for name in used[refers] if name.text not in there
    ]
    swapped = list(_swapped(statements, known)) if unknown else []
    marked = [d.primary.span for d in swapped]
    unknown = [use for use in unknown if not any(mark.start <= use[0].start < mark.end for mark in marked)]
    unknown.sort(key=lambda use: use[0].span)
    # Finding similar names takes time, so it is done only for the diagnostics that will be shown.
    errors = [u for u in unknown if u[1] is not Refers.SAVED][:LIMIT]
    warnings = [u for u in unknown if u[1] is Refers.SAVED][:LIMIT]
    found = [_unknown(name, refers, known) for name, refers in errors + warnings]
    found += swapped
    found += [
        _unknown_error(number)
        for test in SKIPS
        for statement in words.get(test, ())
        for number in statement.operands
        if isinstance(number, Number) and int(number.value) not in ERRORS
    ]
    found += _twice("position", declared["TRANS"], dict.fromkeys(taught.positions, "is taught"))
    return [*found, *_twice("vector", declared["VECT"], _BUILT_IN_VECTORS)]


def _swapped(statements: Sequence[Statement], known: dict[Refers, set[str]]) -> Iterator[Diagnostic]:
    """Report pairs of operands that would be valid in the other order."""
    labels = {label.text for statement in statements for label in statement.labels}
    known = {**known, Refers.LABEL: labels}
    for statement in statements:
        named = [(o.refers, v) for o, v in pairs(statement) if isinstance(v, Name) and o.refers in known]
        for (first, a), (second, b) in pairwise(named):
            right = a.text in known[first] or b.text in known[second]
            if right or a.text not in known[second] or b.text not in known[first]:
                continue
            assert statement.word is not None
            op = statement.word.text
            message = (
                f"{quoted(a.text)} is a {second.value} and {quoted(b.text)} a {first.value}, but `{op}` takes them in "
                "the other order"
            )
            help = f"usage: `{INSTRUCTIONS[op].usage}`"
            yield problem("wrong-operand", message, across(a, b), *uses(a), help=help)


def _known(declared: dict[str, list[Name]], taught: Taught) -> dict[Refers, set[str]]:
    by = {op: {name.text for name in names} for op, names in declared.items()}
    positions = by["TRANS"] | by["HERE"] | set(taught.positions)
    return {
        Refers.POSITION: positions,
        Refers.PART: set(taught.parts),
        Refers.TARGET: positions | set(taught.parts),
        Refers.PICTURE: by["LOOK"],
        Refers.VECTOR: by["VECT"] | set(AXES),
        Refers.COUNTER: by["ASSIGN"],
        Refers.SAVED: by["SAVE"],
    }


def _twice(what: str, names: list[Name], taken: Mapping[str, str]) -> Iterator[Diagnostic]:
    """Report names that are defined again. `taken` gives, for each name that is not free, the reason why it is not
    free.
    """
    first: dict[str, Name] = {}
    for name in names:
        before, why = first.setdefault(name.text, name), taken.get(name.text)
        if why is not None or before is not name:
            yield problem(
                f"{what}-twice",
                f"{what} {quoted(name.text)} is defined twice",
                name.span,
                *(() if why else (Label(span=before.span, text="first defined here"),)),
                notes=(f"{quoted(name.text)} {why}",) if why else (),
            )


def _unknown(name: Name, refers: Refers, known: dict[Refers, set[str]]) -> Diagnostic:
    unit_help = no_units(name.text) if refers is Refers.VECTOR else None
    if unit_help is not None:
        message = f"write a number without the unit {quoted(name.text)}"
        return problem("unit-written", message, name.span, *uses(name), help=unit_help)
    message = _MESSAGES[refers].format(quoted(name.text))
    code = "never-saved" if refers is Refers.SAVED else f"unknown-{refers.name.lower()}"
    meant = alternatives(name.text, known[refers])
    help = names_sentence(meant)
    other = next((kind for kind, names in known.items() if name.text in names), None)
    if other is not None and refers is Refers.SAVED:
        help, meant = f"{quoted(name.text)} is a {other.value}, not a saved difference", None
    elif other is not None:
        message = f"{quoted(name.text)} is a {other.value}, not a {refers.value}"
    return problem(code, message, name.span, *uses(name), help=help, meant=meant)


def _unknown_error(number: Number) -> Diagnostic:
    return problem(
        "unknown-error-number",
        f"no instruction raises error {int(number.value)}",
        number.span,
        *uses(number),
        help="errors: " + ", ".join(map(str, sorted(ERRORS))),
    )
