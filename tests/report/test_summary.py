"""The result of a run counts the stages that there are, whatever a recording says of them."""

from handeye.events import CameraBusy, StageFinished, StageStarted
from handeye.report.summary import stage_times


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


def test_a_stage_whose_beginning_is_missing_has_ended_all_the_same() -> None:
    (stage,) = stage_times(("look",), [StageFinished(time=4.5, stage="look", status="done")])
    assert stage.status == "done"
