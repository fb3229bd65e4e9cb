"""Every name must be the name of something: positions, parts, pictures, saved differences, error numbers."""

from collections.abc import Iterator

from handeye.al.definition import NIL, Operand, Refers
from handeye.al.instructions import AXES, ERROR, INSTRUCTIONS
from handeye.al.syntax import Name, Number, Script, Statement, Value
from handeye.diagnostics import LIMIT, Diagnostic, Label, quoted, suggestion
from handeye.errors import ERRORS
from handeye.plan.taught import Taught

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


def check_names(script: Script, taught: Taught) -> list[Diagnostic]:
    """What is named in a script, its macros included, and is not there, or is there twice."""
    statements = list(all_statements(script))
    known = _known(statements, taught)
    unknown = [(name, refers) for name, refers in _references(statements) if name.text not in known[refers]]
    # Looking for what was meant takes time: only for those that will be shown.
    errors = [u for u in unknown if u[1] is not Refers.SAVED][:LIMIT]
    warnings = [u for u in unknown if u[1] is Refers.SAVED][:LIMIT]
    found = [_unknown(name, refers, known[refers]) for name, refers in errors + warnings]
    return found + _error_numbers(statements) + _twice(statements, taught) + _vectors_twice(statements)


def _references(statements: list[Statement]) -> Iterator[tuple[Name, Refers]]:
    """Every use of a name, in the order of the texts."""
    for statement in sorted(statements, key=lambda s: s.span):
        for operand, value in pairs(statement):
            if isinstance(value, Name) and operand.refers in _CODES:
                yield value, operand.refers
        if statement.word is not None and statement.word.text == "PARK":
            yield statement.word, Refers.POSITION


def _error_numbers(statements: list[Statement]) -> list[Diagnostic]:
    return [
        _unknown_error(value)
        for statement in statements
        for operand, value in pairs(statement)
        if isinstance(value, Number) and operand is ERROR and int(value.value) not in ERRORS
    ]


def all_statements(script: Script) -> Iterator[Statement]:
    """The statements of a script and of its macros."""
    yield from script.statements
    for macro in script.macros.values():
        yield from macro.body


def pairs(statement: Statement) -> Iterator[tuple[Operand, Value | None]]:
    """The operands of an instruction with their definitions; none for a macro or a broken statement."""
    if statement.word is not None and statement.operands and not statement.broken:
        yield from zip(INSTRUCTIONS[statement.word.text].operands, statement.operands, strict=True)


def _declared(statements: list[Statement], op: str) -> list[Name]:
    return [
        s.operands[0]
        for s in statements
        if s.word is not None and s.word.text == op and s.operands and isinstance(s.operands[0], Name)
    ]


def written_names(script: Script) -> set[str]:
    """Positions that a script writes, its macros included."""
    return {name.text for name in _declared(list(all_statements(script)), "TRANS")}


def _known(statements: list[Statement], taught: Taught) -> dict[Refers, set[str]]:
    defined = [name.text for op in ("TRANS", "HERE") for name in _declared(statements, op)]
    positions = {*defined, *taught.positions}
    return {
        Refers.POSITION: positions,
        Refers.PART: set(taught.parts),
        Refers.TARGET: positions | set(taught.parts),
        Refers.PICTURE: {name.text for name in _declared(statements, "LOOK")},
        Refers.VECTOR: {name.text for name in _declared(statements, "VECT")} | set(AXES),
        Refers.COUNTER: {name.text for name in _declared(statements, "ASSIGN")},
        Refers.SAVED: {name.text for name in _declared(statements, "SAVE")},
    }


def _twice(statements: list[Statement], taught: Taught) -> list[Diagnostic]:
    found = []
    first: dict[str, Name] = {}
    for name in _declared(statements, "TRANS"):
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


def _vectors_twice(statements: list[Statement]) -> list[Diagnostic]:
    found = []
    first: dict[str, Name] = {}
    for name in _declared(statements, "VECT"):
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


def _unknown(name: Name, refers: Refers, known: set[str]) -> Diagnostic:
    return Diagnostic(
        code=_CODES[refers],
        message=_MESSAGES[refers].format(quoted(name.text)),
        primary=Label(span=name.span),
        help=suggestion(name.text, known),
    )


def _unknown_error(number: Number) -> Diagnostic:
    return Diagnostic(
        code="unknown-error-number",
        message=f"nothing raises error {int(number.value)}",
        primary=Label(span=number.span),
        help="errors: " + ", ".join(map(str, sorted(ERRORS))),
    )
