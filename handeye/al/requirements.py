"""Which text a REQUIRE reads, or why it reads none."""

from dataclasses import dataclass, field

from handeye.al.includes import MOST, key_of, own_key
from handeye.al.syntax import Text
from handeye.core.diagnostics import Diagnostic, Label, quoted
from handeye.core.source import LARGEST, Source, Span

_SHOWN = 6
"""Files of a circle that are named."""


@dataclass(slots=True)
class Requirements:
    """Files that a text requires, as one REQUIRE after the other is met."""

    source: Source
    texts: dict[str, Source] = field(init=False)
    """Texts that can be read, by their keys."""
    reading: list[str] = field(init=False)
    """Keys of the texts that are being read, each required by the one before."""
    first: dict[str, Span] = field(default_factory=dict)
    """Where each text was required first."""
    missing: bool = False
    """It has been said that something required is not there."""

    def __post_init__(self) -> None:
        self.texts = {text.key: text for text in self.source.required}
        self.reading = [own_key(self.source)]

    def find(self, file: Text) -> Source | Diagnostic | None:
        """The text that is to be read now; None if it need not be said that there is too much."""
        key = key_of(file.text, self.reading[-1])
        found = self.texts.get(key)
        if key.lower().endswith(".toml"):
            help = "handeye reads the taught file with the script's name by itself; remove this line"
            message = f"{quoted(file.text)} is a taught file, not a file of instructions"
            return _problem("unreadable-file", message, file, help=help)
        if key in self.reading:
            return self._circle(key, file)
        if key in self.first:
            message = f"{quoted(file.text)} is already included: this line does nothing"
            first = Label(span=self.first[key], text="it is read here")
            return _problem("required-twice", message, file, first)
        deep = len(self.reading) > MOST  # a text that was not sewn here
        if found is not None and not found.problem and not deep:
            self.first[key] = file.span
            return found
        told, self.missing = self.missing, True
        if deep or (found is None and self.texts):
            message = f"more than {MOST} files, or {LARGEST} characters in all, are required"
            return None if told else _problem("too-much-required", message, file)
        message = f"{quoted(file.text)} cannot be read"
        if found is not None:
            return _problem("unreadable-file", message, file, notes=(found.problem,))
        help = "paths are relative to the file that requires them: save this text as a file"
        return _problem("unreadable-file", message, file, notes=("this text is not in a file",), help=help)

    def _circle(self, key: str, file: Text) -> Diagnostic:
        around = [*self.reading[self.reading.index(key) :], key]
        if len(around) > _SHOWN:
            around[_SHOWN // 2 : -_SHOWN // 2] = ["…"]
        first, *others = (name if name == "…" else quoted(name) for name in around)
        notes = (f"{first} requires {', which requires '.join(others)}",) if len(others) > 1 else ()
        return _problem("require-circle", f"{quoted(key)} requires itself", file, notes=notes)


def _problem(
    code: str,
    message: str,
    file: Text,
    *secondary: Label,
    notes: tuple[str, ...] = (),
    help: str | None = None,
) -> Diagnostic:
    primary = Label(span=file.span)
    return Diagnostic(
        code=code, message=message, primary=primary, secondary=secondary, notes=notes, help=help
    )
