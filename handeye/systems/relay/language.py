"""The language service for the files of relays."""

from typing import Final

from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source
from handeye.program.language import OwnLanguage
from handeye.systems.relay import ENTRY
from handeye.systems.relay.reading import NO_LEGS, NO_SYSTEM, REPEATED, UNREADABLE, parsed

_CODES: Final = {
    UNREADABLE: 'a line of a relay has the form STAGE "name of the stage" FILE',
    REPEATED: "two legs run stages that have the same name",
    NO_SYSTEM: "a file with this extension cannot be a leg of a relay",
    NO_LEGS: "a relay has 1 to 100 legs",
}


class RelayLanguage(OwnLanguage):
    """Checks the form of a relay. `handeye relay check` also checks the programs of the relay."""

    system = ENTRY.name

    def check(self, source: Source) -> list[Diagnostic]:
        return parsed(source)[1]

    def explanation(self, word: str) -> str | None:
        return f"error[{word}]: {_CODES[word]}" if word in _CODES else None


LANGUAGE: Final = RelayLanguage()
