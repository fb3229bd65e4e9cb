"""The base class of all causes, and the record with which a cause names a joint."""

from handeye.core.record import Record


class CauseRecord(Record, frozen=True, kw_only=True, tag_field="cause", tag=True):
    """Base class of all causes."""


class JointName(Record, frozen=True, kw_only=True):
    """Name and kind of a joint."""

    name: str
    kind: str
