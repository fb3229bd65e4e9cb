"""The live page knows the joints of the arm and their limits, and its demo inserts a pin without pictures."""

from types import SimpleNamespace
from typing import Any

import pytest

from handeye.arm.robots.stanford import STANFORD
from handeye.tasks import any_task
from handeye.view.page import _axes


def runner(task: str) -> Any:
    return SimpleNamespace(task=any_task(task))


@pytest.mark.parametrize("task", ["water_pump", "insertion"])
def test_each_joint_has_its_name_unit_and_limits(task: str) -> None:
    axes = _axes(runner(task))
    assert [name for name, *_ in axes] == [joint.name for joint in STANFORD.joints]
    for (_, unit, size, lower, upper), joint in zip(axes, STANFORD.joints, strict=True):
        assert unit == ("in" if joint.kind == "prismatic" else "°")
        assert (lower * size, upper * size) == pytest.approx((joint.lower, joint.upper))
    boom = next(axis for axis in axes if axis[0] == "boom")
    assert boom[4] == pytest.approx(50)  # in, as `handeye check` says it


def test_a_task_that_does_not_describe_its_arm_has_no_joints() -> None:
    assert _axes(runner("chess")) == []
