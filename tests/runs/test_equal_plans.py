"""Plans that differ by last places of computed numbers are one plan; by more, or by what makes them, they are not."""

from collections.abc import Callable
from pathlib import Path

import msgspec
import pytest
from msgspec.structs import replace
from short_runs import GRASP, begin, plan_of

from handeye.api.plans import Plan as PlanInPython
from handeye.core.errors import BadFile
from handeye.core.processor import processor
from handeye.inspection.difference import difference
from handeye.planfile import store
from handeye.planfile.plan import Plan, PlannedMotion
from handeye.planfile.store import alike, encode, is_plan_of, plan_digest, written_digest
from handeye.program.events import RunStarted
from handeye.runs.checkpoint_file import decode
from handeye.runs.checkpoint_file import encode as checkpoint_bytes
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint

PLAN = plan_of(GRASP)
LAST_PLACE, BY_HAND = 3e-10, 1e-5  # rad, m and s


def with_motions(off: float) -> Plan:
    """The plan with all numbers of its motions a little off."""
    motions = {
        number: PlannedMotion(
            knots=tuple(tuple(x + off for x in knot) for knot in motion.knots),
            times=tuple(seconds + off for seconds in motion.times),
        )
        for number, motion in PLAN.motions.items()
    }
    return replace(PLAN, motions=motions)


def with_steps(change: Callable[[float], float]) -> Plan:
    """The plan with the fractions of its steps changed, as another processor may compute them."""

    def changed(value: object) -> object:
        if isinstance(value, dict):
            return {key: changed(each) for key, each in value.items()}
        if isinstance(value, list | tuple):
            return [changed(each) for each in value]
        return change(value) if isinstance(value, float) else value

    steps = msgspec.convert(
        changed(msgspec.to_builtins(PLAN.program.steps)), type(PLAN.program).__annotations__["steps"]
    )
    return replace(PLAN, program=replace(PLAN.program, steps=steps))


@pytest.mark.parametrize(
    "other", [with_motions(LAST_PLACE), with_steps(lambda x: x * (1 + 1e-12))], ids=["motions", "steps"]
)
def test_last_places_of_computed_numbers_make_no_other_plan(other: Plan, tmp_path: Path) -> None:
    assert encode(other) != encode(PLAN)
    assert PlanInPython(record=other) == PlanInPython(record=PLAN)
    assert len({PlanInPython(record=other), PlanInPython(record=PLAN)}) == 1
    assert difference(PLAN, other).same
    kept = CheckpointStore(tmp_path)
    kept.save(Checkpoint(setup=replace(begin().setup, plan=other)))
    kept.check(begin().setup)


def test_motions_changed_by_hand_make_another_plan_of_the_same_digest(tmp_path: Path) -> None:
    other = with_motions(BY_HAND)
    assert plan_digest(other) == plan_digest(PLAN)
    assert not alike(other, PLAN)
    assert PlanInPython(record=other) != PlanInPython(record=PLAN)
    assert not difference(PLAN, other).same
    kept = CheckpointStore(tmp_path)
    kept.save(Checkpoint(setup=replace(begin().setup, plan=other)))
    with pytest.raises(
        BadFile,
        match=r"belongs to another plan of this script, with different motions; choose another folder$",
    ):
        kept.check(begin().setup)


def test_what_makes_a_plan_makes_its_digest(monkeypatch: pytest.MonkeyPatch) -> None:
    program, (first, *_) = PLAN.program, PLAN.program.positions
    place = program.positions[first]
    others = [
        replace(PLAN, task="insertion"),
        replace(PLAN, arm_digest="0" * 12),
        replace(PLAN, speed=0.3),
        *(
            replace(PLAN, program=replace(program, **changed))
            for changed in (
                {"source": f"{program.source};"},
                {"required": {"b.al": ""}},
                {
                    "positions": program.positions
                    | {first: replace(place, at=(*place.at[:5], place.at[5] + 1e-12))}
                },
                {"parts": {}},
                {"steps": program.steps[:-1]},
            )
        ),
    ]
    digests = {plan_digest(each) for each in (PLAN, *others)}
    monkeypatch.setattr(store, "PLANNER", 99)
    assert len(digests | {plan_digest(PLAN)}) == len(others) + 2


def test_where_the_arm_is_planned_to_be_taught_a_position_is_computed() -> None:
    plan = plan_of("TRANS T [25 38 4 90 90 0]\nMOVE T\nHERE X\nMOVE X\n")
    moved = replace(plan.program.positions["X"], at=(0.1, 0.2, 0.3, 0.0, 0.0, 0.0))
    there = replace(plan, program=replace(plan.program, positions=plan.program.positions | {"X": moved}))
    assert plan_digest(there) == plan_digest(plan)
    assert not alike(there, plan)


def begun(**fields: object) -> RunStarted:
    runner = Runner(begin())
    assert isinstance(runner.events[0], RunStarted)
    return replace(runner.events[0], **fields)


@pytest.mark.slow
def test_a_record_knows_the_plan_that_was_carried_out_to_the_last_place() -> None:
    record, tampered = begun(), encode(with_motions(BY_HAND)).encode()
    assert (record.plan, record.content) == (plan_digest(PLAN), written_digest(encode(PLAN).encode()))
    assert is_plan_of(record, encode(PLAN).encode())
    assert not is_plan_of(record, tampered)
    assert not is_plan_of(record, encode(with_motions(LAST_PLACE)).encode())
    old = replace(record, plan=record.content, content=msgspec.UNSET)
    assert is_plan_of(old, encode(PLAN).encode())
    assert not is_plan_of(old, tampered)
    assert not is_plan_of(old, b"[]")


@pytest.mark.slow
def test_a_checkpoint_with_motions_changed_by_hand_is_refused() -> None:
    runner = Runner(begin())
    runner.step()
    sound = runner.checkpoint()
    assert decode(checkpoint_bytes(sound), "it").setup.plan == PLAN
    tampered = replace(sound, setup=replace(sound.setup, plan=with_motions(BY_HAND)))
    with pytest.raises(
        BadFile, match=r"^it is not a valid checkpoint: its header does not match its content$"
    ):
        decode(checkpoint_bytes(tampered), "it")


@pytest.mark.slow
def test_a_record_says_on_which_processor_it_was_made(monkeypatch: pytest.MonkeyPatch) -> None:
    processor.cache_clear()
    assert begun().processor == processor()
    plain = processor()
    monkeypatch.setenv("OPENBLAS_CORETYPE", "Haswell")
    processor.cache_clear()
    assert processor() == f"{plain}, OPENBLAS_CORETYPE=Haswell"
    processor.cache_clear()
