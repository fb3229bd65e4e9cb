"""The listing of 1973 and the meaning of its words in SI."""

import pytest
from al_support import LISTING, compiled, diagnose, moves, only

from handeye.core.units import DEGREE, INCH, OUNCE_FORCE, OUNCE_INCH, RPM
from handeye.ports.camera import CLOSE_UP, WIDE
from handeye.program.flow_operations import Advance, Load, Save, Search, Tool, Wait
from handeye.program.guards import Against, Force, Torque
from handeye.program.motion_operations import Change, Close, Restore, Travel, Turn
from handeye.program.vision_operations import Lens, Look


@pytest.mark.row(1)
def test_pin_insertion_compiles_as_printed() -> None:
    assert diagnose(LISTING) == []
    assert len(compiled(LISTING).steps) == 15


def test_pin_insertion_compiles_with_the_other_reading_of_its_last_line() -> None:
    other = LISTING.replace("OPEN  1 ", "WAIT  1 ")
    assert [d.code for d in diagnose(other)] == [
        "wait-for-time"
    ]  # accepted; but nobody would write it so today
    assert compiled(other).steps[-1].operation == Wait(message="1")


def test_steps_carry_line_and_statement() -> None:
    step = compiled(LISTING).steps[4]
    assert (step.line, step.text, step.stage) == (5, "MOVE  T", 0)


def test_only_moves_of_the_search_loop_take_the_search_offset() -> None:
    assert [move.searching for move in moves(compiled(LISTING))] == [False, False, True]


def test_both_advances_go_back_to_the_head_of_the_loop() -> None:
    steps = compiled(LISTING).steps
    assert [step.next for step in steps if isinstance(step.operation, Advance)] == [4, 4]


def test_change_goes_its_distance_along_the_direction() -> None:
    assert only("CHANGE [0 0 -1] 0.6", Change).displacement == pytest.approx((0, 0, -0.6 * INCH))


def test_change_takes_only_the_direction_of_its_vector() -> None:
    assert only("CHANGE [0 0 -2] 0.6", Change) == only("CHANGE [0 0 -1] 0.6", Change)


def test_change_takes_a_speed_in_inches_a_second() -> None:
    assert only("CHANGE [1 0 0] 1 2", Change).speed == pytest.approx(2 * INCH)


def test_stop_on_a_vector_is_a_force_in_newtons() -> None:
    guards = only("STOP [0 0 -50]\nCHANGE [0 0 -1] 1", Change).guards
    assert guards == (Force(force=(0.0, 0.0, -50 * OUNCE_FORCE)),)


def test_stop_on_a_number_is_a_force_against_the_motion() -> None:
    assert only("STOP 50\nCHANGE [0 0 -1] 1", Change).guards == (Against(force=50 * OUNCE_FORCE),)


def test_torque_stops_the_next_motion_in_newton_metres() -> None:
    assert only("TORQUE 300\nTURN T 90", Turn).guards == (Torque(torque=300 * OUNCE_INCH),)


def test_force_presses_during_the_next_change_beside_its_stop() -> None:
    change = only("FORCE [0 0 -9]\nSTOP 5\nCHANGE [1 0 0] 1", Change)
    assert change.press == pytest.approx((0, 0, -9 * OUNCE_FORCE))
    assert change.guards == (Against(force=5 * OUNCE_FORCE),)


def test_modifiers_hold_for_the_next_motion_only() -> None:
    program = compiled("STOP 5\nMOVE T\nMOVE T")
    assert [len(move.guards) for move in moves(program)] == [1, 0]


def test_units_of_the_other_words_are_converted_to_si() -> None:
    assert only("SEARCH .07", Search).step == pytest.approx(0.07 * INCH)
    assert only("TURN T -90", Turn).angle == pytest.approx(-90 * DEGREE)
    assert only("TOOL 200", Tool).speed == pytest.approx(200 * RPM)
    assert only("LOAD 24", Load).weight == pytest.approx(24 * OUNCE_FORCE)
    assert only("LENS 25", Lens).focal_length == pytest.approx(0.025)
    assert only("TRAVEL .3 .5", Travel).maximum == pytest.approx(0.5 * INCH)


def test_lenses_are_those_of_the_turret() -> None:
    lenses = [only(f"LENS {mm}", Lens).focal_length for mm in (25, 50)]
    assert lenses == [WIDE, CLOSE_UP] == [*Lens.choices["focal_length"]]


def test_close_without_numbers_has_no_limits() -> None:
    assert only("CLOSE", Close) == Close(minimum=0.0, maximum=None)


def test_trans_gives_a_position_in_metres_and_radians() -> None:
    position = compiled("TRANS A [1 2 3 0 90 180] of BASE\nMOVE A").positions["A"]
    assert position.at == pytest.approx((INCH, 2 * INCH, 3 * INCH, 0, 90 * DEGREE, 180 * DEGREE))
    assert position.of == "BASE"


def test_restores_become_part_of_the_move_before_them() -> None:
    (move,) = moves(compiled("SAVE D\nSAVE E\nMOVE T\nRESTORE D\nRESTORE E level"))
    assert move.restore == (Restore(name="D"), Restore(name="E", level=True))


def test_what_is_saved_can_be_restored_and_shifts_nothing_else() -> None:
    program = compiled("MOVE T\nSAVE H\nMOVE T\nRESTORE H")
    assert program.steps[1].operation == Save(name="H")
    assert moves(program)[1] == moves(compiled("SAVE H\nMOVE T\nRESTORE H"))[0]


def test_restore_of_a_name_never_saved_is_no_more_than_a_warning() -> None:
    assert [d.severity for d in diagnose("MOVE T\nRESTORE H")] == ["warning"]
    assert moves(compiled("MOVE T\nRESTORE H"))[0].restore == (Restore(name="H"),)


def test_wait_takes_its_words_with_or_without_quotes() -> None:
    assert only("WAIT NO  PIN ;why", Wait).message == "NO  PIN"
    assert only('WAIT "a; b"', Wait).message == "a; b"


def test_park_moves_to_the_position_of_that_name() -> None:
    assert moves(compiled("PARK"))[0].goal == "PARK"


def test_look_can_hold_the_target_voltage() -> None:
    assert only("look AFTER hold", Look) == Look(picture="AFTER", hold_target=True)


def test_steps_belong_to_the_stage_above_them() -> None:
    program = compiled('PARK\nSTAGE "one"\nPARK\nSTAGE "two"\nPARK\nPARK')
    assert program.stages == ("program", "one", "two")
    assert [step.stage for step in program.steps] == [0, 1, 2, 2]


def test_program_has_its_name_and_everything_taught() -> None:
    program = compiled("PARK")
    assert (program.name, program.source, set(program.positions)) == ("test", "PARK", {"P", "T", "PARK"})
