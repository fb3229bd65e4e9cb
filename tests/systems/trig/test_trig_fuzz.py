"""Drawn sessions of TRIG; `python tests/systems/trig/fuzz_sessions.py 100000` draws more of them."""

from pathlib import Path

import pytest
from fuzz_sessions import carried_out

FEW = range(60)
"""Sessions that are drawn in the suite."""
ONCE_WRONG = (296, 298, 22281, 30409, 35853, 36803)
"""Sessions that have found something."""


@pytest.mark.slow
def test_whatever_is_typed_is_carried_out_or_refused_in_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    told: list[str] = []
    assert [n for n in (*FEW, *ONCE_WRONG) if not carried_out(n, told.append)] == [], told
