"""The referee of the bench of blocks, on poses that are made up: each finding refuses what it is about, no more."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from handeye.core.pose import Pose, pose
from handeye.core.variation import Overrides, WorldSpec
from handeye.judge.finding import Findings, all_right
from handeye.systems.trig.jobs.jobs import PalletJob
from handeye.systems.trig.jobs.referee import (
    judge_back,
    judge_dropped,
    judge_hand,
    judge_placed,
    judge_program,
)
from handeye.systems.trig.jobs.table import BlockTable
from handeye.systems.trig.jobs.world import FAULTS, BlocksWorld
from handeye.systems.trig.language.place import Place

PLACES = (Place(x=-0.05, y=-0.1), Place(x=0.0, y=-0.1))


def at(x: float, y: float, z: float = 6.0, *, lean: float = 0.0, turn: float = 0.0) -> Pose:
    """A pose of a block, mm and deg."""
    R = Rotation.from_euler("xz", [lean, turn], degrees=True).as_matrix()
    return pose(R, np.array([x, y, z]) / 1000)


BEFORE = {f"block_{number}": at(150, 0, 12 * number - 6) for number in (1, 2, 3)}
PLACED = {"block_1": BEFORE["block_1"], "block_3": at(-50, -100), "block_2": at(0, -100)}


def refused(findings: Findings) -> set[str]:
    """Names of what is not right."""
    assert all_right(findings) is not any(finding.refuses for finding in findings.values())
    return {name for name, finding in findings.items() if finding.refuses}


@pytest.mark.parametrize(
    ("changed", "names"),
    [
        ({}, set()),
        ({"block_3": at(-48.1, -100)}, set()),
        ({"block_3": at(-47.9, -100)}, {"placed"}),
        ({"block_3": at(0, -100), "block_2": at(-50, -100)}, {"placed"}),
        ({"block_2": at(0, -100, 6.6)}, {"on_the_pallet"}),
        ({"block_2": at(0, -100, lean=2.1)}, {"flat"}),
        ({"block_1": at(153.1, 0)}, {"blocks"}),
        ({"block_1": at(150, 0, turn=1.1)}, {"turned"}),
    ],
)
def test_blocks_lie_at_their_places_in_order_and_others_where_they_were(
    changed: dict[str, Pose], names: set[str]
) -> None:
    assert refused(judge_placed(BEFORE, PLACED | changed, PLACES)) == names


@pytest.mark.parametrize(
    ("changed", "names"),
    [
        ({}, set()),
        ({"block_2": at(152.9, 0, 18)}, set()),
        ({"block_2": at(153.1, 0, 18)}, {"blocks"}),
        ({"block_2": BEFORE["block_3"], "block_3": BEFORE["block_2"]}, {"blocks"}),
        ({"block_3": at(150, 0, 30, turn=-1.1)}, {"turned"}),
        ({"block_3": at(150, 0, 30, lean=1.1)}, {"turned"}),
    ],
)
def test_every_block_is_back_in_its_old_order(changed: dict[str, Pose], names: set[str]) -> None:
    assert refused(judge_back(BEFORE, BEFORE | changed)) == names


@pytest.mark.parametrize(
    ("findings", "names"),
    [
        (lambda: judge_dropped(at(140, 3), (0.14, 0.0), np.array([-0.12, 0.06]), at(-120, 60)), set()),
        (
            lambda: judge_dropped(at(180, 3), (0.14, 0.0), np.array([-0.12, 0.06]), at(-120, 60)),
            {"in_the_bucket"},
        ),
        (
            lambda: judge_dropped(at(140, 3, 150), (0.14, 0.0), np.array([-0.12, 0.06]), at(-120, 60)),
            {"below_its_rim"},
        ),
        (lambda: judge_dropped(at(140, 3), (0.14, 0.0), np.array([-0.12, 0.06]), at(-120, 63)), {"replaced"}),
        (lambda: judge_dropped(at(140, 3), (0.14, 0.0), np.array([-0.12, 0.06]), at(-120, 60, 7)), {"lies"}),
        (lambda: {"hand": judge_hand(np.zeros(6), np.array([0.0006, 0, 0, 0, 0, 0]), "ends")}, {"hand"}),
        (lambda: judge_program((Place(x=0.1), Place(x=0.1)), [0, 0]), set()),
        (lambda: judge_program((Place(x=0.1001), Place(x=0.1)), [0, 1]), {"pallet", "loops"}),
    ],
)
def test_bucket_hand_and_program(findings: Callable[[], Findings], names: set[str]) -> None:
    assert refused(findings()) == names


def test_a_world_without_a_seed_has_no_error_and_equal_seeds_have_equal_ones() -> None:
    nominal, one, same, other = (
        BlocksWorld(spec) for spec in (None, WorldSpec(seed=1), WorldSpec(seed=1), WorldSpec(seed=2))
    )
    q = np.full(6, 0.1)
    assert (nominal.slip(3), nominal.friction, nominal.bending(q).any()) == (0.0, 0.4, False)
    assert (one.slip(3), one.friction) == (same.slip(3), same.friction) != (other.slip(3), other.friction)
    assert one.bending(q) == pytest.approx(same.bending(q), abs=0)
    assert max(abs(one.slip(number)) for number in range(1000)) == pytest.approx(0.0006)


def test_errors_of_a_world_are_scaled_switched_off_and_set_without_changing_others() -> None:
    def world(**changed: Any) -> BlocksWorld:
        return BlocksWorld(WorldSpec(seed=1, **changed))

    nominal, high, sure = world(), world(level="high"), world(overrides=Overrides(without=("taught",)))
    wide = world(overrides=Overrides(set={"taught": 0.001}))
    assert high.slip(3) == pytest.approx(2 * nominal.slip(3))
    assert wide.slip(3) == pytest.approx(nominal.slip(3) / 0.3)
    assert (sure.slip(3), sure.friction, high.friction) == (0.0, nominal.friction, nominal.friction)


def test_what_is_broken_is_in_the_scene_from_the_start_and_nothing_else_is() -> None:
    def world(*names: str) -> BlocksWorld:
        return BlocksWorld(WorldSpec(seed=1, faults=tuple(FAULTS.kind(name).usual() for name in names)))

    oiled, weighty, sound = world("platter.slippery"), world("blocks.heavy"), world()
    assert (oiled.friction, weighty.friction) == (0.05, sound.friction)
    masses = []
    for each in (weighty, sound):
        table = BlockTable(each)
        table.stack(1, 0.0, 0.0)
        masses.append(table.bench.model.body("block_1").mass[0])
    assert masses[0] == pytest.approx(10 * masses[1])
    hand = {
        name: PalletJob("", world(*name)).bench.model.actuator("hand").forcerange[1]
        for name in ((), ("hand.weak",))
    }
    assert hand == {(): 30.0, ("hand.weak",): 0.1}
