"""Hostile and drawn texts: `python tests/systems/ml/fuzz_ml.py 10000` draws more of them."""

import pytest
from fuzz_ml import outcome


@pytest.mark.slow
def test_whatever_a_text_holds_it_is_refused_or_executed_in_words() -> None:
    assert {outcome(seed) for seed in range(120)} == {"errors", "ended", "stopped", "goes on"}
