"""Representations (`repr`) that fit on a screen, however large the value is."""

from collections.abc import Iterable, Mapping
from itertools import islice
from typing import Any, Final, TypeVar

import msgspec

_ITEMS: Final = 3  # items of a collection that are shown
_TEXT: Final = 100  # characters of a text, or of a value that is not a record
_DEPTH: Final = 3  # records within records
LONGEST: Final = 1200  # characters: fifteen lines of 80


class Brief:
    """Base class of dataclasses with a brief `repr`. Define the dataclass with `repr=False`."""

    __slots__ = ()

    def __repr__(self) -> str:
        return brief(self)


T = TypeVar("T")
K = TypeVar("K")


class Several(tuple[T, ...]):
    """A tuple whose `repr` is brief."""

    __slots__ = ()

    def __repr__(self) -> str:
        return brief(self)


class Named(dict[K, T]):
    """A dictionary whose `repr` is brief."""

    __slots__ = ()

    def __repr__(self) -> str:
        return brief(self)


def brief(value: object) -> str:
    """Write a short `repr` of a value: the fields of a record, the first items of a collection, or the shape of an
    array.
    """
    return _cut(_shown(value, _DEPTH), LONGEST)


def _shown(value: Any, depth: int) -> str:
    if hasattr(value, "dtype") and value.ndim:
        return f"<array {' x '.join(map(str, value.shape))}>"
    if isinstance(value, tuple) and not hasattr(value, "_fields"):
        items = _first((_shown(each, depth - 1) for each in value), len(value))
        return f"({items}{',' if len(value) == 1 else ''})"
    if isinstance(value, list):
        return f"[{_first((_shown(each, depth - 1) for each in value), len(value))}]"
    if isinstance(value, Mapping):
        pairs = (f"{key!r}: {_shown(each, depth - 1)}" for key, each in value.items())
        return f"{{{_first(pairs, len(value))}}}"
    names = _fields(type(value))
    if names is None:
        return _cut(repr(value), _TEXT)
    if depth <= 0:
        return f"{type(value).__qualname__}(…)"
    given = ((name, getattr(value, name)) for name in names)
    inside = (f"{name}={_shown(each, depth - 1)}" for name, each in given if each is not msgspec.UNSET)
    return f"{type(value).__qualname__}({', '.join(inside)})"


def _fields(kind: type) -> tuple[str, ...] | None:
    """Return the names of the fields of a record type, or None if the type is not a record or defines its own
    `repr`.
    """
    own: Any = kind.__repr__
    if issubclass(kind, msgspec.Struct):
        return kind.__struct_fields__ if own in (msgspec.Struct.__repr__, Brief.__repr__) else None
    fields: Mapping[str, Any] | None = getattr(kind, "__dataclass_fields__", None)
    if fields is None or not (
        own is Brief.__repr__ or hasattr(own, "__wrapped__")
    ):  # as dataclasses make them
        return None
    return tuple(name for name, field in fields.items() if field.repr)


def _first(items: Iterable[str], count: int) -> str:
    more = [f"… {count - _ITEMS} more"] if count > _ITEMS + 1 else []
    return ", ".join([*islice(items, _ITEMS if more else count), *more])


def _cut(text: str, length: int) -> str:
    half = length // 2
    return text if len(text) <= length else f"{text[:half]} … {text[-half:]}"
