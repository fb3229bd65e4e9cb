"""Snapshots of mutable records, and putting them back."""

from dataclasses import dataclass

import msgspec
import numpy as np
import pytest

from handeye.core.mutable_records import MutableRecord, copied, put_back
from handeye.core.pose import Array


class Inner(MutableRecord, kw_only=True):
    count: int = 0


class Outer(MutableRecord, kw_only=True):
    name: str = "outer"
    inner: Inner = msgspec.field(default_factory=Inner)
    spare: Inner | None = None
    table: dict[str, list[int]] = msgspec.field(default_factory=dict)
    plain: dict[str, int] = msgspec.field(default_factory=dict)
    numbers: list[int] = msgspec.field(default_factory=list)
    place: Array = msgspec.field(default_factory=lambda: np.zeros(3))
    anything: object = None


@dataclass
class Loose:
    count: int = 0


@dataclass(frozen=True)
class Fixed:
    count: int = 0


def full() -> Outer:
    return Outer(
        table={"a": [1, 2]},
        plain={"b": 1},
        numbers=[1],
        spare=Inner(count=5),
        place=np.ones(3),
        anything=Fixed(),
    )


def test_nothing_that_happens_to_a_record_changes_its_snapshot() -> None:
    record = full()
    snapshot = copied(record)
    before = str(msgspec.structs.asdict(snapshot))
    record.name, record.inner.count, record.spare, record.place = "other", 1, None, np.zeros(3)
    record.table["a"].append(3)
    record.plain["b"] = 2
    record.numbers.append(2)
    assert str(msgspec.structs.asdict(snapshot)) == before


def test_an_owner_of_a_part_goes_on_with_what_was_put_back() -> None:
    record = full()
    part, snapshot = record.inner, copied(record)
    part.count, record.spare = 9, None
    put_back(record, snapshot)
    assert part is record.inner
    assert (part.count, record.spare) == (0, Inner(count=5))


def test_going_on_after_putting_back_leaves_the_snapshot_as_it_was() -> None:
    record = full()
    snapshot = copied(record)
    put_back(record, snapshot)
    assert record.spare is not None
    record.inner.count, record.spare.count = 7, 7
    record.table["a"].append(3)
    put_back(record, snapshot)
    assert (record.inner.count, record.spare.count, record.table) == (0, 5, {"a": [1, 2]})


def test_an_array_that_a_snapshot_shares_cannot_be_changed_in_place() -> None:
    record = full()
    copied(record)
    with pytest.raises(ValueError, match="read-only"):
        record.place[0] = 2.0


def test_what_can_be_changed_and_not_be_copied_is_refused() -> None:
    with pytest.raises(TypeError, match=r"^a Loose in a record is mutable and cannot be copied$"):
        copied(Outer(anything=Loose()))
