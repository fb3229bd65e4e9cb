"""The curve follower of figure 5: its rows on perfect motors, and the job on the arm with physics."""

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
import pytest
from msgspec.structs import replace

from handeye.core.errors import BadFile, NoSuchName
from handeye.core.resources import plans
from handeye.core.variation import WorldSpec
from handeye.program.events import OperatorCalled, to_line
from handeye.results.finishing import finished
from handeye.results.result import Result
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.ml.dashboard.kept import TABLES
from handeye.systems.ml.follow.circuit import IDLE, LONGEST, ROUND, Felt, followed
from handeye.systems.ml.follow.happenings import CircuitClosed
from handeye.systems.ml.follow.outlines import OUTLINES
from handeye.systems.ml.follow.page import FOLLOWED
from handeye.systems.ml.follow.referee import FELT, RADIUS, distance, judge, turning_number
from handeye.systems.ml.follow.task import FOLLOW, outline_of
from handeye.systems.ml.happenings import Traced
from handeye.systems.ml.ml_api import Ml
from handeye.systems.ml.realtime.happenings import Froze
from handeye.systems.ml.run.jobs import job_plan, job_setup
from handeye.systems.ml.run.system import ML

Command = Callable[..., tuple[int, str, str]]
SEED: Final = 3


def begun(outline: str = "square", seed: int = SEED, **set_values: float) -> Runner:
    world = WorldSpec(seed=seed)
    found = {name.replace("_", ".", 1): value for name, value in set_values.items()}
    if found:
        world = replace(world, overrides=replace(world.overrides, set=found))
    return Runner(Checkpoint(setup=job_setup(job_plan("follow", outline), world)))


def done(runner: Runner) -> Result:
    return finished(runner, advance(runner), Meter(), judged=True)


@cache
def square() -> tuple[Runner, Result]:
    runner = begun()
    return runner, done(runner)


# -- perfect motors --------------------------------------------------------------------------------------


class Touch(NamedTuple):
    """A touch on perfect motors."""

    statement: int
    y: int
    x: int
    turns: int  # left less right, before it


def followed_exactly(outline: str, statements: int) -> list[Touch]:
    """The touches of figure 5 on perfect motors."""
    plate = OUTLINES[outline]  # type: ignore[index]
    ml = Ml(
        (plans() / "curve_follower.ml").read_text(encoding="utf-8"),
        outline=[(round(y), round(x)) for x, y in plate.points],
    )
    ml.do(f"MOVE 0 0 {plate.start[1]:.0f} {plate.start[0]:.0f}")
    ml.do("TRACE")
    ml.begin()
    first = len(ml.events)
    ml.step(statements)
    touches, turns, at = list[Touch](), 0, 0
    for event in ml.events[first:]:
        if isinstance(event, Traced):
            at = event.statement
            turns += (at == 9) - (at == 18)
        elif isinstance(event, Froze):
            touches.append(Touch(at, event.positions[3], event.positions[4], turns))
    return touches


@pytest.mark.ml_row(35)
def test_on_the_square_the_follower_touches_24_times_a_circuit_where_it_was_computed() -> None:
    touches = followed_exactly("square", 500)
    top = [(2921, -2500), *((2976, x) for x in range(-1500, 3000, 1000))]
    assert [(touch.y, touch.x) for touch in touches[:6]] == top
    assert touches[6:12] == [Touch(7, y, 2949, 1) for y in range(2976, -3000, -1000)]
    assert touches[30:36] == [touch._replace(turns=touch.turns + 4) for touch in touches[6:12]]
    assert {touch.statement for touch in touches} == {4, 7}


@pytest.mark.ml_row(36)
def test_on_the_l_the_follower_touches_once_a_circuit_on_its_right_at_the_inner_corner() -> None:
    touches = followed_exactly("L", 500)
    right = [number for number, touch in enumerate(touches) if touch.statement == 16]
    assert right == [8, 40]
    assert touches[8][1:3] == (-24, 949)
    assert [touches[number].turns for number in (8, 8 + 32)] == [1, 1 + 4]


@pytest.mark.ml_row(37)
@pytest.mark.parametrize(("outline", "circuit", "rights"), [("U", 42, 2), ("disc", 25, 6)])
def test_a_circuit_is_four_left_turns_more_than_right_turns(outline: str, circuit: int, rights: int) -> None:
    touches = followed_exactly(outline, 620)
    first, last = touches[1], touches[1 + circuit]
    assert np.hypot(first.y - last.y, first.x - last.x) < 1500
    assert abs(last.turns - first.turns - ROUND) <= 1  # the circuit may be in the middle of a turn
    assert sum(touch.statement == 16 for touch in touches[:circuit]) == rights


# -- the detector -----------------------------------------------------------------------------------------


def walked(*steps: str, felt: Felt | None = None) -> Felt:
    """What is felt on a path of `F` (a touch ahead, then a step aside), `L` and `R` (turns)."""
    felt, x, y = felt or Felt(heading=(0, -1000)), 0.0, 0.0
    for number, step in enumerate("".join(steps)):
        (hx, hy), noticed = felt.heading, felt.noticed
        forward = {"L": (hy, -hx), "R": (-hy, hx)}.get(step, (hx, hy))
        if step == "F":
            noticed, (x, y) = (0, number + 1), (x - hy, y + hx)
        felt = followed(felt, forward, (x, y), noticed)
    return felt


def test_a_circuit_is_closed_by_four_left_turns_more_than_right_turns_where_it_began() -> None:
    assert walked("FFL" * 4).turns == ROUND
    assert not walked("FFL" * 4).closed  # a touch closes it
    assert walked("FFL" * 4, "F").closed
    assert not walked("FFL" * 3, "F").closed
    assert not walked("FFFFFL", "FFL" * 3, "F").closed  # it is elsewhere
    inner = walked("FFFL", "FFL", "FR", "FL", "FFL", "FFFL")
    assert (inner.left, inner.right, inner.turns) == (5, 1, ROUND)


def test_a_square_without_a_touch_is_no_turn_and_many_of_them_are_a_lost_follower() -> None:
    found_again = walked("FFL" * 3, "FF", "LLLL" * 2, "FL", "F")
    assert (found_again.idle, found_again.turns, found_again.left) == (2, ROUND, 12)
    lost = walked("F", "LLLL" * IDLE)
    assert lost.lost
    assert not walked("F", "LLLL" * (IDLE - 1)).lost
    assert (
        "the wand has gone 40 times around a square with sides of one step, and touched nothing" in lost.text
    )
    assert followed(replace(lost, missed=0, statements=LONGEST - 1), (0, 0), (0, 0), lost.noticed).lost


def test_both_statements_of_a_turn_count_as_one_turn() -> None:
    felt = Felt(heading=(0, -1000))
    for forward in ((0, -1000), (-1000, -1000), (-1000, 0)):  # 9, 10 and 11 of figure 5
        felt = followed(felt, forward, (0.0, 0.0), (0, 0))
    assert (felt.left, felt.right, felt.heading) == (1, 0, (-1000, 0))


# -- the referee ------------------------------------------------------------------------------------------


def touches_of(outline: str, off: float = 0.0) -> np.ndarray:
    """Touches every half inch around an outline, at a distance (mm) of the wand's surface."""
    corners, found = OUTLINES[outline].points, []  # type: ignore[index]
    for one, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        way = (end - one) / np.hypot(*(end - one))
        aside = np.array([way[1], -way[0]]) * (RADIUS + off) / 0.0254
        count = max(int(np.hypot(*(end - one)) // 500), 1)
        found += [one + (end - one) * (n + 0.5) / count + aside for n in range(count)]
    return np.array(found)


@pytest.mark.parametrize("outline", OUTLINES)
def test_the_referee_accepts_touches_around_an_outline_and_names_what_is_wrong(outline: str) -> None:
    true = OUTLINES[outline].points  # type: ignore[index]
    touches = touches_of(outline)

    def wrong(found: np.ndarray, now: np.ndarray = true) -> list[str]:
        return [name for name, each in judge(found, now, true).items() if not each.ok]

    assert wrong(touches) == []
    assert abs(turning_number(touches, true[0] * 0.9)) == 1
    assert wrong(touches_of(outline, FELT + 0.1)) == ["felt"]
    assert wrong(touches[: 2 * len(touches) // 3]) != []
    assert "turned" in wrong(np.concatenate((touches, touches)))
    assert "unmoved" in wrong(touches, true + 5)
    assert "found" in wrong(touches[:0])


def test_distances_are_negative_inside() -> None:
    square = OUTLINES["square"].points
    assert distance(np.array([0.0, 2900.0]), square) == pytest.approx(-100)
    assert distance(np.array([3300.0, 3400.0]), square) == pytest.approx(500)


# -- the job ----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_figure_5_comes_around_a_plate_and_the_outline_felt_is_the_true_one() -> None:
    runner, result = square()
    assert (result.exit_code, result.completed) == (0, True)
    assert [name for name, check in result.referee.items() if not check.ok] == []
    assert {*result.referee} == {"felt", "found", "turned", "unmoved"}
    assert result.figures is not None
    assert (result.figures["touches"], result.figures["left_turns"]) == (28, 4)
    assert sum(isinstance(event, CircuitClosed) for event in runner.events) == 1


@pytest.mark.slow
def test_a_follower_that_is_resumed_goes_on_to_the_same_events() -> None:
    first = begun()
    advance(first, steps=80)
    second = Runner(first.checkpoint())
    assert done(second).exit_code == 0
    whole, _ = square()
    assert [*map(to_line, second.events)] == [*map(to_line, whole.events)]


def test_a_follower_that_finds_its_wall_no_more_says_that_it_is_lost() -> None:
    runner = begun()
    advance(runner, steps=30)
    system = runner.system
    tracker = system.hardware.station.others[0]  # type: ignore[attr-defined]
    runner.system.hardware.station.bench.data.joint("plate").qpos[0] += 1.0  # type: ignore[attr-defined]
    tracker.felt = replace(tracker.felt, missed=ROUND * IDLE - 1, heading=(-1, 0))
    result = done(runner)
    assert (result.exit_code, result.completed) == (1, False)
    lost = (
        "the follower is lost: the wand has gone 40 times around a square with sides of one step, "
        "and touched nothing"
    )
    assert result.message.startswith(lost)


@pytest.mark.ml_row(38)
def test_without_an_object_the_follower_advances_to_the_end_of_travel_and_is_stopped() -> None:
    plan = replace(
        job_plan("follow"), job="", variant=""
    )  # the job would say earlier that the follower is lost
    runner = Runner(Checkpoint(setup=job_setup(plan, WorldSpec(seed=3))))
    result = done(runner)
    assert (result.exit_code, "M10" in result.message) == (1, True)
    assert sum(isinstance(event, OperatorCalled) for event in runner.events) == 1


@pytest.mark.slow
def test_a_plate_that_is_pushed_away_is_a_silent_failure() -> None:
    runner = begun()
    advance(runner, steps=240)
    runner.system.hardware.station.bench.data.joint("plate").qpos[0] += 2e-4  # type: ignore[attr-defined]
    result = done(runner)
    assert (result.exit_code, result.referee["unmoved"].ok) == (3, False)


@pytest.mark.slow
def test_the_page_shows_the_outline_and_is_made_again_from_the_folder(tmp_path: Path) -> None:
    runner, result = square()
    files = runner.kind.files(runner, None, result)  # type: ignore[arg-type]
    for name in (FOLLOWED, TABLES):
        (tmp_path / name).write_bytes(files[name])
    page = ML.page(tmp_path)
    assert page == files["report.html"]
    assert page is not None
    assert page.count(b'class="moved"') == 28
    assert "Follow, square: right" in page.decode()
    data = json.loads(files[FOLLOWED])
    data["true"][0][0] = 1e9
    (tmp_path / FOLLOWED).write_text(json.dumps(data))
    with pytest.raises(BadFile, match="impossibly far away"):
        ML.page(tmp_path)


def test_a_plate_lies_where_its_world_lays_it() -> None:
    corners = [FOLLOW.station("L", FOLLOW.world(WorldSpec(seed=seed)))[2].laid.corners for seed in (1, 1, 2)]
    assert corners[0] == corners[1] != corners[2]
    off = np.array(corners[2]) - OUTLINES["L"].points
    assert 0 < np.abs(off).max() < 2 * 2.0 / 0.0254
    with pytest.raises(NoSuchName, match="there is no outline `round`; the outlines are square, L, U, disc"):
        outline_of(job_plan("follow", "round"))


@pytest.mark.slow
def test_trials_count_and_show_a_follower_in_each_world(command: Command) -> None:
    code, out, _ = command(
        "trials", "follow", "--n", "2", "--seed", "3", "--outline", "L", "--jobs", "1", "--json"
    )
    found = json.loads(out)
    assert (code, found["variant"], found["n"]) == (0, "L", 2)
