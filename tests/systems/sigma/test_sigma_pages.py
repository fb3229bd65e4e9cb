"""The pages about MAL show what happens; `pytest FILE --update -n 0` writes it into them."""

import re
import shlex
import shutil
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location

import pytest
from mal_bench import PLANS, ROOT, mal
from walked_pages import walked, with_outputs

from handeye.core.variation import WorldSpec
from handeye.debugger.formatting import as_text
from handeye.debugger.stepper import Stepper
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.sigma.run.plan import MalPlan

Command = Callable[..., tuple[int, str, str]]
PAGE = ROOT / "docs/mal.md"
TABLE = re.compile(r"stages  |arm  |computer  ")
"""The end of every run, which the page leaves out."""


@pytest.mark.slow
def test_the_tutorial_shows_what_happens(command: Command, request: pytest.FixtureRequest) -> None:
    for name in ("handover", "dead"):
        shutil.copy(PLANS / f"{name}.mal", ".")
    session: list[Stepper] = []

    def run(line: str) -> tuple[int, str]:
        if line.endswith("--step"):
            plan = MalPlan(name="handover.mal", text=mal("handover"))
            setup = Setup(system="sigma", plan=plan, world=WorldSpec(seed=0), camera="auto")
            session.append(Stepper(Runner(Checkpoint(setup=setup))))
            return 0, as_text(session[0].standing()) + "\n"
        code, out, err = command(*shlex.split(line))
        seen = err + out if "check" in line else out
        rows = [row.rstrip() for row in seen.splitlines() if not TABLE.match(row)]
        return code, "\n".join(rows).rstrip() + "\n"

    typed = walked(
        PAGE.read_text(encoding="utf-8"), run, lambda line: (0, as_text(session[0].do(line)) + "\n")
    )
    if request.config.getoption("--update"):
        PAGE.write_text(with_outputs(PAGE.read_text(encoding="utf-8"), typed), encoding="utf-8")
        return
    assert [(each.line, each.shown, each.printed) for each in typed if not each.stands] == []
    assert len(typed) >= 14


def test_the_page_of_words_is_made_from_the_table_of_words() -> None:
    spec = spec_from_file_location("make_mal_words", ROOT / "docs/make_mal_words.py")
    assert spec is not None
    assert spec.loader is not None
    made = module_from_spec(spec)
    spec.loader.exec_module(made)
    assert made.PAGE.read_text(encoding="utf-8") == made.page()


def test_pages_count_the_lines_of_a_program_as_they_are() -> None:
    counted = {
        found
        for page in (ROOT / "docs").glob("*.md")
        for found in re.findall(
            r"\[`plans/(\w+)\.mal`\]\(\S+\)[^\[]*?(\d+)\s+lines of\s\[MAL\]", page.read_text(encoding="utf-8")
        )
    }
    assert counted == {
        (name, str(len(mal(name).splitlines()))) for name in ("chess", "handover_pieces", "prco")
    }
