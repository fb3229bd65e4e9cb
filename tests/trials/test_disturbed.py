"""What somebody disturbs behind the arm's back stops the arm as it undoes, before harm; what does not is told."""

import numpy as np
import pytest
from conftest import Command
from msgspec.structs import replace
from short_runs import plan_of

from handeye.cell.simulated import SimulatedCell
from handeye.core.variation import WorldSpec
from handeye.tasks import task
from handeye.tasks.water_pump.faults.after import MOVED_M, THIN_RATIO, bystanders
from handeye.trials.disturbing import DISTURBED, DisturbanceResult, DisturbanceRow, DisturbanceWork, disturbed
from handeye.trials.figures import figures
from handeye.trials.sweep import Case

TAKE = """
        STAGE   "take the pin"
        OPEN    1
        MOVE    P1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
"""
"""Takes a pin out of its holder."""
STOPPED = DisturbanceResult(
    name="top.removed", built=True, stopped=True, at="OPEN    2.8", line="327", message="it is gone"
)


def cell() -> SimulatedCell:
    return task().cell(WorldSpec(seed=0), "ray")


def made(name: str, there: SimulatedCell) -> None:
    next(each for each in task().disturbances() if each.name == name).make(there)


def place(there: SimulatedCell, body: str) -> np.ndarray:
    return there.truth.data.body(body).xpos.copy()


@pytest.mark.slow
def test_a_pin_that_is_taken_out_of_the_hand_stops_the_arm() -> None:
    found = disturbed(plan_of(TAKE), WorldSpec(seed=0), "ray", "pin.removed")
    assert (found.stopped, found.harmless, found.at.split()[0]) == (True, True, "CLOSE")
    assert "the gap is 0.00 in" in found.message


@pytest.mark.slow
def test_what_nobody_notices_is_no_success() -> None:
    found = disturbed(plan_of(TAKE), WorldSpec(seed=0), "ray", "driver.removed")
    assert (found.built, found.stopped, found.harmless) == (True, False, False)
    assert "distance of the screwdriver from its place in the rack" in found.message


@pytest.mark.slow
def test_each_disturbance_does_what_it_says() -> None:
    there = cell()
    first = place(there, "base"), place(there, "pin0")
    made("stack.moved", there)
    made("pin.removed", there)
    made("gasket.glued", there)
    made("pin.swapped", there)
    there.advance(1 / 60)
    assert place(there, "base") - first[0] == pytest.approx([MOVED_M, 0, 0], abs=2e-4)
    assert place(there, "pin0")[2] < 0
    model, data = there.truth.model, there.truth.data
    assert data.eq_active[model.equality("merge_gasket").id]
    thick, thin = (model.geom_size[model.body(pin).geomadr[0], 0] for pin in ("pin0", "pin1"))
    assert thin == pytest.approx(THIN_RATIO * thick)


@pytest.mark.slow
def test_bystanders_are_on_the_table_and_in_no_hand() -> None:
    there = cell()
    assert {*bystanders(there.truth)} == {"base", "gasket", "top", "pin0", "pin1", "driver"}
    made("top.removed", there)
    there.advance(1 / 60)
    assert "top" not in bystanders(there.truth)


def test_a_stop_in_time_is_one_before_anything_is_pushed_or_wrecked() -> None:
    soft = replace(STOPPED, moved=1.9, felt=59.0)
    assert soft.harmless
    assert not replace(soft, moved=2.1).harmless
    assert not replace(soft, felt=61.0).harmless
    assert not replace(soft, stopped=False).harmless


def row(tried: DisturbanceResult) -> DisturbanceRow:
    return DisturbanceRow(trial=0, seed=0, condition=tried.name, tried=tried)


def test_what_could_not_be_tried_counts_nowhere() -> None:
    found = figures(DISTURBED, [row(DisturbanceResult(name="top.glued", built=False)), row(STOPPED)])
    assert (found.n, found.right, found.uncounted, found.exit_code) == (1, 1, 1, 0)


def test_the_command_tells_each_and_whether_all_were_stopped(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def work(self: DisturbanceWork, case: Case) -> list[DisturbanceRow]:
        free = DisturbanceResult(name=case.condition, built=True, message="top (at most 3 mm)")
        return [row(STOPPED if case.condition == STOPPED.name else free)]

    monkeypatch.setattr(DisturbanceWork, "__call__", work)
    words = ("trials", "disturbed", "--jobs", "1", "--only", "top.removed")
    code, out, _ = command(*words, "--only", "stack.moved")
    assert (code, {*out.splitlines()} >= {
        "top.removed      stopped in time, line 327, OPEN 2.8: it is gone; felt 0.0 N, moved 0.00 mm",
        "stack.moved      NOT STOPPED: top (at most 3 mm); felt 0.0 N, moved 0.00 mm",
    }) == (3, True)  # fmt: skip
    code, out, _ = command(*words, "--json")
    assert (code, '"harmless": 1' in out) == (0, True)


def test_the_list_names_what_can_be_disturbed(command: Command) -> None:
    code, out, _ = command("trials", "disturbed", "--list")
    assert (code, [line.split()[0] for line in out.splitlines()]) == (
        0,
        [e.name for e in task().disturbances()],
    )
    code, out, err = command("trials", "disturbed", "--only", "top.remove")
    assert (code, out, err) == (
        2,
        "",
        "handeye: there is no disturbance `top.remove`; did you mean `top.removed`?\n",
    )
