"""Names of bodies and of parts of the world as people read them."""

import re
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

_CALLED: Final = "called/"
"""Begins the names of the texts in which a scene tells what people call a body, or bodies that are numbered."""


@dataclass(frozen=True)
class Names:
    """The names in a scene."""

    model: Any

    def body(self, number: int) -> str:
        """What people call a body: as the scene tells, or its name in words: `pin 0`."""
        name = self.model.body(number).name
        stem = name.rstrip("0123456789")
        if name in self._called:
            return self._called[name]
        return _words(self._called.get(stem, stem) + name.removeprefix(stem))

    def part(self, shape: int) -> str:
        """What people call a shape of the world: its name without its number, or what it is made of."""
        material = self.model.geom_matid[shape]
        made = self.model.material(material).name if material >= 0 else "something"
        return _words((self.model.geom(shape).name or made).rstrip("0123456789"))

    @cached_property
    def _called(self) -> dict[str, str]:
        model = self.model
        names = [_text(model.names, first) for first in model.name_textadr]
        texts = [_text(model.text_data, first) for first in model.text_adr]
        told = zip(names, texts, strict=True)
        return {name.removeprefix(_CALLED): text for name, text in told if name.startswith(_CALLED)}


def _text(data: bytes, first: int) -> str:
    """The text that begins somewhere among others, each with a zero byte behind it."""
    return data[first : data.index(b"\0", first)].decode()


def _words(name: str) -> str:
    """A name in words: `finger_a` of an arm is its `finger a`."""
    own = name.rpartition("/")[2]
    return re.sub(r"(?<=[a-z])(?=\d)", " ", own).replace("_", " ")
