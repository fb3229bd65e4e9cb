"""Every name must be the name of something: positions, parts, pictures, saved differences, error numbers."""

from collections.abc import Iterable, Iterator
from itertools import pairwise

from handeye.al.definition import NIL, Operand, Refers, Role
from handeye.al.instructions import AXES, INSTRUCTIONS
from handeye.al.syntax import Name, Number, Script, Statement, Value
from handeye.al.unitwords import no_units
from handeye.diagnostics import LIMIT, Diagnostic, Label, quoted, suggestion
from handeye.errors import ERRORS
from handeye.plan.taught import Taught
from handeye.source import Span

_CODES = {
    Refers.POSITION: "unknown-position",
    Refers.PART: "unknown-part",
    Refers.TARGET: "unknown-target",
    Refers.PICTURE: "unknown-picture",
    Refers.VECTOR: "unknown-vector",
    Refers.COUNTER: "unknown-counter",
    Refers.SAVED: "never-saved",
}
_RESERVED = {**dict.fromkeys(AXES, "is an axis of the table"), NIL: "stands for no vector"}
"""Names of vectors that are there already."""
_MESSAGES = {
    Refers.POSITION: "position {} is neither taught nor written with `TRANS`",
    Refers.PART: "there is no part {}",
    Refers.TARGET: "{} is neither a position nor a part",
    Refers.PICTURE: "no `LOOK` takes a picture {}",
    Refers.VECTOR: "there is no vector {}",
    Refers.COUNTER: "no `ASSIGN` sets a counter {}",
    Refers.SAVED: "no `SAVE` keeps a difference {}: the goal is not shifted",
}
_TESTS = {instruction.op for instruction in INSTRUCTIONS.values() if instruction.role is Role.SKIP}
_NAMED = {
    i.op: [(place, operand.refers) for place, operand in enumerate(i.operands) if Name in operand.takes]
    for i in INSTRUCTIONS.values()
}
"""Operands that may be names, by their places."""


def check_names(script: Script, taught: Taught) -> list[Diagnostic]:
    """What is named in a script, its macros included, and is not there, or is there twice."""
    statements = list(all_statements(script))
    declared = _declared(statements)
    known = _known(declared, taught)
    unknown = [
        (name, refers)
        for name, refers in uses(statements)
        if (there := known.get(refers)) is not None and name.text not in there
    ]
    swapped = list(_swapped(statements, {**known, Refers.LABEL: _labels(statements)})) if unknown else []
    marked = [d.primary.span for d in swapped]
    unknown = [use for use in unknown if not any(mark.start <= use[0].start < mark.end for mark in marked)]
    unknown.sort(key=lambda use: use[0].span)
    # Looking for what was meant takes time: only for those that will be shown.
    errors = [u for u in unknown if u[1] is not Refers.SAVED][:LIMIT]
    warnings = [u for u in unknown if u[1] is Refers.SAVED][:LIMIT]
    found = [_unknown(name, refers, known) for name, refers in errors + warnings]
    found += swapped
    found += _error_numbers(statements)
    return found + _twice(declared.get("TRANS", []), taught) + _vectors_twice(declared.get("VECT", []))


def uses(statements: Iterable[Statement]) -> Iterator[tuple[Name, Refers]]:
    """Every name that stands for something, and for what."""
    for statement in statements:
        word = statement.word
        if word is None:
            continue
        for place, refers in _NAMED.get(word.text, ()) if not statement.broken else ():
            value = statement.operands[place]
            if isinstance(value, Name):
                yield value, refers
        if word.text == "PARK":
            yield word, Refers.POSITION


def _swapped(statements: list[Statement], known: dict[Refers, set[str]]) -> Iterator[Diagnostic]:
    """Two names of an instruction that would be right the other way round."""
    for statement in statements:
        named = [(o.refers, v) for o, v in pairs(statement) if isinstance(v, Name) and o.refers in known]
        for (first, a), (second, b) in pairwise(named):
            right = a.text in known[first] or b.text in known[second]
            if right or a.text not in known[second] or b.text not in known[first]:
                continue
            assert statement.word is not None
            op = statement.word.text
            yield Diagnostic(
                code="wrong-operand",
                message=f"{quoted(a.text)} is a {second.value} and {quoted(b.text)} a {first.value}: "
                f"`{op}` takes them the other way round",
                primary=Label(span=Span(start=a.start, end=b.end)),
                help=f"usage: `{INSTRUCTIONS[op].usage}`",
            )


def _labels(statements: list[Statement]) -> set[str]:
    return {label.text for statement in statements for label in statement.labels}


def _error_numbers(statements: list[Statement]) -> list[Diagnostic]:
    return [
        _unknown_error(number)
        for statement in statements
        if statement.word is not None and statement.word.text in _TESTS
        for number in statement.operands
        if isinstance(number, Number) and int(number.value) not in ERRORS
    ]


def all_statements(script: Script) -> Iterator[Statement]:
    """The statements of a script and of its macros."""
    yield from script.statements
    for macro in script.macros.values():
        yield from macro.body


def pairs(statement: Statement) -> Iterable[tuple[Operand, Value | None]]:
    """The operands of an instruction with their definitions; none for a macro or a broken statement."""
    if statement.word is None or statement.broken or not statement.operands:
        return ()
    return zip(INSTRUCTIONS[statement.word.text].operands, statement.operands, strict=True)


def _declared(statements: list[Statement]) -> dict[str, list[Name]]:
    """Names that stand first in a statement, by its instruction."""
    found: dict[str, list[Name]] = {}
    for statement in statements:
        if statement.word is not None and statement.operands and isinstance(statement.operands[0], Name):
            found.setdefault(statement.word.text, []).append(statement.operands[0])
    return found


def written_names(script: Script) -> set[str]:
    """Positions that a script writes, its macros included."""
    return {name.text for name in _declared(list(all_statements(script))).get("TRANS", [])}


def _known(declared: dict[str, list[Name]], taught: Taught) -> dict[Refers, set[str]]:
    ops = ("TRANS", "HERE", "LOOK", "VECT", "ASSIGN", "SAVE")
    by = {op: {name.text for name in declared.get(op, [])} for op in ops}
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


def _twice(names: list[Name], taught: Taught) -> list[Diagnostic]:
    found = []
    first: dict[str, Name] = {}
    for name in names:
        before = first.setdefault(name.text, name)
        notes: tuple[str, ...] = ()
        secondary: tuple[Label, ...] = ()
        if name.text in taught.positions:
            notes = (f"{quoted(name.text)} is taught",)
        elif before is not name:
            secondary = (Label(span=before.span, text="first written here"),)
        else:
            continue
        found.append(
            Diagnostic(
                code="position-twice",
                message=f"position {quoted(name.text)} is defined twice",
                primary=Label(span=name.span),
                secondary=secondary,
                notes=notes,
            )
        )
    return found


def _vectors_twice(names: list[Name]) -> list[Diagnostic]:
    found = []
    first: dict[str, Name] = {}
    for name in names:
        before = first.setdefault(name.text, name)
        taken = _RESERVED.get(name.text)
        if taken is not None or before is not name:
            found.append(
                Diagnostic(
                    code="vector-twice",
                    message=f"vector {quoted(name.text)} is defined twice",
                    primary=Label(span=name.span),
                    secondary=() if taken else (Label(span=before.span, text="first written here"),),
                    notes=(f"{quoted(name.text)} {taken}",) if taken else (),
                )
            )
    return found


def _unknown(name: Name, refers: Refers, known: dict[Refers, set[str]]) -> Diagnostic:
    said = no_units(name.text) if refers is Refers.VECTOR else None
    if said is not None:
        message = f"{quoted(name.text)} is written behind a number"
        return Diagnostic(code="unit-written", message=message, primary=Label(span=name.span), help=said)
    message = _MESSAGES[refers].format(quoted(name.text))
    help = suggestion(name.text, known[refers])
    other = next((kind for kind, names in known.items() if name.text in names), None)
    if other is not None and refers is Refers.SAVED:
        help = f"{quoted(name.text)} is a {other.value}; `SAVE` keeps a difference"
    elif other is not None:
        message = f"{quoted(name.text)} is a {other.value}, and a {refers.value} is wanted here"
    return Diagnostic(code=_CODES[refers], message=message, primary=Label(span=name.span), help=help)


def _unknown_error(number: Number) -> Diagnostic:
    return Diagnostic(
        code="unknown-error-number",
        message=f"nothing raises error {int(number.value)}",
        primary=Label(span=number.span),
        help="errors: " + ", ".join(map(str, sorted(ERRORS))),
    )
