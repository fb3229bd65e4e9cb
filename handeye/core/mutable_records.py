"""Mutable records: the state of a running system, which can be copied in a snapshot and restored.

A system keeps all its state in one such record. Values that never change belong in a `Record`
(`handeye/core/record.py`). A snapshot copies structures, dictionaries and lists, and shares numbers, texts, tuples,
frozen records and arrays. Arrays in a record must therefore be replaced, not changed in place; a snapshot makes
them read-only.
"""

from copy import copy
from dataclasses import is_dataclass
from functools import cache
from typing import Any, Final, TypeVar

import msgspec
import numpy as np
from msgspec.structs import astuple

from handeye.core.brief import Brief

_PLAIN: Final = frozenset((bool, int, float, str, type(None)))
"""The most frequent types of values. Such values are shared without a further check."""
_SHARED: Final = (bool, int, float, str, bytes, tuple, frozenset, type(None), np.generic)
Kept = TypeVar("Kept", bound="MutableRecord")


class MutableRecord(msgspec.Struct, kw_only=True, forbid_unknown_fields=True):
    """Base class of the states of systems and of their parts. Checkpoints hold copies of these states."""

    __repr__ = Brief.__repr__


def copied(record: Kept) -> Kept:
    """Take a snapshot of a record, independent of later changes. Raises TypeError if a value is mutable, unless its
    type is one of those that the module names.
    """
    twin = copy(record)
    values = astuple(record)
    if not _PLAIN.issuperset(map(type, values)):
        for name, value in zip(record.__struct_fields__, values, strict=True):
            if type(value) not in _PLAIN:
                setattr(twin, name, _copied(value))
    return twin


def put_back(record: Kept, snapshot: Kept) -> None:
    """Restore a record and its parts in place from a snapshot."""
    for name in record.__struct_fields__:
        here, kept = getattr(record, name), getattr(snapshot, name)
        if isinstance(here, MutableRecord) and type(here) is type(kept):
            put_back(here, kept)
        else:
            setattr(record, name, _copied(kept))


def _copied(value: Any) -> Any:
    if _shared(type(value)):  # type: ignore[arg-type]  # a type can be hashed
        return value
    if isinstance(value, MutableRecord):
        return copied(value)
    if isinstance(value, dict):
        if _PLAIN.issuperset(map(type, value.values())):
            return dict(value)
        return {key: _copied(item) for key, item in value.items()}
    if isinstance(value, list):
        return [*value] if _PLAIN.issuperset(map(type, value)) else [_copied(item) for item in value]
    if isinstance(value, np.ndarray):
        value.setflags(write=False)
        return value
    raise TypeError(f"a {type(value).__name__} in a record is mutable and cannot be copied")


@cache
def _shared(kind: type) -> bool:
    """Return True if values of the type `kind` never change. Such types are frozen structures, frozen dataclasses, and
    the types in _SHARED.
    """
    if issubclass(kind, msgspec.Struct):
        return bool(kind.__struct_config__.frozen)
    frozen = is_dataclass(kind) and bool(getattr(kind, "__dataclass_params__").frozen)  # noqa: B009 - untyped
    return frozen or issubclass(kind, _SHARED)
