"""MAL from Python."""

import pytest
from mal_bench import mal

import handeye
from handeye.core.errors import InvalidInput

COLLIDE = "10 ORIGIN X1, X2\n20 MOVE X2 TO 400\n30 MOVE X1 TO 200 SLOW 100\n"


def test_a_program_runs_to_a_line_and_shows_tasks_flags_and_counts() -> None:
    program = handeye.Mal(mal("handover"))
    assert program.run(until=160) == []
    assert program.tasks["SCREWER"] == "320 TAKE PARTREADY, waiting for flag PARTREADY"
    assert (program.line, program.flags) == (160, ("PLACEFREE",))
    assert program.believed["X1"] == pytest.approx(50, abs=0.02)
    assert program.status("X1") == "free"
    (line,) = program.run()
    assert line.startswith("PIECES        4")
    assert (program.tasks, program.stopped, program.line) == ({}, "", None)
    assert "FEEDER to X1: move by 1333 steps" in "\n".join(program.account)


def test_a_deadlock_is_named_by_a_run_and_by_the_search() -> None:
    program = handeye.Mal(mal("dead"))
    program.run()
    assert program.stopped.startswith("DEADLOCK")
    assert program.interleavings()[0].startswith("deadlock")


def test_a_line_that_is_not_there_and_a_search_of_no_states_are_refused() -> None:
    program = handeye.Mal("10 ORIGIN X1\n20 MOVE X1 TO 50\n")
    with pytest.raises(InvalidInput, match="the program has no line 25; the nearest are 20, 10"):
        program.run(until=25)
    with pytest.raises(InvalidInput, match="must be at least 1, not 0"):
        program.interleavings(0)


@pytest.mark.slow
def test_gantries_have_a_history_and_faults_and_perfect_motors_have_none() -> None:
    stopped, cut = (
        handeye.Mal(COLLIDE, arm="gantries"),
        handeye.Mal(COLLIDE, arm="gantries", faults=["no-reflex"]),
    )
    assert (stopped.run(), cut.run()) == ([], [])
    assert "ABORT X1 FORCE" in stopped.stopped
    assert abs(stopped.history["force"][:, 0]).max() < 40 < abs(cut.history["force"][:, 0]).max()
    assert len(cut.history["time"]) == len(cut.history["place"])
    with pytest.raises(InvalidInput):
        _ = handeye.Mal(COLLIDE).history
    with pytest.raises(InvalidInput):
        handeye.Mal(COLLIDE, faults=["no-reflex"])
    with pytest.raises(InvalidInput):
        handeye.Mal("10 MOOVE\n")
    with pytest.raises(InvalidInput):
        handeye.Mal(COLLIDE, arm="gantries", faults=["nothing"])
