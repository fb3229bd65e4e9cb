"""Hostile and drawn texts: `python tests/systems/ml/fuzz_ml.py 10000` draws more of them."""

import fuzz_ml
import pytest
from fuzz_ml import counted, outcome


@pytest.mark.slow
def test_whatever_a_text_holds_it_is_refused_or_executed_in_words() -> None:
    assert {outcome(seed) for seed in range(120)} == {"errors", "ended", "stopped", "goes on"}


def test_a_text_that_goes_wrong_is_told_with_its_seed(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(seed: int) -> str:
        raise ValueError(f"text {seed}")

    monkeypatch.setattr(fuzz_ml, "outcome", broken)
    told: list[str] = []
    assert counted(7, told.append) == "wrong"
    assert told[0].startswith("seed 7:\nTraceback")
