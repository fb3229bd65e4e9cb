"""Trials that are broken off keep the results of those that have ended."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from msgspec.structs import replace
from results import result

from handeye.cli.trials import assembly_trials
from handeye.report.result import Result
from handeye.trials import seeds


def test_trials_that_are_interrupted_keep_what_has_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = result(completed=True, assembled=True)

    def some(*_: object, **__: object) -> Iterator[Result]:
        yield replace(right, seed=2)
        yield replace(right, seed=1)
        raise KeyboardInterrupt

    monkeypatch.setattr(seeds, "assemble_many", some)
    with pytest.raises(KeyboardInterrupt):
        assembly_trials(seeds="1-3", out=tmp_path / "kept.jsonl")
    lines = (tmp_path / "kept.jsonl").read_text().splitlines()
    assert [json.loads(line)["seed"] for line in lines] == [1, 2]
