"""Records: values that go to disk, and never change. Every field has a type that is checked when it is read.

State that changes while something runs is a `MutableRecord` (`handeye/core/mutable_records.py`).
"""

import msgspec

Vector3 = tuple[float, float, float]
"""Components along x, y and z."""


class Record(msgspec.Struct, frozen=True, gc=False, kw_only=True, forbid_unknown_fields=True):
    """Base of the values that go to disk: programs, plans, events, settings."""
