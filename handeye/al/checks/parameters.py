"""Check the parameters of macros: that each is used, and that the texts name no other."""

from collections.abc import Iterator

from handeye.al.parameters import braced_in, parameters_in
from handeye.al.syntax import Macro, Name, Script
from handeye.core.diagnostics import Diagnostic, Label, alternatives, quoted, told_names


def check_parameters(script: Script) -> Iterator[Diagnostic]:
    """A warning for each text of a macro with parameters that names something else in braces."""
    for macro in script.macros.values():
        known = {parameter.text for parameter in macro.parameters}
        for name, span in (found for s in macro.body if known for found in braced_in(s)):
            if name not in known:
                meant = alternatives(name, known)
                message = (
                    f"{quoted(macro.name.text)} has no parameter {quoted(name)}: the text keeps its braces"
                )
                yield Diagnostic(
                    code="unknown-parameter",
                    message=message,
                    primary=Label(span=span),
                    help=told_names(meant),
                )


def unused_parameters(script: Script) -> Iterator[Diagnostic]:
    """A warning for each parameter that no line of its macro has."""
    for macro in script.macros.values():
        used = {name for line in macro.body for name, _ in braced_in(line)}
        used |= {token.text for line in macro.body for token in parameters_in(line)}
        for parameter in macro.parameters:
            if parameter.text not in used:
                yield _unused(macro, parameter)


def _unused(macro: Macro, parameter: Name) -> Diagnostic:
    words = {token.text for line in macro.body for token in line.tokens}
    help = f"in a text it stands in braces: `{{{parameter.text}}}`" if parameter.text in words else None
    return Diagnostic(
        code="unused-parameter",
        message=f"parameter {quoted(parameter.text)} is never used",
        primary=Label(span=parameter.span),
        help=help,
    )
