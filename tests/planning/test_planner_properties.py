"""Whatever motions a script asks for, the planner has a plan or says why not."""

import pytest
from checking import CELL, said
from hypothesis import given, settings
from hypothesis import strategies as st

from handeye.al import AL, compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.core.diagnostics import has_errors
from handeye.core.source import Source
from handeye.planning.planner import plan_program

inches = st.floats(-60, 60).map(lambda x: f"{x:.3f}")
angles = st.sampled_from(["-180", "-90", "0", "30", "90", "135"])
ounces = st.integers(-3000, 3000).map(str)


def vector(item: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.tuples(item, item, item).map(lambda v: f"[{' '.join(v)}]")


goals = st.sampled_from(["PEG", "OVER", "WEST", "EAST", "T"])
lines = st.one_of(
    st.tuples(inches, inches, inches, angles, angles, angles).map(
        lambda p: f"TRANS Q [{' '.join(p)}]\nMOVE Q"
    ),
    goals.map(lambda g: f"MOVE {g}"),
    goals.map(lambda g: f"MOVE {g} DIRECT"),
    st.tuples(vector(inches), st.floats(0.01, 80)).map(lambda c: f"CHANGE {c[0]} {c[1]:.3f}"),
    vector(ounces).map(lambda f: f"STOP {f}\nCHANGE [0 0 -1] 1"),
    vector(ounces).map(lambda f: f"FORCE {f}\nCHANGE [1 0 0] 1"),
    st.tuples(goals, st.integers(-360, 360)).map(lambda t: f"TURN {t[0]} {t[1]}"),
    st.sampled_from(["OPEN 1", "OPEN 4", "CLOSE", "CLOSE .2", "CENTER .1", "LOAD 10", "LOAD 5000"]),
)


@pytest.mark.slow
@settings(max_examples=60)
@given(st.lists(lines, min_size=1, max_size=8).filter(lambda ls: sum("TRANS" in line for line in ls) < 2))
def test_any_motions_have_a_plan_or_errors(script: list[str]) -> None:
    program, _ = compile_text(Source(name="any.al", text="\n".join(script)), CELL)
    if program is not None:
        plan, problems = plan_program(program, STANFORD, AL)
        assert (plan is None) == has_errors(problems)
        assert not any("nan" in p.message or "inf " in p.message for p in problems)


def test_a_warning_leaves_the_plan() -> None:
    program, _ = compile_text(Source(name="any.al", text="OPEN 1\nMOVE PEG\nCLOSE\nMOVE OVER"), CELL)
    assert program is not None
    plan, problems = plan_program(program, STANFORD, AL)
    assert plan is not None
    assert [p.severity for p in problems] == ["warning"]


def test_nothing_is_said_of_a_script_without_motions() -> None:
    assert said("OPEN 1\nLOAD 5000\nCLOSE") == []
