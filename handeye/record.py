"""Records that go to disk: frozen values whose every field has a type that is checked when they are read."""

import msgspec

Vector3 = tuple[float, float, float]
"""Components along x, y and z."""


class Record(msgspec.Struct, frozen=True, gc=False, kw_only=True, forbid_unknown_fields=True):
    """Base of everything that goes to disk."""
