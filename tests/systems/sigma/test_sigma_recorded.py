"""The recorded run of the chess experiment that handeye includes."""

from collections.abc import Callable
from pathlib import Path
from typing import Final

import pytest
from mal_bench import mal

from handeye.core import resources
from handeye.runs.verify import setup_of
from handeye.systems.sigma.run.plan import MalPlan
from handeye.trace.reading import read_trace

Command = Callable[..., tuple[int, str, str]]
CHESS: Final = resources.demo() / "chess"
AGAIN: Final = "run: python docs/make_demo.py chess"


def test_it_is_a_run_of_the_present_program_and_takes_less_than_a_megabyte() -> None:
    plan = setup_of(read_trace(CHESS / "trace.mcap")).plan
    assert isinstance(plan, MalPlan)
    assert (plan.text, plan.job, plan.pieces) == (mal("chess"), "chess", 3), AGAIN
    assert sum(file.stat().st_size for file in CHESS.iterdir()) < 1_000_000


@pytest.mark.slow
def test_its_page_says_how_the_board_ended(command: Command) -> None:
    assert command("demo", "chess")[:2] == (0, "demo.html\n")
    page = Path("demo.html").read_text(encoding="utf-8")
    assert "<h1>Each piece stands on the line for its height.</h1>" in page
    for part in ("HEIGHT        63.375        AT            194.363", "pieces.across", "No source"):
        assert part in page
