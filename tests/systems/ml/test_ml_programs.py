"""What statements do: branches, loops, subroutines, tables, points, and errors that stop a program."""

import pytest
from ml_bench import FOLLOWER, executed, traced

from handeye.core.errors import InvalidInput
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.happenings import Nullified
from handeye.systems.ml.machine.surroundings import Stimulus
from handeye.systems.ml.ml_api import Ml

SQUARE = ((-3000, -3000), (-3000, 3000), (3000, 3000), (3000, -3000))  # corners (y, x)


def failing(line: str, ml: Ml | None = None) -> str:
    """The code of the error that a typed line makes."""
    with pytest.raises(MlError) as told:
        (ml or Ml()).do(line)
    return told.value.code


@pytest.mark.ml_row(1)
def test_a_numbered_line_is_stored_and_any_other_line_is_executed() -> None:
    ml = Ml("700 PRINT 7")
    assert ml.do("250 BRANCH 700") == []
    assert ml.do("LIST") == ["250 BRANCH 700", "700 PRINT 7"]
    assert ml.do("BRANCH 700") == ["7"]
    assert failing("BRANCH 701", ml) == "M07"


@pytest.mark.ml_row(5)
def test_a_chained_branch_goes_where_the_plain_one_goes() -> None:
    for target in ("&&17", "700"):
        text = f"10 LOAD 17 25\n20 LOAD 25 700\n30 BRANCH {target}\n40 PRINT 40\n700 PRINT 700"
        assert Ml(text).do("RUN") == ["700"]


@pytest.mark.ml_row(6)
def test_six_ampersands_are_followed() -> None:
    chain = "\n".join(f"LOAD {n} {n + 1}" for n in range(1, 6))
    assert Ml(f"{chain}\nLOAD 6 77").do("PRINT &&&&&&1") == ["77"]


@pytest.mark.ml_row(7)
def test_a_reference_to_a_variable_that_does_not_exist_is_an_error_when_it_is_followed() -> None:
    ml = Ml("LOAD 1 257")
    assert failing("PRINT &&1", ml) == "M05"
    assert failing("LOAD &1 5", ml) == "M05"


@pytest.mark.ml_row(8)
def test_a_destination_is_a_number() -> None:
    ml = Ml("LOAD 2 42\nLOAD 3 &2")
    assert ml.variable(3) == 42
    ml.do("LOAD &3 7")
    assert ml.variable(42) == 7


def test_the_most_negative_number_has_no_opposite() -> None:
    ml = Ml("LOAD 3 -32768")
    assert failing("PRINT -&3", ml) == "M04"


@pytest.mark.ml_row(27)
@pytest.mark.parametrize(("value", "expected"), [(-5, 10), (0, 20), (5, 30)])
def test_if_goes_three_ways(value: int, expected: int) -> None:
    stops = "\n".join(f"{n} PRINT {n}\n{n + 1} STOP" for n in (10, 20, 30))
    assert Ml(f"5 STOP\n{stops}").do(f"IF {value} 10 20 30") == [str(expected)]


@pytest.mark.ml_row(28)
def test_overflow_wraps_and_stays_until_it_is_cleared() -> None:
    ml = Ml("100 PRINT 100\n110 STOP\n200 PRINT 200\nLOAD 1 32767\nADD 1 1")
    assert ml.variable(1) == -32768
    ml.do("LOAD 1 5")
    ml.do("ADD 1 1")
    assert ml.do("BROVFL 100 200") == ["100"]
    ml.do("OVFLOFF")
    assert ml.do("BROVFL 100 200") == ["200"]


@pytest.mark.ml_row(29)
def test_a_comparison_sets_an_indicator_for_brcomp() -> None:
    ml = Ml("100 PRINT 100\n110 STOP\n200 PRINT 200\nGT? 3 2")
    assert ml.do("BRCOMP 100 200") == ["100"]
    ml.do("GT? 3 2")
    ml.do("COMPOFF")
    assert ml.do("BRCOMP 100 200") == ["200"]


@pytest.mark.ml_row(30)
@pytest.mark.parametrize(("passes", "expected"), [(3, 12), (1, 4), (0, 0), (-7, 0)])
def test_a_loop_in_a_loop_repeats_as_often_as_the_product_says(passes: int, expected: int) -> None:
    text = f"10 LOAD 1 0\n20 LOOPI {passes} 5\n30 LOOPJ 4 6\n40 ADD 1 1\n50 NEXTJ\n60 NEXTI"
    ml = executed(text)
    assert ml.variable(1) == expected
    if passes > 0:
        assert (ml.variable(5), ml.variable(6)) == (passes, 4)


@pytest.mark.ml_row(31)
def test_branch_and_link_returns_behind_the_call() -> None:
    text = "100 BAL 9 400\n105 PRINT 105\n110 STOP\n400 PRINT &9\n410 BRANCH &9"
    assert Ml(text).do("RUN") == ["105", "105"]


@pytest.mark.ml_row(33)
def test_position_and_goal_differ_in_mid_move_and_agree_at_rest() -> None:
    ml = Ml("5 POINT * 0 0 2000 0 0 0 0 0 0 0 0 0\n10 GOPOINT 5 1\n20 DELAY 5\n30 GETPOS 1 3\n40 GETGOL 2 3")
    ml.do("RUN")
    assert 0 < ml.variable(1) < ml.variable(2) == 2000
    ml.do("DELAY 100")
    ml.do("GETPOS 1 3")
    assert abs(ml.variable(1) - 2000) <= 6


@pytest.mark.ml_row(34)
def test_a_word_of_the_sensor_table_is_the_reading() -> None:
    ml = Ml(stimuli=[Stimulus(channel="range", value=0.05)])
    ml.do("DELAY 2")
    ml.do("GET 1 ST 8 7")
    ml.do("GETSEN 2 8")
    assert ml.variable(1) == ml.variable(2) == 500


@pytest.mark.ml_row(32)
def test_a_point_is_defined_and_returned_to() -> None:
    ml = Ml("5 POINT\n6 POINT\nMOVE 0 -300 2000 700")
    ml.do("DEFPOINT 5")
    ml.do("DMOVE 0 500 -900 100")
    ml.do("GOPOINT 5")
    assert [ml.position(motor) for motor in (2, 3, 4)] == pytest.approx([-300, 2000, 700], abs=15)
    assert failing("GOPOINT 6", ml) == "M08"
    assert failing("GOPOINT 7", ml) == "M08"
    assert ml.do("QPOINT") == [" ".join(map(str, (5, *ml.point(5))))]


@pytest.mark.ml_row(20)
def test_no_motion_command_moves_anything_while_a_flag_is_on() -> None:
    points = "5 POINT * 0 0 9 0 0 0 0 0 0 0 0 0\n6 POINT * 0 9 0 0 0 0 0 0 0 0 0 0"
    ml = Ml(points, stimuli=[Stimulus(channel="wand", value=1)])
    ml.do("SENSOR 1 -1 1")
    ml.do("DELAY 2")
    before = ml.time
    motions = (
        "MOVE 0 5", "DMOVE 0 5", "MOTOR 3 9", "DMOTOR 3 9", "HAND 9", "DHAND 9", "GOPOINT 5", "GOLINE 5 6",
        "GOMEAN 5 6", "GTRANS 9", "GROT 9", "JOY 5",
    )  # fmt: skip
    for line in motions:
        ml.do(line)
    assert len([event for event in ml.events if isinstance(event, Nullified)]) == len(motions)
    assert ml.time == before
    assert all(ml.position(motor) == 0 for motor in (2, 3, 4, 11))
    ml.do("LOAD 1 5")
    assert ml.variable(1) == 5


def test_an_immediate_subroutine_ends_at_its_return() -> None:
    ml = Ml("100 PRINT 1\n110 RETURN\n120 PRINT 2")
    assert ml.do("GOSUB 100") == ["1"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("10 BRANCH &1", "M07"), ("10 NEXTI", "M13"), ("10 RETURN", "M13"), ("10 MOTOR 6 5", "M09"),
        ("10 MOTOR 3 12000", "M10"), ("10 GET 1 &9 1 1", "M11"), ("10 PRINT &&1", "M05"), ("10 GOPOINT 5", "M08"),
        ("10 GOSUB 20\n20 GOSUB 10", "M13"), ("10 LEFT", "M12"), ("10 UPROCA", "M16"), ("10 TESTDO 1 1", "M15"),
        ("10 DISABLE\n20 DMOTOR 3 5", "M15"), ("10 LOOPI 0", "M13"), ("10 BRANCH 10 10 17", "M11"),
    ],
)  # fmt: skip
def test_an_error_in_a_running_program_is_an_emergency(text: str, code: str) -> None:
    ml = executed(f"{text}\n900 PRINT 900")
    assert ml.stopped.startswith(f"{code}: ")
    assert ml.stopped.endswith(")")
    assert not ml.running
    assert ml.read("EM", 1, 3) in (10, 20)
    assert failing("MOTOR 3 5", ml) == "M15"
    assert failing("RUN", ml) == "M14"
    ml.do("ENABLE")
    assert ml.do("PRINT 1") == ["1"]


def test_an_error_in_a_typed_line_changes_nothing() -> None:
    ml = Ml("LOAD 1 5")
    wrong = ("MULT 1 2 257", "DIVD 1 2 300", "DLOAD 256 5", "FILE VR 1 1 5 6", "BAL 1 10", "MOTOR 3 20000")
    for line in (*wrong, "LOOPI 2"):
        failing(line, ml)
    assert ml.variable(1) == 5
    assert ml.stopped == ""
    assert ml.do("MOTOR 3 20") == []


@pytest.mark.ml_row(41)
def test_trace_shows_the_statements_that_are_executed_with_their_values() -> None:
    ml = Ml("10 LOAD 1 5\n20 LOOPI 2\n30 ADD 1 &1\n40 NEXTI\nTRACE")
    ml.do("RUN")
    assert traced(ml)[1:] == [
        "10 LOAD 1 5",
        "20 LOOPI 2",
        "30 ADD 1 5",
        "40 NEXTI",
        "30 ADD 1 10",
        "40 NEXTI",
    ]


@pytest.mark.ml_row(57)
@pytest.mark.parametrize("share", [1, 3, 10, 100])
def test_the_number_of_statements_a_cycle_changes_the_time_only(share: int) -> None:
    text = "\n".join(f"{n} ADD 1 1" for n in range(1, 101))
    ml = Ml(text)
    ml.do(f"PUT CY 1 5 {share}")
    before = ml.time
    ml.do("RUN")
    assert ml.variable(1) == 100
    assert ml.time - before == pytest.approx(0.01 * (100 // share))


@pytest.mark.ml_row(39)
def test_a_program_comes_back_from_the_host_as_it_went() -> None:
    ml = Ml(FOLLOWER.read_text(encoding="utf-8"))
    ml.do("500 POINT * 1 -2 3 4 0 0 0 8 9 10 11 12")
    listed = ml.do("LIST")
    ml.do("CMSDUMP FOLLOW")
    ml.do("ERASE 1 5000")
    assert ml.do("LIST") == []
    ml.do("CMSLOAD FOLLOW")
    assert ml.do("LIST") == listed
    ml.do("QUIT")
    assert failing("CMSDUMP FOLLOW", ml) == "M16"


@pytest.mark.ml_row(53)
def test_every_command_can_be_given_between_the_statements_of_a_running_program() -> None:
    twice = {"UPROCA": lambda mos, x: mos.set_variable(7, 2 * x)}
    ml = Ml("10 ADD 1 1\n20 PRINT &1\n30 BRANCH 10", procedures=twice)
    ml.begin()
    ml.step(4)
    ml.do("LOAD 1 100")
    ml.do("MOTOR 3 200")
    ml.do("UPROCA 21")
    ml.step(3)
    assert ml.running
    assert (ml.variable(1), ml.variable(7), ml.position(3)) == (101, 42, 200)
    assert ml.do("PRINT &1") == ["101"]


def test_the_task_table_shows_and_changes_statements() -> None:
    ml = Ml("10 LOAD 1 -&&3\n20 MOTOR 3 500\n30 POINT * 1 2 3 4 0 0 0 8 9 10 11 12")
    assert ml.read("TK", 10, 3) == 3
    assert ml.read("TK", 10, 17) == (2 | 8) << 4
    ml.do("PUT TK 20 3 600")
    ml.do("PUT TK 30 4 33")
    assert ml.do("LIST 20") == ["20 MOTOR 3 600"]
    assert ml.point(30)[2] == 33
    assert failing("PUT TK 10 3 4", ml) == "M11"
    assert ml.read("CC", 1) == ord("E") << 8 | ord("N")


def test_the_gripper_moves_along_its_own_axes_and_turns_about_its_tips() -> None:
    ml = Ml("MOTOR 10 -9000")
    ml.do("GTRANS 0 0 1000")
    assert [ml.position(motor) for motor in (4, 3, 2)] == pytest.approx([-1000, 0, 0], abs=2)
    ml.do("GROT 0 9000")
    assert [ml.position(motor) for motor in (8, 9, 10)] == pytest.approx([0, 0, 0], abs=2)
    assert [ml.position(motor) for motor in (4, 3, 2)] == pytest.approx([-1000 - 5906, 0, -5906], abs=10)


def test_goline_goes_to_the_foot_of_the_perpendicular() -> None:
    ml = Ml("5 POINT * 0 0 0 0 0 0 0 0 0 0 0 0\n6 POINT * 0 0 1000 1000 0 0 0 0 0 0 0 0\nMOTOR 3 1000")
    ml.do("GOLINE 5 6")
    assert [ml.position(motor) for motor in (3, 4)] == pytest.approx([500, 500], abs=6)
    ml.do("GOMEAN 5 6")
    assert [ml.position(motor) for motor in (3, 4)] == pytest.approx([500, 500], abs=6)


def test_the_joystick_fills_a_point_when_the_record_key_is_pressed() -> None:
    ml = Ml("5 POINT\n10 JOY 5\n20 PRINT 20\nPUT JY 3 1 3\nPUT JY 3 2 10\nPUT FK 1 1 1")
    assert ml.do("RUN") == ["20"]
    assert ml.point(5) == (0,) * 12


@pytest.mark.ml_row(35)
def test_the_follower_as_printed_goes_round_the_square() -> None:
    ml = Ml(FOLLOWER.read_text(encoding="utf-8"), outline=SQUARE)
    ml.do("MOVE 0 0 8000 -2500")
    ml.do("TRACE")
    ml.begin()
    ml.step(330)
    numbers = [int(each.split()[0]) for each in traced(ml)]
    lefts = [at for at, number in enumerate(numbers) if number == 9]
    circuit = numbers[lefts[0] : lefts[4]]
    assert [circuit.count(number) for number in (13, 9, 18)] == [24, 4, 0]
    assert ml.running


def test_what_is_typed_is_never_lost_in_an_error() -> None:
    ml = Ml()
    with pytest.raises(InvalidInput, match="did you mean `MOTOR`"):
        ml.do("MOTR 3 5")


def test_a_subroutine_can_be_called_again_when_it_has_returned() -> None:
    text = "10 GOSUB 100\n20 GOSUB 100\n30 PRINT &1\n40 STOP\n100 ADD 1 1\n110 RETURN"
    assert Ml(text).do("RUN") == ["2"]


@pytest.mark.parametrize(
    ("sensors", "goes"),
    [("1", "10"), ("2", "20"), ("-1", "20"), ("-2", "10"), ("2 1", "10"), ("-1 2", "20"), ("", "10")],
)
def test_a_branch_asks_for_flags_that_are_on_or_with_a_minus_off(sensors: str, goes: str) -> None:
    ml = Ml("10 PRINT 10\n15 STOP\n20 PRINT 20", stimuli=[Stimulus(channel="wand", value=1)])
    ml.do("SENSOR 1 -1 1")
    ml.do("DELAY 2")
    assert ml.do(f"BRANCH 10 20 {sensors}") == [goes]


def test_errors_trace_session_and_host_are_in_tables() -> None:
    ml = Ml("10 ADD 1 5\n20 MOTOR 3 100\nTRACE")
    ml.do("RUN")
    ml.do("CMSDUMP X")
    assert [ml.read("TR", 1, word) for word in (1, 3, 4)] == [0, 0, 0]
    assert [ml.read("TR", 2, word) for word in (1, 3, 4)] == [20, 3, 100]
    assert [ml.read("TR", 3, word) for word in (1, 3, 4)] == [10, 1, 5]
    texts = {"LG": "CMSDUMP X", "ER": "a command does not exist"}
    for table, text in texts.items():
        words = [ml.read(table, 1, word) for word in range(1, 33)]
        assert b"".join(word.to_bytes(2, "big") for word in words).rstrip(b"\0 ") == text.encode()
    assert [ml.read("HL", 1, word) for word in (1, 2, 3)] == [1, 1, 0]
    assert failing("PUT LG 1 1 5", ml) == "M11"


def test_a_statement_in_place_of_a_point_has_no_positions() -> None:
    ml = Ml("5 POINT * 1 2 3 4 0 0 0 8 9 10 11 12\n5 STOP")
    assert ml.listing == ["5 STOP"]
    ml.do("5 POINT")
    assert ml.listing == ["5 POINT"]
