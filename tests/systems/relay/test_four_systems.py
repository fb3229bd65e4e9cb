"""Four systems hand a pin over to each other on one arm."""

from pathlib import Path

import pytest
from mixed_bench import TEXTS, mixed_relay
from msgspec.structs import replace
from relay_bench import call, on_disk, runner_of, to_end

from handeye.core.errors import BadFile, Refused
from handeye.runs.checkpoint_file import encode
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.relay.check import check_plan, inexpressible, misfits
from handeye.systems.relay.happenings import LegStarted
from handeye.systems.relay.plan import legs
from handeye.systems.relay.state import RelayCore

pytestmark = pytest.mark.slow
Run = tuple[Runner, list[str], dict[int, Checkpoint]]


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """The relay, run to its end, with the checkpoints before its steps."""
    kept: dict[int, Checkpoint] = {}
    runner = runner_of(mixed_relay(tmp_path_factory.mktemp("relay")))
    lines = to_end(runner, lambda now: kept.update({now.position: now.checkpoint()}))
    return runner, lines, kept


def first_of(kept: dict[int, Checkpoint], leg: int) -> int:
    """The number of steps that are done when a leg begins."""
    return next(n for n, each in kept.items() if leg_of(each) == leg)


def leg_of(checkpoint: Checkpoint) -> int:
    assert checkpoint.snapshot is not None
    state = checkpoint.snapshot.state
    assert isinstance(state, RelayCore)
    return state.leg


def test_each_program_carries_on_what_the_one_before_holds(run: Run) -> None:
    runner, _, _ = run
    assert runner.call is None
    started = [event for event in runner.events if isinstance(event, LegStarted)]
    assert [event.system for event in started] == ["program", "trig", "sigma", "ml", "program"]
    assert [bool(event.held) for event in started] == [False, False, True, True, True]


def test_each_program_finds_by_name_what_an_earlier_one_has_found(run: Run) -> None:
    state = run[0].system.state
    assert isinstance(state, RelayCore)
    assert state.record is not None
    stands, pin = (state.record.value(name, "place") for name in ("STANDS", "PIN"))
    assert pin[:2] - stands[:2] == pytest.approx([0.03, 0.01], abs=1e-4)  # as the MAL program moves it
    assert state.record.value("LIFTED", "height")[0] - state.record.hand[2] == pytest.approx(0, abs=1e-3)


@pytest.mark.parametrize("leg", [1, 2, 3])
def test_a_run_killed_within_a_leg_of_any_system_goes_on_byte_for_byte(run: Run, leg: int) -> None:
    runner, lines, kept = run
    again = Runner(on_disk(kept[first_of(kept, leg) + 2]))
    assert to_end(again) == lines
    assert encode(again.checkpoint()) == encode(runner.checkpoint())


@pytest.mark.parametrize(
    ("leg", "language", "old", "new", "told"),
    [
        (1, "trig", "Z BY -30", "Z BY -2", "#DOWN G, and not at the step FINISH"),
        (2, "mal", "> 11 THEN", "> 9 THEN", "THE ARM DID NOT GO THERE"),
        (2, "mal", "STANDSY + 10", "STANDSY - 300", "ABORT Y1 RAIL"),
    ],
)
def test_a_program_that_fails_calls_the_operator(
    run: Run, tmp_path: Path, leg: int, language: str, old: str, new: str, told: str
) -> None:
    text = next(text for name, text in TEXTS.items() if name.endswith(language))
    assert old in text
    before = run[2][first_of(run[2], leg)]
    plan = mixed_relay(tmp_path, **{language: text.replace(old, new)})
    runner = Runner(replace(before, setup=replace(before.setup, plan=plan)))
    to_end(runner)
    assert told in call(runner)


def test_a_program_in_ml_that_does_not_print_0_calls_the_operator(tmp_path: Path) -> None:
    runner = runner_of(mixed_relay(tmp_path, ml=TEXTS["lift.ml"].replace("-1500 1500", "1400 1500")))
    to_end(runner)
    assert "the last line that it printed is '1', not 0" in call(runner)


def test_what_a_leg_cannot_do_is_found_before_the_run(tmp_path: Path) -> None:
    def found(**changed: str) -> list[str]:
        return [each.sentence for each in misfits(mixed_relay(tmp_path, **changed))]

    assert found() == []
    assert found(trig=TEXTS["take.trig"].replace("FINISH", "DONE")) == [
        "no step is called FINISH, so the leg could never end successfully"
    ]
    assert found(mal=TEXTS["carry.mal"].replace("STANDS", "STOOD")) == [
        "no earlier leg finds the place STOOD", "no earlier leg finds the place STOOD",
    ]  # fmt: skip
    assert found(ml=TEXTS["lift.ml"].replace("DMOTOR 2", "DMOTOR 1")) == [
        "DMOTOR 1 -400 needs a motor that this arm does not have"
    ]
    with pytest.raises(BadFile, match="no earlier leg finds the place STOOD"):
        check_plan(mixed_relay(tmp_path, mal=TEXTS["carry.mal"].replace("STANDS", "STOOD")))


def test_the_check_names_the_lines_that_a_language_has_no_words_for(tmp_path: Path) -> None:
    from mixed_bench import RELAY

    plan = mixed_relay(tmp_path)
    assert [*inexpressible(plan)] == []  # the pump's program has no such stages
    assert RELAY.count("STAGE") == len(legs(plan))
    renamed = replace(plan, legs=(plan.legs[0], replace(plan.legs[1], stage="insert the aligning pins")))
    told = [each.sentence for each in inexpressible(renamed)]
    assert any(each.startswith("TRIG has no words for CENTER") for each in told)
    assert not any("SAVE" in each for each in told)


def test_undoing_stops_at_a_leg_that_cannot_be_undone(run: Run) -> None:
    kept = run[2]
    again = Runner(on_disk(kept[max(kept)]))
    with pytest.raises(
        Refused, match=r"`lift it`, which lift\.ml has done, cannot be undone; the arm can undo"
    ):
        again.order_reversal(0)
    own = len(again.system.executed) - 1
    again.order_reversal(own)
    again.step()
    assert len(again.system.executed) == own
    again = Runner(on_disk(kept[first_of(kept, 3) + 2]))
    with pytest.raises(Refused, match=r"`lift it`, which lift\.ml has done, cannot be undone$"):
        again.order_reversal(0)
