"""What the checker finds by following a program: each trap is seen, and nothing like it is accused."""

from pathlib import Path

import msgspec
import pytest
from al_support import LISTING, codes, diagnose

from handeye import al
from handeye.core.codes import CODES
from handeye.core.source import Source
from handeye.program.flow_operations import Advance, Jump, Save
from handeye.program.guards import Against, Torque
from handeye.program.motion_operations import Change, Close, Move
from handeye.program.taught import load_taught

PLANS = Path(__file__).parents[2] / "plans"
DOWN = "STOP 50\nCHANGE [0 0 -1] 1\n"


@pytest.mark.parametrize("name", ["water_pump", "water_pump_1973"])
def test_pump_scripts_have_nothing_to_be_warned_of(name: str) -> None:
    source = Source(name=f"{name}.al", text=(PLANS / f"{name}.al").read_text(encoding="utf-8"))
    assert al.compile_text(source, load_taught(PLANS / f"{name}.toml"))[1] == []


def test_the_same_is_taught_for_the_careful_program_as_for_that_of_1973() -> None:
    careful, of_1973 = (load_taught(PLANS / f"water_pump{year}.toml") for year in ("", "_1973"))
    more = {
        name: careful.positions.pop(name)
        for name in (
            "ASIDE",
            "BACK",
            "CRANKB",
            "CRANKEND",
            "DEND",
            "GOFF",
            "P1END",
            "P2END",
            "Q2Y",
            "TABLE",
            "TABLEL",
            *(f"FACE{hole}" for hole in (1, 2, 4, 5)),
            *(f"HEAD{hole}" for hole in range(6)),
            "RIM1",
            "RIM2",
            "T1END",
            "T2END",
            "TOPEND",
            "TOPUP",
        )
    }
    careful.held["TOP"] = msgspec.structs.replace(careful.held["TOP"], positions=("TOP",))  # TOPUP, too
    holes = careful.parts["PUMP"].screw_holes  # INSPECT of the careful program also looks for a torn gasket
    careful.parts["PUMP"] = msgspec.structs.replace(careful.parts["PUMP"], screw_holes=())
    assert (careful, len(more), len(holes)) == (of_1973, 27, 6)


def test_listing_of_1973_has_nothing_to_be_warned_of() -> None:
    assert diagnose(LISTING) == []


@pytest.mark.parametrize(
    "text",
    [
        f"{DOWN}SKIPE 23\nPARK",
        f"{DOWN}SKIPE 1\nSKIPE 23\nPARK\nPARK",
        "TORQUE 5\nCHANGE [0 0 -1] 1\nSKIPN 24\nPARK",
        "TOUCH 3\nMOVE T\nSKIPN 25\nPARK",
        "STOP NIL [0 0 30]\nCHANGE [0 0 -1] 1\nSKIPN 23\nPARK",
        "CLOSE .1 .2\nSKIPE 7\nPARK",
        "CENTER .1\nSKIPE 2\nPARK",
        "SEARCH .1\nL: MOVE T\nAOJ L\nL2: SKIPE 6\nJUMP L2",
    ],
)
def test_error_the_action_can_raise_may_be_tested(text: str) -> None:
    assert not {"error-never-raised", "test-without-action"} & set(codes(text))


@pytest.mark.parametrize(
    ("text", "help"),
    [
        (
            "CHANGE [0 0 -1] 1\nSKIPE 23\nPARK",
            "a motion after a `STOP` raises error 23 if the hand never presses with the force of the `STOP`",
        ),
        (
            f"{DOWN}SKIPE 24\nPARK",
            "a motion after a `TORQUE` raises error 24 if the screwdriver never reaches the torque",
        ),
        (
            f"{DOWN}SKIPE 25\nPARK",
            "a motion after a `TOUCH` raises error 25 if no finger touches anything",
        ),
        ("CLOSE .1\nSKIPE 7\nPARK", "only a `CLOSE` with a maximum raises error 7"),
        (
            "CLOSE .1\nSKIPE 23\nPARK",
            "a motion after a `STOP` raises error 23 if the hand never presses with the force of the `STOP`",
        ),
        ("CLOSE .1\nSKIPE 8\nPARK", "errors that can occur here: 2, 5, 50, 51"),
    ],
)
def test_error_the_action_cannot_raise_is_told_with_what_would(text: str, help: str) -> None:
    (diagnostic,) = diagnose(text)
    assert (diagnostic.code, diagnostic.help) == ("error-never-raised", help)


def test_second_test_of_one_error_can_never_see_it() -> None:
    assert codes(f"{DOWN}SKIPN 23\nSKIPE 23\nPARK") == ["test-without-action"]
    assert codes(f"{DOWN}SKIPE 23\nSKIPE 23\nPARK") == ["error-never-raised"]


@pytest.mark.parametrize("between", ["MOVE T\nSAVE H\n", "LOAD 0\n", "TOOL 0\n"])
def test_test_behind_what_is_no_action_is_reported(between: str) -> None:
    (diagnostic,) = diagnose(f"CLOSE .1\n{between}SKIPE 2\nPARK")
    assert diagnostic.code == "test-without-action"
    assert diagnostic.secondary[0].text == "this raises no error"


def test_test_reached_by_a_jump_from_nowhere_near_an_action_is_reported() -> None:
    assert codes("MOVE T\nSAVE H\nJUMP L\nL: SKIPE 23\nPARK") == ["test-without-action"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("L: MOVE T\nJUMP L", "endless-loop"),
        ("L: PARK\nCLOSE\nSKIPE 2\nJUMP L\nJUMP L", "endless-loop"),
        ("PARK\nL: TOOL 0\nJUMP L", "idle-loop"),
        ("L: MOVE T\nJUMP L\nPARK", "endless-loop"),
        ("PARK\nA: TOOL 0\nJUMP B\nB: JUMP A", "idle-loop"),
    ],
)
def test_loop_without_exit_is_told_once(text: str, code: str) -> None:
    assert codes(text) == [code]


@pytest.mark.parametrize(
    "text",
    [
        "L: CLOSE .1\nSKIPE 2\nJUMP L",
        "SEARCH .1\nL: MOVE T\nAOJ L",
        "L: MOVE T\nWAIT NEXT\nJUMP L",
    ],
)
def test_loop_that_can_end_or_waits_for_the_operator_is_none_of_these(text: str) -> None:
    assert codes(text) == []


def test_code_nothing_leads_to_is_reported_once_a_stretch() -> None:
    assert codes("JUMP L\nOPEN 1\nOPEN 2\nL: PARK") == ["unreachable-code"]
    assert codes("JUMP L\nOPEN 1\nSEARCH .1\nMOVE T\nSKIPE 2\nL: PARK") == ["unreachable-code"]


def test_label_of_code_nothing_leads_to_is_not_told_as_well() -> None:
    assert codes("JUMP B\nA: PARK\nB: OPEN 1") == ["unreachable-code"]


def test_macro_is_at_fault_only_if_every_call_is() -> None:
    macro = "DEFINE SEEN\nSKIPE 2\nWAIT NO\n\n"
    assert codes(macro + "CLOSE .1\nSEEN\nPARK\nSEEN\nPARK") == []
    assert codes(macro + "PARK\nSEEN\nPARK\nSEEN\nPARK") == ["error-never-raised"]


def test_search_ends_behind_its_last_aoj() -> None:
    assert codes("SEARCH .1\nL: MOVE T\nAOJ L\nSEARCH .1\nPARK")[-1] == "unreachable-code"
    assert codes(f"SEARCH .1\nL: MOVE T\n{DOWN}SKIPE 23\nAOJ L\nSEARCH .1") == ["search-without-aoj"]


def test_order_counts_along_jumps_and_not_along_lines() -> None:
    assert codes("JUMP A\nB: MOVE T\nAOJ B\nA: SEARCH .1\nJUMP B") == []


def test_a_count_whose_jump_leads_on_is_begun_anew_by_no_round() -> None:
    text = "L: ASSIGN N 2\nMOVE T\nSOJG N ON\nPARK\nON: CLOSE .1\nSKIPN 2\nJUMP L\nOPEN 1"
    assert codes(text) == []


def test_flow_is_not_looked_at_while_a_mistake_stands() -> None:
    assert codes("L: OPEN 9\nSKIPE 24\nAOJ L\nJUMP L") == ["number-out-of-range"]


def test_unused_names_are_told_where_they_are_written() -> None:
    text = "TRANS A [1 2 3 0 0 0]\nL: PARK\nDEFINE M\nOPEN 1\n\n"
    assert [(d.code, text[d.primary.span.start]) for d in diagnose(text)] == [
        ("unused-position", "A"),
        ("unused-label", "L"),
        ("unused-macro", "M"),
    ]


def test_taught_positions_need_not_be_used() -> None:
    assert codes("OPEN 1") == []


def test_positions_written_for_park_turn_and_aim_are_used() -> None:
    text = "TRANS A [1 2 3 0 0 0]\nTRANS B [1 2 3 0 0 0]\nTURN A 9\nAIM B"
    assert codes(text) == []


def test_what_the_flow_shows_is_never_more_than_a_warning() -> None:
    flow = ("aoj-without-search", "endless-loop", "idle-loop", "test-without-action", "unreachable-code")
    assert {CODES[code].severity for code in flow} == {"warning"}


def test_only_actions_raise_and_what_they_raise_depends_on_how_they_are_told() -> None:
    assert not Jump().raises
    assert not Save(name="H").raises
    assert Advance().raises == {5, 6}
    assert 23 in Move(goal="T", guards=(Against(force=1.0),)).raises
    assert 24 in Change(displacement=(0, 0, 1), guards=(Torque(torque=1.0),)).raises
    assert Close(maximum=0.1).raises - Close().raises == {7}


@pytest.mark.parametrize(
    "text",
    [
        "MOVE T\nSAVE D\nMOVE T\nRESTORE D",
        "L: MOVE T\nRESTORE D\nCLOSE .1\nSKIPE 2\nJUMP END\nSAVE D\nJUMP L\nEND: PARK",
        "MOVE T\nCLOSE .1\nSKIPE 2\nSAVE D\nMOVE T\nRESTORE D",
        "DEFINE BACK\nMOVE T\nRESTORE D\n\nBACK\nPARK\nSAVE D\nBACK",
        "MOVE T\nRESTORE D\nCLOSE .1\nSAVE D",
    ],
)
def test_a_difference_saved_on_some_way_or_for_the_same_goal_may_be_restored(text: str) -> None:
    assert codes(text) == []


@pytest.mark.parametrize(
    "text",
    [
        "MOVE T\nRESTORE D\nMOVE P\nSAVE D",
        "MOVE T\nCLOSE .1\nSKIPE 2\nJUMP A\nSAVE D\nJUMP END\nA: MOVE T\nRESTORE D\nEND: PARK",
        "DEFINE BACK\nMOVE T\nRESTORE D\n\nBACK\nBACK\nPARK\nSAVE D",
        "MOVE T\nSAVE E\nMOVE T\nRESTORE E\nRESTORE D LEVEL\nMOVE T\nSAVE D",
    ],
)
def test_a_difference_saved_only_later_or_on_another_way_shifts_nothing(text: str) -> None:
    (diagnostic,) = diagnose(text)
    (only,) = diagnostic.secondary
    assert (diagnostic.code, text[diagnostic.primary.span.start]) == ("never-saved", "D")
    assert text[only.span.start - 5 : only.span.end] == "SAVE D"


def test_many_ways_on_which_many_differences_are_saved_are_followed_in_no_time() -> None:
    ways = "".join(f"CLOSE .1\nSAVE D{i}\nSKIPE 2\nJUMP TAIL\n" for i in range(1500))
    tail = "".join(f"MOVE T\nRESTORE D{i}\n" for i in range(1500))
    assert "never-saved" not in codes(f"MOVE T\n{ways}TAIL: PARK\n{tail}")
