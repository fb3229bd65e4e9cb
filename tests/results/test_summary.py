"""The result of a run counts the stages that there are, whatever a recording says of them."""

from handeye.core.variation import WorldSpec
from handeye.ports.camera import Renderer
from handeye.program.events import (
    CameraBusy,
    ExperimentMade,
    OperatorAnswered,
    RunStarted,
    StageFinished,
    StageStarted,
)
from handeye.results.summary import interventions, stage_times


def test_the_time_of_a_stage_leaves_out_the_camera() -> None:
    events = [
        StageStarted(time=1.0, stage="look"),
        CameraBusy(time=3.0, action="lens", seconds=2.0),
        StageFinished(time=4.5, stage="look", status="done"),
        StageStarted(time=4.5, stage="grasp"),
        CameraBusy(time=5.0, action="aim", seconds=0.25),
    ]
    told = [
        (stage.name, stage.status, stage.arm_s) for stage in stage_times(("look", "grasp", "lift"), events)
    ]
    assert told == [("look", "done", 1.5), ("grasp", "under way", 0.25), ("lift", "not reached", 0.0)]


def test_a_stage_that_is_stopped_while_it_is_undone_took_what_it_took_before() -> None:
    events = [
        StageStarted(time=1.0, stage="look"),
        StageFinished(time=4.5, stage="look", status="done"),
        StageFinished(time=9.0, stage="look", status="stopped"),
    ]
    (stage,) = stage_times(("look",), events)
    assert (stage.status, stage.arm_s) == ("stopped", 3.5)


def test_a_stage_whose_beginning_is_missing_has_ended_all_the_same() -> None:
    (stage,) = stage_times(("look",), [StageFinished(time=4.5, stage="look", status="done")])
    assert stage.status == "done"


def test_interventions_are_told_by_the_time_since_the_run_began() -> None:
    begun = RunStarted(
        time=0.0, program="p", steps=1, plan="", arm="", arm_digest="", world=WorldSpec(seed=0),
        camera=Renderer(method="none"), versions={}, prepared=215.5,
    )  # fmt: skip
    asked = OperatorAnswered(time=4.5, choice="proceed", step=None)
    tried = ExperimentMade(time=5.75, what="saved", name="E2", value=(0.0, 0.0, 0.0))
    assert list(interventions([begun, asked, tried])) == [
        "at 4.5 s the operator chose: proceed", "at 5.8 s saved E2 was set by the experimenter"
    ]  # fmt: skip
