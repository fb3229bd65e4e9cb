"""Immutable records. When a record is read from a file, the types of its fields are checked.

For state that changes, use a `MutableRecord` (`handeye/core/mutable_records.py`).
"""

import msgspec

from handeye.core.brief import Brief

Vector3 = tuple[float, float, float]  # along x, y and z


class Record(msgspec.Struct, frozen=True, gc=False, kw_only=True, forbid_unknown_fields=True):
    """Base class of the values stored on disk: programs, plans, events, settings."""

    __repr__ = Brief.__repr__
