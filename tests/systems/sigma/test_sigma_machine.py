"""The virtual machine: tasks in turn, flags, aborts, times, and what the central computer is busy with."""

from itertools import permutations

import pytest
from mal_bench import TWO_TASKS, begun, carried_out, go_on, mal

from handeye.core.mutable_records import copied
from handeye.systems.sigma.machine.perfect import PerfectMotors
from handeye.systems.sigma.mal.interleavings import interleavings
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import NUMBERS, STEP_MM


@pytest.mark.sigma_row(32)
@pytest.mark.parametrize("statement_us", [0, 1, 500, 2000, 100_000])
def test_flags_order_two_tasks_however_long_a_statement_takes(statement_us: int) -> None:
    text = TWO_TASKS.format(left='40 WAIT READY\n50 PRINT "LEFT"', right='70 PRINT "RIGHT"\n80 SET READY')
    assert carried_out(text, statement_us=statement_us).printed == ["RIGHT", "LEFT"]


@pytest.mark.sigma_row(32)
def test_without_flags_the_order_depends_on_how_long_a_statement_takes() -> None:
    sums = "\n".join(f"{40 + n} A = A + 1" for n in range(9))
    text = TWO_TASKS.format(left=f'{sums}\n50 PRINT "LEFT"', right='70 DELAY 0.01\n80 PRINT "RIGHT"')
    orders = {cost: carried_out(text, statement_us=cost).printed for cost in (100, 20_000)}
    assert orders == {100: ["LEFT", "RIGHT"], 20_000: ["RIGHT", "LEFT"]}


@pytest.mark.sigma_row(33)
def test_tasks_that_wait_for_each_other_are_a_deadlock_that_names_tasks_lines_and_flags() -> None:
    ran = carried_out(mal("dead"))
    assert ran.fault == (
        "DEADLOCK: the task MAIN, line 60, waits for flags LEFTDONE and RIGHTDONE; the task LEFT, line 130, waits for "
        "flag DRIVERFREE; the task RIGHT, line 230, waits for flag JIGFREE"
    )


@pytest.mark.sigma_row(33)
def test_a_deadlock_is_found_within_a_round_of_turns() -> None:
    ran = carried_out("10 WAIT NEVER\n20 SET OTHER")
    assert (ran.statements, ran.fault.split(":")[0]) == ([10], "DEADLOCK")


def test_no_deadlock_is_told_while_a_motor_moves_or_a_delay_runs() -> None:
    text = TWO_TASKS.format(
        left="40 WAIT READY\n50 PRINT 1", right="70 MOVE X1 TO 500\n75 DELAY 3\n80 SET READY"
    )
    assert carried_out(text).fault == ""


@pytest.mark.sigma_row(34)
@pytest.mark.parametrize("statement_us", [0, 2000])
def test_exactly_one_of_two_tasks_takes_a_flag(statement_us: int) -> None:
    both = TWO_TASKS.format(left="40 TAKE FREE\n50 GOT = GOT + 1", right="70 TAKE FREE\n80 GOT = GOT + 1")
    ran = carried_out(f"5 SET FREE\n{both}", statement_us=statement_us)
    assert (ran.vm.memory.variables["GOT"], "waits for flag FREE" in ran.fault) == (1.0, True)


def test_a_flag_that_is_set_twice_is_set_once() -> None:
    assert "line 40, waits for flag F" in carried_out("10 SET F\n20 SET F\n30 TAKE F\n40 TAKE F").fault


def test_wait_leaves_flags_set_and_wants_all_of_them() -> None:
    ran = carried_out("10 SET A\n20 SET B\n30 WAIT A AND B\n40 WAIT A\n50 RESET B\n60 WAIT A AND B")
    assert (ran.statements, ran.vm.memory.flags) == ([10, 20, 30, 40, 50, 60], ("A",))
    assert "line 60, waits for flags A and B" in ran.fault


def test_tasks_take_turns_a_statement_each() -> None:
    left, right = "40 A = 1\n45 B = 1\n50 C = 1", "70 D = 1\n75 E = 1\n80 F = 1"
    assert carried_out(TWO_TASKS.format(left=left, right=right)).statements == [
        10,
        40,
        70,
        20,
        45,
        75,
        50,
        80,
    ]


@pytest.mark.sigma_row(35)
def test_in_the_hand_over_the_arms_are_never_both_at_the_assembly_place() -> None:
    ran, nearest = begun(mal("handover")), 0.0
    while ran.vm.turn:
        counts = ran.vm.memory.counts
        nearest = max(nearest, (counts.get("X1", 0) + counts.get("X2", 0)) * 0.0375)
        go_on(ran, 1)
    assert (ran.fault, ran.printed[0].split()[1], round(nearest)) == ("", "4", 500)


@pytest.mark.sigma_row(39)
def test_an_abort_without_a_handler_stops_the_program_with_axis_cause_and_position() -> None:
    ran = carried_out("10 ORIGIN X1\n20 MOVE X1 BY 700\n30 PRINT 1")
    assert (ran.fault, ran.printed) == ("ABORT X1 RAIL 600.00: the task MAIN, line 20", [])


@pytest.mark.sigma_row(39)
def test_an_abort_with_a_handler_goes_there_and_resume_goes_on_behind_the_move() -> None:
    ran = carried_out(
        "5 ON ABORT GOTO 100\n10 ORIGIN X1\n20 MOVE X1 BY 700\n30 PRINT POS(X1)\n40 END\n"
        "100 PRINT STATUS(X1), CRASHPOS(X1)\n110 RESUME"
    )
    assert (ran.fault, ran.printed) == ("", ["2             600", "600"])


def test_a_handler_of_one_axis_leaves_the_others_alone() -> None:
    text = "5 ON ABORT Z1 GOTO 100\n10 ORIGIN X1\n20 MOVE X1 BY 700\n30 END\n100 PRINT 1"
    assert carried_out(text).fault.startswith("ABORT X1 RAIL")


def test_stop_with_a_text_stops_the_program_as_failed() -> None:
    ran = carried_out('10 IF A = 0 THEN STOP "NO PIECE"\n20 PRINT "GOING ON"\n')
    assert (ran.fault, ran.printed) == ("the task MAIN, line 10: NO PIECE", [])
    ran.vm.proceed()
    go_on(ran)
    assert (ran.fault, ran.printed) == ("", ["GOING ON"])
    assert interleavings(ran.vm.program, 100).findings == ()


TWICE = "10 ORIGIN X1, Y1\n20 MOVE X1 TO 50\n30 ORIGIN X1, Y1\n40 PRINT POS(X1)"


@pytest.mark.parametrize(("lost", "told"), [(0, ""), (2, ""), (16, "the count of X1 was wrong by 0.60 mm")])
def test_origin_finds_out_whether_a_motor_has_lost_steps(lost: int, told: str) -> None:
    ran = begun(TWICE)
    machine = ran.vm.machine
    assert isinstance(machine, PerfectMotors)
    while ran.vm.memory.counts.get("X1") != round(50 / STEP_MM):
        go_on(ran, 1)
    machine.memory.motors[NUMBERS["X1"]].place -= lost
    go_on(ran)
    assert ran.fault == (f"line 30: LOSTSTEPS: {told}" if told else "")
    if told:
        ran.vm.retry()
        go_on(ran)
    assert ran.printed == ["0"]


def test_origin_finds_out_whether_a_motor_has_missed_a_command() -> None:
    ran = begun(TWICE)
    machine = ran.vm.machine
    assert isinstance(machine, PerfectMotors)
    while ran.vm.memory.counts.get("X1") != round(50 / STEP_MM):
        go_on(ran, 1)
    machine.memory.motors[NUMBERS["X1"]].count -= 1
    go_on(ran)
    assert ran.fault == "line 30: WRONGCOUNT: the count of X1 is 49.95 mm, but X1 was sent to 49.99 mm"
    ran.vm.retry()
    assert go_on(ran).printed == ["0"]


def test_a_motor_at_its_rail_moves_away_from_it_and_not_towards_it() -> None:
    ran = carried_out(
        "5 ON ABORT GOTO 100\n10 ORIGIN Y1\n20 MOVE Y1 BY -5\n30 MOVE Y1 BY 10\n40 PRINT POS(Y1)\n50 END\n100 RESUME"
    )
    assert ran.printed == ["10.0125"]


@pytest.mark.sigma_row(46)
def test_all_orders_of_three_moves_and_all_at_once_end_at_the_same_counts() -> None:
    goals = {"X1": "MOVE X1 TO 123.4", "Y1": "MOVE Y1 TO 45.6", "Z1": "MOVE Z1 BY 7.89"}
    begin = "10 ORIGIN X1, Y1, Z1\n"
    orders = [
        begin + "\n".join(f"{20 + n} {goals[axis]}" for n, axis in enumerate(order))
        for order in permutations(goals)
    ]
    together = f"{begin}20 MOVE X1 TO 123.4, Y1 TO 45.6, Z1 BY 7.89"
    ends = {tuple(sorted(carried_out(text).vm.memory.counts.items())) for text in (*orders, together)}
    assert ends == {(("X1", 3291), ("Y1", 1216), ("Z1", 210))}


def test_moves_of_one_statement_overlap_and_nowait_does_not_wait() -> None:
    one, both = (carried_out(f"10 MOVE {axes}").vm.time for axes in ("X1 BY 300", "X1 BY 300, Y1 BY 300"))
    assert both == pytest.approx(one, abs=0.001)
    assert carried_out("10 MOVE X1 BY 300 NOWAIT\n20 PRINT TIME").printed == ["0.0021"]


def test_a_busy_motor_lets_the_next_command_wait() -> None:
    ran = carried_out("10 ORIGIN X1\n20 MOVE X1 TO 300 NOWAIT\n30 MOVE X1 TO 0\n40 PRINT POS(X1)")
    assert (ran.printed, ran.vm.memory.commands, ran.vm.time > 1.5) == (["0"], 3, True)


@pytest.mark.sigma_row(23)
def test_a_move_of_two_axes_is_two_commands_whose_motions_overlap_and_end_apart() -> None:
    ran = begun("10 MOVE X1 TO 50, Y1 TO 20")
    ran.vm.statement()
    machine = ran.vm.machine
    assert isinstance(machine, PerfectMotors)
    x, y = (machine.memory.motors[number] for number in (NUMBERS["X1"], NUMBERS["Y1"]))
    assert [event.to for event in ran.sent] == ["X1", "Y1"]
    assert x.begun < y.begun < y.until < x.until  # Y is at its place before X is: the path has a bend
    assert (x.steps, y.steps) == (1333, 533)


@pytest.mark.sigma_row(23)
def test_a_straight_line_is_within_half_a_millimetre_of_straight() -> None:
    """Speeds come in steps of 2 mm/s, so that their ratio is off: the axes wait for each other on the way."""
    ran, place, begun_at, off = (
        carried_out("10 MOVE X1 BY 200, Y1 BY 37 LINE"),
        {"X1": 0.0, "Y1": 0.0},
        0.0,
        0.0,
    )
    parts = [(event.time, event.to, event.means.split()) for event in ran.sent]
    for (time, first, x), (_, second, y) in zip(parts[::2], parts[1::2], strict=True):
        assert (first, second, time >= begun_at) == ("X1", "Y1", True)
        for axis, (_, _, steps, _, _, speed, _) in ((first, x), (second, y)):
            place[axis] += int(steps) * 0.0375
            begun_at = max(begun_at, time + int(steps) * 0.0375 / float(speed))
        early = min(int(x[2]) / float(x[5]), int(y[2]) / float(y[5])) * 0.0375
        off = max(off, abs(min(float(y[5]) * early, int(y[2]) * 0.0375) - float(x[5]) * early * 37 / 200))
        off = max(off, abs(place["Y1"] - place["X1"] * 37 / 200))
    assert (round(place["X1"]), round(place["Y1"])) == (200, 37)
    assert off < 0.5


@pytest.mark.sigma_row(50)
def test_ten_times_the_arithmetic_lowers_idle_and_the_rate_of_commands() -> None:
    def program(times: int) -> str:
        sums = "\n".join(f"{20 + n} A = A * 2 - A + 1 / 3" for n in range(times))
        return f"10 FOR I = 1 TO 20\n{sums}\n80 MOVE X1 BY 20\n90 MOVE X1 BY - 20\n95 NEXT I"

    few, many = (carried_out(program(times)) for times in (3, 30))
    assert few.vm.idle > many.vm.idle + 0.2
    assert few.vm.memory.commands / few.vm.time > 1.3 * many.vm.memory.commands / many.vm.time


def test_the_hand_over_leaves_the_central_computer_idle_for_most_of_the_time() -> None:
    assert carried_out(mal("handover")).vm.idle > 0.9


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("A = 1 / 0", "this divides by zero"), ("A = SQR(-4)", "SQR needs a number of 0 or more, not -4"),
        (f"A = {' * '.join(['1E30'] * 11)}", "beyond the largest number"),
        ("A = POS(X1)", "NOTORIGINATED: POS(X1) needs an ORIGIN X1 first"),
        ("MOVE X1 BY 9000", "the goal of X1 is 9000 mm; a goal can be at most 1229 mm from 0"),
        ("A = BEAM(1 + 2)", "there is no light beam 3, only 1 and 2"),
        ("DELAY 0 - 1", "a delay must be between 0 and 86400 s, not -1"),
        ("CURVE X1, 1 / 2", "a curve must be 0, 1, 2, 3 or 4, not 0.5"),
        ("LIMIT Z1, 0 - 4", "a force limit must be between 0 and 655 N, not -4"),
        ("SPEED Z1, 0 - 4", "a speed limit must be between 0 and 2400 mm/s, not -4"),
        ("MOVE X1 BY 5 SLOW 1 / 2", "a constant speed must be between 2 and 254 mm/s, not 0.5"),
        ("ACTUATE HAND1 = 1 / 2", "HAND1 takes a whole number from 0 to 65535, not 0.5"),
        ("GOSUB 10", "1000 GOSUBs are active: a subroutine never reaches its RETURN"),
        ("FOR I = 1 TO 2 STEP 0", "a FOR with a STEP of 0 never ends"),
    ],
)  # fmt: skip
def test_a_statement_that_cannot_be_carried_out_stops_the_program_at_its_line(line: str, told: str) -> None:
    ran = carried_out(f"10 {line}\n20 NEXT I\n" if line.startswith("FOR") else f"10 {line}")
    assert ran.fault.startswith("line 10: ")
    assert told in ran.fault


def test_loops_nest_count_down_and_are_left_by_a_jump() -> None:
    inner = "20 FOR J = 1 TO 9\n30 IF J = I THEN 50\n40 NEXT J\n50 PRINT I; J;"
    text = f"10 FOR I = 3 TO 1 STEP -1\n{inner}\n60 NEXT I\n70 PRINT"
    assert carried_out(text).printed == ["332211"]


def test_a_subroutine_returns_behind_its_gosub_also_from_within_an_if() -> None:
    main = "10 GOSUB 100\n20 IF A < 2 THEN GOSUB 100\n30 PRINT A\n40 END"
    text = f"{main}\n100 A = A + 1\n110 IF A > 0 THEN RETURN\n120 A = 9"
    assert carried_out(text).printed == ["2"]


def test_functions_of_numbers_are_those_of_basic() -> None:
    assert carried_out("10 PRINT INT(-1.5); SGN(-3); SGN(0); ABS(-2); SQR(16)").printed == ["-2-1024"]
    assert carried_out("10 PRINT 7 / 2; 2 - 5; -3 * 2").printed == ["3.5-3-6"]


@pytest.mark.parametrize(("value", "printed"), [(1, ["ONE", "END"]), (2, ["OTHER", "END"]), (3, ["THREE"])])
def test_if_does_one_of_its_branches(value: int, printed: list[str]) -> None:
    choice = '20 IF A = 3 THEN 50 ELSE IF A = 1 THEN PRINT "ONE" ELSE PRINT "OTHER"'
    text = f'{choice}\n30 PRINT "END"\n40 END\n50 PRINT "THREE"'
    assert carried_out(f"10 A = {value}\n{text}").printed == printed


def test_delays_follow_each_other() -> None:
    assert carried_out("10 DELAY 1.5\n20 DELAY 1.5\n30 PRINT INT(TIME * 10)").printed == ["30"]


def test_the_handler_of_an_axis_comes_before_that_of_all_and_each_abort_is_seen() -> None:
    ran = carried_out(
        "5 ON ABORT GOTO 200\n6 ON ABORT X1 GOTO 100\n10 ORIGIN X1\n20 MOVE X1 BY 700\n30 MOVE X1 BY -10\n"
        "40 PRINT STATUS(X1)\n50 MOVE X1 BY 100\n60 PRINT POS(X1)\n70 END\n"
        '100 PRINT "X1"; STATUS(X1)\n110 RESUME\n200 PRINT "ALL"\n210 RESUME'
    )
    assert ran.printed == ["X12", "0", "X12", "600"]


def test_input_waits_for_a_number_that_is_typed() -> None:
    ran = carried_out("10 INPUT HEIGHT\n20 PRINT HEIGHT * 2")
    assert ran.fault == "the task MAIN, line 10, waits for a number for HEIGHT, typed at the console"
    ran.vm.type_number("21")
    ran.vm.settle()
    assert go_on(ran).printed == ["42"]


def test_kill_ends_a_task_and_not_the_motion_that_it_has_under_way() -> None:
    main = "10 ORIGIN X1\n20 START MOVER\n30 DELAY 0.1\n40 KILL MOVER\n50 PRINT POS(X1)"
    ran = carried_out(f"{main}\n60 TASK MOVER\n70 MOVE X1 TO 300\n80 PRINT 1")
    assert (ran.printed, ran.vm.machine.next_event is not None) == (["300"], True)


@pytest.mark.sigma_row(40)
@pytest.mark.parametrize("cut", [0, 7, 23, 60])
def test_a_memory_at_any_statement_goes_on_to_the_same_events(cut: int) -> None:
    whole, ran = carried_out(mal("handover")), go_on(begun(mal("handover")), cut)
    motors = PerfectMotors()
    motors.remember(copied(ran.vm.machine.memory))
    vm = VirtualMachine(ran.vm.program, motors, ran.events.append)
    vm.remember(copied(ran.vm.memory))
    ran.vm = vm
    assert go_on(ran).events == whole.events


def test_perfect_motors_keep_the_times_of_the_profiles() -> None:
    """Times of moves with the paper's greatest speed, curve 1, ms."""
    times = {
        steps: carried_out(f"10 CURVE X1, 1\n20 MOVE X1 BY {steps * 0.0375}", statement_us=0).vm.time * 1e3
        for steps in (8, 9, 267, 1333, 2667, 4000, 8000)
    }
    assert [round(each) for each in times.values()] == [8, 8, 107, 275, 402, 500, 767]
