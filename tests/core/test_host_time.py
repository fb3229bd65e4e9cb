"""Seconds of this computer: since the process was started, where the system tells."""

import pytest

from handeye.core import host_time
from handeye.core.host_time import process_age

LONG_AGO = 40.0
"""s after this computer was started that the process was, by what the system is made to tell."""
FIELDS = " ".join(["0"] * 18)


def age(monkeypatch: pytest.MonkeyPatch, told: str, *, imported: float) -> float:
    """Age of a process at 100 s of both clocks, of which the system tells this."""
    monkeypatch.setattr("pathlib.Path.read_text", lambda *_, **__: told)
    monkeypatch.setattr(host_time, "_IMPORTED", imported)
    monkeypatch.setattr("time.monotonic", lambda: 100.0)
    monkeypatch.setattr("time.clock_gettime", lambda _: 100.0)
    monkeypatch.setattr("os.sysconf", lambda _: 100)
    return process_age()


@pytest.mark.parametrize("name", ["python", "a ) strange (name) 7"])
def test_the_interpreter_and_its_imports_are_counted_in(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    told = f"7 ({name}) S {FIELDS} {LONG_AGO * 100:.0f} 5 6"
    assert age(monkeypatch, told, imported=43.0) == 60.0


@pytest.mark.parametrize("told", ["", "7 (python) S 1 2", f"7 (x) S {FIELDS} 0 5", f"7 (x) S {FIELDS} z 5"])
def test_where_the_system_does_not_tell_the_age_is_since_the_import(
    monkeypatch: pytest.MonkeyPatch, told: str
) -> None:
    assert age(monkeypatch, told, imported=43.0) == 57.0


def test_an_age_that_cannot_be_is_not_believed(monkeypatch: pytest.MonkeyPatch) -> None:
    told = f"7 (python) S {FIELDS} {LONG_AGO * 100:.0f}"
    assert age(monkeypatch, told, imported=30.0) == 70.0
