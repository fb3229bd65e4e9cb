"""Check that a program can see what it wants to: that enough is taught of parts, and pictures can be compared."""

from collections.abc import Callable, Iterator, Mapping
from typing import Final

from handeye.al.parameters import across
from handeye.al.statements import ByWord
from handeye.al.syntax import Name
from handeye.core.diagnostics import Diagnostic, Label, quoted
from handeye.program.program import Part
from handeye.program.taught import Taught

Need = tuple[str, Callable[[Part], bool]]
"""Something that has to be taught of a part, and the question whether it is."""
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
    """Mistakes in the looks of a script all of whose names are right."""
    for op, needs in _NEEDS.items():
        for statement in words.get(op, ()):
            name = statement.operands[0] if statement.operands else None
            if isinstance(name, Name) and name.text in taught.parts:
                yield from _undescribed(op, name, needs, taught.parts)
    yield from _unlike(words)


def _undescribed(
    op: str, name: Name, needs: tuple[Need, ...], parts: Mapping[str, Part]
) -> Iterator[Diagnostic]:
    lacking = [said for said, has in needs if not has(parts[name.text])]
    if lacking:
        others = [quoted(other) for other, part in parts.items() if all(has(part) for _, has in needs)]
        known = f"; taught in full: {', '.join(others)}" if others else ""
        yield Diagnostic(
            code="part-not-described",
            message=f"`{op}` cannot find {quoted(name.text)} without its {' and '.join(lacking)}",
            primary=Label(span=name.span),
            help=f"add it under `[parts.{name.text}]` in the taught file{known}",
        )


def _unlike(words: ByWord) -> Iterator[Diagnostic]:
    """Comparisons with a picture that the camera took as it saw fit."""
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
            yield Diagnostic(
                code="compared-without-hold",
                message=f"{quoted(before.text)} is taken with `HOLD`, after {quoted(after.text)}",
                primary=Label(span=across(before, after)),
                help="the earlier picture comes first",
            )
        else:
            yield Diagnostic(
                code="compared-without-hold",
                message=f"picture {quoted(after.text)} is taken at a target voltage of its own",
                primary=Label(span=after.span),
                secondary=(
                    Label(span=taken[0][0].span, text="the camera sets its target voltage anew here"),
                ),
                help=f"`LOOK {after.text} HOLD` keeps that of the earlier picture",
            )
