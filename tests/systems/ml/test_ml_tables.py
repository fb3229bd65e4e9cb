"""The thirty tables: their layouts, their words read and written while the machine runs."""

from random import Random

import pytest
from level_bench import pressed, rig

from handeye.core.errors import BadFile
from handeye.core.mutable_records import copied
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.language.commands import COMMANDS
from handeye.systems.ml.realtime.happenings import TableWritten
from handeye.systems.ml.tables.layout import SHAPES
from handeye.systems.ml.tables.records import EmergencyLine, InterlockLine
from handeye.systems.ml.tables.store import ArmMemory

WRITABLE = [
    (table, line, word)
    for table, shape in SHAPES.items()
    for line in {1, shape.lines}
    for word in range(1, shape.words + 1)
    if table in ("MT", "ST", "AI", "AO", "DI", "DO", "WS", "CA", "VR", "US", "TM", "MX", "HL")
]


def test_there_are_thirty_tables_with_names_of_two_letters_that_no_command_has() -> None:
    assert len(SHAPES) == 30
    assert all(len(name) == 2 and name.isupper() for name in SHAPES)
    assert "IF" not in SHAPES
    assert {name for name in SHAPES if name in COMMANDS and COMMANDS[name].code != name} == set()
    assert (SHAPES["MT"].lines, SHAPES["MT"].words, SHAPES["ST"].lines, SHAPES["ST"].words) == (
        12,
        16,
        16,
        16,
    )
    assert SHAPES["TK"].lines * SHAPES["TK"].words == 100_000
    assert (SHAPES["AI"].lines, SHAPES["AO"].lines, SHAPES["DI"].lines, SHAPES["DO"].lines) == (64, 8, 21, 16)


@pytest.mark.parametrize(("table", "line", "word"), WRITABLE)
def test_a_word_that_is_written_is_read_back(table: str, line: int, word: int) -> None:
    level = rig(on=False).right
    level.write(table, line, word, -123)
    assert level.read(table, line, word) == -123


@pytest.mark.ml_row(34)
@pytest.mark.parametrize(
    ("table", "line", "word", "message"),
    [
        ("XX", 1, 1, "there is no table XX; the tables are MT, ST"),
        ("fine", 1, 1, "there is no table fine"),
        ("MT", 13, 1, "there is no line 13 in MT; its lines are 1 to 12"),
        ("MT", 0, 1, "there is no line 0 in MT; its lines are 1 to 12"),
        ("ST", 5, 17, "there is no word 17 in a line of ST; the words are 1 to 16"),
    ],
)
def test_a_word_that_does_not_exist_is_refused(table: str, line: int, word: int, message: str) -> None:
    level = rig().right
    for access in (lambda: level.read(table, line, word), lambda: level.write(table, line, word, 1)):
        with pytest.raises(MlError, match=rf"^M11: {message}"):
            access()


@pytest.mark.parametrize(
    ("table", "word"), [("EM", 6), ("AR", 1), ("AR", 2), ("SF", 2), ("CY", 1), ("PI", 1), ("FE", 1)]
)
def test_no_program_switches_the_pump_on_or_an_interlock_off_by_writing_a_word(table: str, word: int) -> None:
    level = rig(on=False).right
    with pytest.raises(MlError, match=rf"^M11: word {word} of {table} cannot be written$"):
        level.write(table, 1, word, 1)


def test_a_word_of_the_motor_table_takes_effect_in_the_next_cycle() -> None:
    arm = rig()
    arm.right.start({3: 4000})
    arm.pass_cycles(3)
    before = arm.right.read("MT", 3, 5)
    arm.right.write("MT", 3, 8, 10)
    arm.machine.cycle()
    assert arm.right.read("MT", 3, 5) - before == 10
    (event,) = arm.seen(TableWritten)
    assert (event.table, event.line, event.word, event.was, event.value) == ("MT", 3, 8, 79, 10)


def test_a_strategic_goal_that_is_written_moves_the_motor() -> None:
    arm = rig()
    arm.right.write("MT", 3, 4, 300)
    arm.pass_cycles(10)
    assert arm.right.position(3) == 300


def test_a_strategic_goal_that_is_written_beyond_the_travel_is_not_followed_there() -> None:
    arm = rig()
    arm.right.write("MT", 11, 4, -500)
    arm.pass_cycles(10)
    assert arm.right.position(11) == 0


def test_a_tactical_goal_that_is_written_is_where_the_set_point_goes_on() -> None:
    arm = rig()
    arm.right.start({3: 4000})
    arm.pass_cycles(2)
    arm.right.write("MT", 3, 5, 2000)
    arm.machine.cycle()
    assert arm.right.read("MT", 3, 5) == 2079


def test_positions_have_a_history_of_two_cycles() -> None:
    arm = rig()
    arm.right.start({3: 4000})
    arm.pass_cycles(6)
    assert [arm.right.read("MT", 3, word) for word in (1, 2, 3)] == [394, 315, 236]


def test_scale_and_zero_of_a_sensor_are_words() -> None:
    arm = rig(pressed(100))
    for word, value in ((4, 3), (5, 2), (6, 20)):
        arm.right.write("ST", 5, word, value)
    arm.pass_cycles(1)
    assert arm.right.reading(5) == 130


def test_the_base_is_set_by_a_digital_word_and_all_other_motors_by_analog_outputs() -> None:
    arm = rig()
    arm.move({1: 500, 4: 70})
    assert (arm.right.read("DO", 16, 1), arm.right.read("AO", 3, 1)) == (500, 70)
    outputs = sorted(motor.output for motor in arm.right.spec.motors if motor.output > 0)
    assert outputs == [*range(1, 9)]


def test_timers_count_down_in_hundredths_of_a_second() -> None:
    arm = rig()
    arm.right.write("TM", 2, 1, 3)
    arm.pass_cycles(2)
    assert arm.right.read("TM", 2, 1) == 1
    arm.pass_cycles(5)
    assert arm.right.read("TM", 2, 1) == 0


def test_goals_and_cycles_are_counted() -> None:
    arm = rig()
    arm.right.statement(40)
    arm.move({3: 100})
    assert [arm.right.read("GO", 1, word) for word in (1, 3, 4)] == [2, 40, 3]
    assert [arm.right.read("CY", 1, word) for word in (1, 6, 7, 8)] == [3, 0, 1, 0]


def test_external_tables_are_paged_into_the_frame_that_was_used_least_recently() -> None:
    arm = rig()
    for line in range(1, 145, 16):  # nine pages
        arm.right.read("US", line, 1)
        arm.machine.cycle()
    pages = [arm.right.read("PF", frame, 2) for frame in range(1, 9)]
    assert pages == [8, 1, 2, 3, 4, 5, 6, 7]


def test_both_arms_have_the_variables_in_common_and_their_motors_apart() -> None:
    arm = rig(sides=("right", "left"))
    arm.right.write("VR", 7, 1, 42)
    arm.right.write("MT", 3, 9, 11)
    assert arm.left.read("VR", 7, 1) == 42
    assert arm.left.read("MT", 3, 9) == 6


def test_whatever_words_are_written_while_it_runs_nothing_is_raised() -> None:
    draw = Random(5)  # noqa: S311 - no secret
    for _ in range(25):
        arm = rig(pressed(500, since=20))
        for _ in range(60):
            table = draw.choice(("MT", "ST", "AI", "DI", "DO", "AO", "WS", "CA", "CY", "AR", "TM"))
            shape = SHAPES[table]
            line, word = draw.randint(1, shape.lines), draw.randint(1, shape.words)
            value = draw.choice((0, 1, -1, 32_767, -32_768, draw.randint(-300, 300)))
            try:
                arm.right.write(table, line, word, value)
                arm.right.start({3: draw.randint(-500, 500)})
            except MlError:
                pass
            arm.machine.cycle()
        assert arm.machine.now == 60


def test_a_saved_state_of_other_sizes_or_with_impossible_words_is_refused() -> None:
    level = rig().right
    wrong = [copied(level.memory) for _ in range(4)]
    wrong[0].AI.append(0)
    wrong[1].AR[0].posted = 9
    wrong[2].EM[0] = EmergencyLine(cause=99)
    wrong[3].SF[0] = InterlockLine(word=0)
    for memory in wrong:
        with pytest.raises(BadFile, match=r"^the saved state does not belong to this arm$"):
            level.remember(memory)
    assert isinstance(level.memory, ArmMemory)
