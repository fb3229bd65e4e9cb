"""Schedules of faults and interruptions are drawn, told, carried out and shrunk; what is planted is found."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest
from conftest import Command
from short_runs import begin

from handeye.core.errors import InvalidInput
from handeye.core.faults import SpoiledWork
from handeye.core.variation import WorldSpec
from handeye.execution.drive import ArmDrive
from handeye.judge.finding import Finding, at_least, at_most
from handeye.program.events import StepStarted
from handeye.program.system_state import SystemState
from handeye.proof.proof import ClaimProof
from handeye.systems.stanford.executor_run import RunningPlan
from handeye.tasks import task
from handeye.trials.chaos import trials as trial
from handeye.trials.chaos.last_look import LastLook
from handeye.trials.chaos.schedule import Break, Schedule, draw, parse_schedule
from handeye.trials.chaos.trials import ScheduleResult, Violation, shrunk, try_schedule, wrong
from handeye.trials.sound_run import SoundRun, sound_run

SCHEDULE = Schedule(
    seed=3,
    level="high",
    start=6,
    steps=4,
    faults=("gap_potentiometer.stuck@2", "lamp.dead@2"),
    breaks=(Break(kind="panic", after=40), Break(kind="back", after=2)),
    answers=("retry", "skip"),
)


def test_a_schedule_is_told_and_understood() -> None:
    told = (
        "seed=3 level=high start=6 steps=4 faults=gap_potentiometer.stuck@2,lamp.dead@2 breaks=panic:40,back:2 "
        "answers=retry,skip"
    )
    assert str(SCHEDULE) == told
    assert parse_schedule(told) == SCHEDULE
    assert parse_schedule("seed=3 start=0") == Schedule(seed=3, start=0)


@pytest.mark.parametrize(
    "text",
    ["", "✓", "seed=3", "seed=3 start=x", "seed=3 start=1 end=2", "seed=3 start=1 breaks=kill", "seed=3 start=1 seed=4",
     "seed=3 start=1 answers=perhaps", "seed=3 start=1 level=huge"],
)  # fmt: skip
def test_what_is_no_schedule_is_bad_input(command: Command, text: str) -> None:
    code, out, err = command("trials", "chaos", "--schedule", text)
    assert (code, out, err.count("\n")) == (2, "", 1)


def test_a_fault_that_cannot_set_in_while_the_arm_works_is_refused() -> None:
    for name in ("gasket.missing@5", "lamp.dead"):
        with pytest.raises(InvalidInput):
            Schedule(seed=3, start=0, faults=(name,)).given(task().faults(WorldSpec(seed=3)))


def test_schedules_are_drawn_from_a_seed_and_can_be_told() -> None:
    worlds, kinds = [(3, "nominal"), (4, "low")], task().faults(WorldSpec(seed=3))
    again = [
        [draw(n, seed, worlds, [(0, 9), (5,)], kinds, [(1, 2), (4,)]) for n in range(60)]
        for seed in (1, 1, 2)
    ]  # fmt: skip
    assert again[0] == again[1] != again[2]
    for schedule in again[0]:
        assert parse_schedule(str(schedule)) == schedule
        schedule.given(task().faults(WorldSpec(seed=3)))
    assert {each.kind for schedule in again[0] for each in schedule.breaks} == {
        "panic",
        "pause",
        "back",
        "kill",
    }


def test_a_schedule_is_shrunk_to_what_it_fails_by() -> None:
    def fails(schedule: Schedule) -> ScheduleResult:
        guilty = "lamp.dead@2" in schedule.faults and any(each.kind == "back" for each in schedule.breaks)
        return ScheduleResult(
            schedule=str(schedule),
            ended="break",
            broken=(Violation("resume", "it differs"),) if guilty else (),
        )

    least, tried = shrunk(fails(SCHEDULE), SCHEDULE, fails)
    assert (
        str(least) == tried.schedule == "seed=3 level=high start=6 steps=4 faults=lamp.dead@2 breaks=back:2"
    )


def test_a_finding_counts_from_the_stage_on_that_it_must_hold_from() -> None:
    findings = {name: at_most(2.0, 1.0, "mm", "") for name in ("base_yaw", "gasket_height", "rack")}
    told = [[*wrong(findings, stage, 12, task().holds_from)] for stage in (2, 3, 5, 12)]
    assert told == [[], ["base_yaw"], ["base_yaw", "gasket_height"], ["base_yaw", "gasket_height", "rack"]]


# -- after the last look ------------------------------------------------------------------------------

CLAMP, DEPTH = at_least(0.0, 40.0, "N", "clamping force"), at_most(0.3, 0.2, "mm", "gap under the head")
LOOSE = SpoiledWork(findings=("screws_depth", "screws_clamp"), where="hole 2")
LOOKS = LastLook(
    claims={
        "screws_clamp": (
            ClaimProof(says="driven", where="hole 1", verdict="shown", phases=((8,),)),
            ClaimProof(says="driven", where="hole 2", verdict="shown", phases=((3, 7),)),
        ),
        "screws_depth": (ClaimProof(says="felt", where="hole 2", verdict="shown", phases=((9,),)),),
    },
    unnoticed={"screws_depth": 0.5},
)


def unseen(finding: Finding, *steps: int, work: SpoiledWork = LOOSE, looks: LastLook = LOOKS) -> bool:
    """The fault began at 100 s, and these steps followed, 10 s apart."""
    events = [StepStarted(time=110.0 + 10 * k, step=step, line=1, text="") for k, step in enumerate(steps)]
    name = "screws_clamp" if finding.relation == "at least" else "screws_depth"
    return looks.passed(name, finding, [work], events, 100.0)


def test_a_screw_that_works_loose_after_its_last_drive_is_unseen() -> None:
    assert unseen(CLAMP, 8, 9)
    assert not unseen(CLAMP, 6, 7, 8)


def test_a_fault_that_acts_late_is_unseen_if_the_last_look_came_before() -> None:
    late = replace(LOOSE, delay=25.0)
    assert unseen(CLAMP, 6, 7, 8, work=late)
    assert not unseen(CLAMP, 6, 8, 7, work=late)


def test_a_look_overlooks_only_what_its_claim_says() -> None:
    assert unseen(DEPTH, 9)
    assert not unseen(replace(DEPTH, value=0.6), 9)


def test_only_work_that_the_fault_spoils_is_unseen() -> None:
    elsewhere = replace(LOOSE, where="hole 1")
    assert not unseen(CLAMP, 8, work=elsewhere)
    assert not unseen(CLAMP, work=replace(LOOSE, findings=("rotor",)))


def test_nothing_is_unseen_by_a_program_that_need_not_look() -> None:
    claims = {"screws_clamp": (ClaimProof(says="driven", where="hole 2", verdict="avoided"),)}
    assert not unseen(CLAMP, looks=LastLook(claims=claims, unnoticed={}))


# -- on a short program -------------------------------------------------------------------------------

SCRIPT = """        STAGE   "open"
        OPEN    1
        SAVE    HERE
        OPEN    2
        STAGE   "call"
        OPEN    1.5
        WAIT    "COME HERE"
        OPEN    1
        STAGE   "shut"
        OPEN    .5
"""


@pytest.fixture
def sound(tmp_path: Path) -> SoundRun:
    """A sound run of a short program, which calls the operator in its second stage."""
    return sound_run(tmp_path, begin(SCRIPT).setup, WorldSpec(seed=3))


def tried(sound: SoundRun, text: str) -> ScheduleResult:
    return try_schedule(parse_schedule(f"seed=3 start=0 {text}".strip()), sound)


@pytest.mark.slow
def test_all_holds_when_a_sound_product_is_interrupted(sound: SoundRun) -> None:
    for text in ("", "breaks=panic:20,pause:1,back:2", "faults=gap_potentiometer.stuck@1 breaks=pause:2"):
        assert tried(sound, text).broken == ()
    for text in (
        "steps=1 breaks=pause:1",
        "breaks=pause:3",
        "steps=2 breaks=pause:1,back:1",
    ):  # at its very end
        assert tried(sound, text).broken == ()
    late = try_schedule(parse_schedule("seed=3 start=3 breaks=pause:1 answers=proceed,retry"), sound)
    assert (late.ended, late.broken) == ("break", ())


@pytest.mark.slow
def test_a_wrong_pump_that_a_program_takes_for_right_is_found_unless_it_stops_later(
    sound: SoundRun, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        trial, "findings_so_far", lambda _: {"base_yaw": at_most(2.0, 1.0, "deg", "turn of the base")}
    )
    quiet = sound_run(tmp_path / "quiet", begin(SCRIPT.replace("WAIT", ";WAIT")).setup, WorldSpec(seed=3))
    assert tried(sound, "").broken == ()
    last = try_schedule(parse_schedule("seed=3 start=6 breaks=pause:1 answers=retry"), quiet)
    assert last.names == {"silent"}


@pytest.mark.slow
def test_a_stop_without_brakes_is_found_and_shrunk(sound: SoundRun, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ArmDrive, "brake", ArmDrive.float)
    schedule = parse_schedule("seed=3 start=3 faults=lamp.dead@2,picture.dark@2 breaks=pause:1 answers=retry")
    found = try_schedule(schedule, sound)
    assert found.names == {"brakes"}
    least, _ = shrunk(found, schedule, partial(try_schedule, sound=sound))
    assert str(least) == "seed=3 start=3"


@pytest.mark.slow
def test_a_state_that_is_not_put_back_whole_is_found_and_shrunk(
    sound: SoundRun, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole: Callable[[RunningPlan, SystemState], None] = RunningPlan.restore

    def forgetting(self: RunningPlan, state: SystemState) -> None:
        whole(self, state)
        self.context.state.saved.clear()

    monkeypatch.setattr(RunningPlan, "restore", forgetting)
    schedule = parse_schedule("seed=3 start=0 faults=lamp.dead@1 breaks=panic:10,pause:2")
    found = try_schedule(schedule, sound)
    assert found.names == {"resume"}
    least, _ = shrunk(found, schedule, partial(try_schedule, sound=sound))
    assert str(least) == "seed=3 start=0 breaks=pause:2"
