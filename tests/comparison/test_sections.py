"""What two runs searched, felt and corrected stands beside each other, step by step."""

from short_runs import GRASP
from told_runs import happens, saved, told

from handeye.comparison.findings import corrections, searches, stops
from handeye.comparison.pairing import TwoRuns
from handeye.comparison.parting import parting
from handeye.program import events as happened
from handeye.program.diagnosis.causes import PlacesTried
from handeye.program.guards import GuardKind

SEARCH, DOWN, NEXT = ("SEARCH", ()), "CHANGE  [0 0 -1]", "AOJ"


def advanced(count: int) -> tuple[str, list]:
    return NEXT, [happens(happened.SearchAdvanced, count=count, offset=(0.001 * count, 0.0))]


def met(value: float, guard: GuardKind = GuardKind.FORCE) -> tuple[str, list]:
    return DOWN, [happens(happened.GuardTripped, guard=guard, value=value, limit=13.9)]


def test_a_search_has_the_places_that_each_run_tried() -> None:
    runs = TwoRuns(told(SEARCH, advanced(1), advanced(2)), told(SEARCH))
    (found,) = searches(runs)
    assert found.a is not None
    assert found.b is not None
    assert (found.a.places, found.a.last, found.b.places, found.b.last) == (3, (0.002, 0.0), 1, (0.0, 0.0))
    assert (found.a.place.text, found.a.exhausted) == ("SEARCH  .07", False)


def test_a_search_that_ran_out_says_so() -> None:
    failed = NEXT, [happens(happened.ErrorRaised, number=6, cause=PlacesTried(places=49))]
    (found,) = searches(TwoRuns(told(SEARCH, failed), told(SEARCH)))
    assert [side is not None and side.exhausted for side in (found.a, found.b)] == [True, False]


def test_a_search_that_is_set_up_again_is_another() -> None:
    runs = TwoRuns(told(SEARCH, advanced(1), SEARCH, advanced(1), advanced(2)), told(SEARCH, advanced(1)))
    first, second = searches(runs)
    assert [side and side.places for side in (first.a, first.b)] == [2, 2]
    assert [side and side.places for side in (second.a, second.b)] == [3, None]


def test_a_motion_that_was_stopped_in_one_run_alone_did_not_end_alike() -> None:
    (found,) = stops(TwoRuns(told(met(14.0)), told((DOWN, ()))))
    assert not found.alike
    assert [side and (side.guard, side.value) for side in (found.a, found.b)] == [
        ("force", 14.0),
        (None, None),
    ]


def test_each_time_a_motion_is_made_stands_beside_the_same_time() -> None:
    found = stops(TwoRuns(told(met(14.0), met(15.0)), told(met(14.5), met(15.5), met(16.5))))
    values = [[side and side.value for side in (each.a, each.b)] for each in found]
    assert values == [[14.0, 14.5], [15.0, 15.5], [None, 16.5]]


def test_what_two_runs_saved_is_so_far_apart() -> None:
    (found,) = corrections(TwoRuns(told(saved(0.002)), told(saved(-0.001))))
    assert found.apart == 0.003
    (found,) = corrections(TwoRuns(told(saved(0.002)), told()))
    assert found.apart is None


def test_a_part_that_was_seen_is_a_correction() -> None:
    seen = "OPEN", [happens(happened.PartSeen, part="BASE", x=0.5, y=0.6, yaw=0.1)]
    (found,) = corrections(TwoRuns(told(seen), told(seen)))
    assert found.a is not None
    assert (found.a.kind, found.a.name, found.a.at, found.a.yaw, found.apart) == (
        "seen",
        "BASE",
        (0.5, 0.6),
        0.1,
        0.0,
    )


def test_steps_of_a_changed_script_stand_beside_those_they_come_from() -> None:
    more = GRASP.replace("SAVE    C1", "OPEN    .9\nSAVE    C1")
    (found,) = corrections(TwoRuns(told(saved(0.002)), told(saved(0.001), script=more)))
    assert found.a is not None
    assert found.b is not None
    assert (found.b.place.line, found.b.place.step) == (found.a.place.line + 1, found.a.place.step + 1)


# -- divergence -----------------------------------------------------------------------------------------------


def test_ways_part_where_one_run_is_stopped_and_the_other_is_not() -> None:
    missed = DOWN, [happens(happened.ErrorRaised, number=23, cause=None)]
    found = parting(TwoRuns(told(SEARCH, met(14.0)), told(SEARCH, missed)))
    assert found is not None
    assert found.a is not None
    assert found.b is not None
    assert [type(side.event) for side in (found.a, found.b)] == [happened.GuardTripped, happened.ErrorRaised]
    assert found.place is not None
    assert found.place.text == "CHANGE  [0 0 -1] .3"


def test_ways_do_not_part_by_how_much_was_felt_or_saved() -> None:
    assert parting(TwoRuns(told(saved(0.001), met(14.0)), told(saved(0.002), met(15.0)))) is None


def test_ways_part_where_a_run_ends() -> None:
    found = parting(TwoRuns(told(SEARCH), told(SEARCH, met(14.0))))
    assert found is not None
    assert found.a is None
    assert found.place is not None
    assert found.place.text == "SEARCH  .07"


def test_ways_part_at_another_answer_to_a_test() -> None:
    def tested(occurred: bool) -> tuple[str, list]:
        return "SKIPN", [happens(happened.ErrorTested, number=23, occurred=occurred)]

    found = parting(TwoRuns(told(tested(True)), told(tested(False))))
    assert found is not None
    assert found.place is not None
    assert found.place.text == "SKIPN   23"
