"""The MICROBUS: commands, answers, status, segments, and what receivers with clocks of their own take."""

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sigma_bench import LONG, LoggedBus, frames

from handeye.core.errors import BadArgument, BadFile, Refused
from handeye.core.mutable_records import copied
from handeye.ports.microbus import Command, NoAnswer, Status, StrayAnswer
from handeye.systems.sigma.bus.events import AnswerEnded, ByteSpoken, CommandSent
from handeye.systems.sigma.bus.layout import LINE, SUPERSIGMA, Layout, Place
from handeye.systems.sigma.bus.wired import BusMemory
from handeye.systems.sigma.protocol import (
    AXES,
    NUMBERS,
    Op,
    actuate,
    beam,
    echo,
    force,
    limit_speed,
    move,
    move_slow,
    origin,
    position,
    self_test,
    sense,
    set_position,
    signed,
    threshold,
)

X1, Y1 = NUMBERS["X1"], NUMBERS["Y1"]
FEEDER, REMOVER, SENSOR = 10, 20, 24  # behind a regenerator, and behind two


@pytest.mark.sigma_row(1)
def test_a_command_is_five_bytes_and_its_strobe_falls_and_rises_within_the_first() -> None:
    bus = LoggedBus()
    bus.send(move("X1", -800))
    (sent,) = bus.sent()
    assert frames(bus) == ["00 01 01 03 20"]
    slot = bus.timing.slot * 1_000_000
    assert sent.at < sent.falls < sent.rises < sent.at + slot
    assert bus.now == 5 * bus.timing.slot


@pytest.mark.sigma_row(2)
def test_all_free_microcomputers_take_the_bytes_and_the_addressed_one_alone_changes() -> None:
    bus = LoggedBus()
    bus.send(move("Y1", 400))
    takers = {event.number for event in bus.taken()}
    assert takers == {*NUMBERS.values()}
    assert {event.frame for event in bus.taken()} == {move("Y1", 400).frame}
    assert [event.number for event in bus.taken() if event.own] == [Y1]
    assert {name: bus.statuses(name) for name in NUMBERS if bus.statuses(name)} == {"Y1": ["0-1"]}


@pytest.mark.sigma_row(3)
def test_a_busy_motor_receives_nothing_until_it_is_free() -> None:
    bus = LoggedBus()
    bus.send(move("X1", 400))
    bus.send(move("X1", 8000))
    assert len(bus.taken("X1")) == 1
    bus.settled("X1")
    assert (bus.statuses("X1"), bus.true_place("X1")) == (["0-1", "0-0"], 4000 + 400)
    bus.send(move("X1", 8000))
    bus.settled("X1")
    assert bus.true_place("X1") == 4000 + 8400


def _freed_within(bus: LoggedBus, microseconds: int) -> None:
    """Send a command to Y1 so that X1 becomes free so long after it began."""
    bus.send(move("X1", 8))
    due = bus.motor(X1).due
    assert due is not None
    bus.pass_to(due // 1_000_000 - microseconds)
    bus.begin(move("Y1", 0x0105))


@pytest.mark.sigma_row(4)
@pytest.mark.parametrize("late", [13, 19, 21, 35, 60, 99])
def test_one_that_becomes_free_after_the_strobe_rose_ignores_the_command_and_takes_the_next(
    late: int,
) -> None:
    bus = LoggedBus()
    _freed_within(bus, late)
    bus.settled("Y1")
    assert len(bus.taken("X1")) == 1
    bus.send(move("X1", 100))
    bus.settled("X1")
    assert bus.taken("X1")[-1].frame == move("X1", 100).frame
    assert bus.true_place("X1") == 4000 + 108


@pytest.mark.sigma_row(4)
def test_one_that_becomes_free_while_the_strobe_is_low_takes_the_command_whole() -> None:
    bus = LoggedBus()
    _freed_within(bus, 8)
    bus.settled("Y1")
    assert bus.taken("X1")[-1].frame == move("Y1", 0x0105).frame


@pytest.mark.sigma_row(4)
def test_a_strobe_held_too_long_makes_a_late_riser_take_the_second_byte_for_the_first() -> None:
    bus = LoggedBus("long-strobe:35")
    _freed_within(bus, 26)
    bus.settled("Y1")
    assert bus.taken("X1")[-1].frame.hex(" ") == "01 00 01 05 ff"


@pytest.mark.sigma_row(4)
def test_a_late_riser_acts_on_bytes_that_were_meant_for_another() -> None:
    """Byte 2 of a move is 1, the number of Y1: Y1 rises late, and takes count 7F FF for a command to itself."""
    bus = LoggedBus("long-strobe:35")
    bus.send(move("Y1", 8))
    due = bus.motor(Y1).due
    assert due is not None
    bus.pass_to(due // 1_000_000 - 26)
    bus.begin(Command(number=X1, op=Op.MOVE, detail=Op.SET_POSITION, value=0x0102))
    bus.settled("X1", "Y1")
    taken = bus.taken("Y1")[-1]
    assert (taken.own, taken.frame.hex(" ")) == (True, "01 07 01 02 ff")
    assert signed(bus.ask(position("Y1"), 2)) == 0x02FF


@pytest.mark.sigma_row(4)
def test_a_strobe_shorter_than_a_poll_is_missed_by_some_and_misread_by_none() -> None:
    bus = LoggedBus("long-strobe:4")
    bus.send(limit_speed("X1", 500))
    bus.pass_to(bus.now + 100)
    assert 2 <= len(bus.taken()) < 10
    assert all(event.noticed < 4_000_000 for event in bus.taken(*AXES, "HAND1", "HAND2"))  # while it was low
    assert {event.frame for event in bus.taken()} == {limit_speed("X1", 500).frame}


@pytest.mark.sigma_row(6)
@pytest.mark.slow
def test_ten_thousand_commands_back_to_back_take_a_second() -> None:
    bus = LoggedBus()
    bus.tell.clear()
    for number in range(10_000):
        bus.send(limit_speed(AXES[number % 6], 100 + number))
    assert bus.now == 1_000_000
    assert [bus.motor(NUMBERS[axis]).memory.limit for axis in AXES] == [
        10_096,
        10_097,
        10_098,
        10_099,
        10_094,
        10_095,
    ]


@pytest.mark.sigma_row(6)
def test_a_microcomputer_can_take_each_of_the_commands_that_follow_each_other() -> None:
    bus = LoggedBus()
    for number in range(100):
        bus.send(limit_speed("X1", 100 + number))
        bus.send(limit_speed("X2", 100 + number))
    assert bus.now == 20_000
    assert sum(event.own for event in bus.taken("X1", "X2")) == 200


@pytest.mark.sigma_row(7)
def test_a_microcomputer_with_the_number_255_works() -> None:
    layout = Layout(places=(*SUPERSIGMA.places[:9], Place(number=255, kind="motor")), more_pages=True)
    bus = LoggedBus(layout=layout)
    bus.send(move(255, 400))
    bus.settled(255)
    assert signed(bus.ask(position(255), 2)) == 400


@pytest.mark.sigma_row(7)
def test_an_eleventh_microcomputer_on_a_segment_is_refused() -> None:
    with pytest.raises(BadArgument, match="segment 0 has 11 microcomputers, but it can drive only 10"):
        LoggedBus(layout=Layout(places=(*SUPERSIGMA.places, Place(number=10, kind="motor"))))


@pytest.mark.sigma_row(8)
def test_a_position_is_answered_by_two_strobes_and_is_the_steps_since_origination() -> None:
    bus = LoggedBus()
    bus.send(origin("X1"))
    bus.settled("X1")
    for steps in (800, -300, 1234):
        bus.send(move("X1", steps))
        bus.settled("X1")
    bus.log.clear()
    assert signed(bus.ask(position("X1"), 2)) == 800 - 300 + 1234
    spoken = [event for event in bus.log if isinstance(event, ByteSpoken)]
    assert len(spoken) == 2
    assert [spoken[1].at - spoken[0].at, spoken[0].until - spoken[0].at] == [100_000_000, 50_000_000]


@pytest.mark.sigma_row(9)
def test_nothing_is_sent_between_a_question_and_the_last_byte_of_its_answer() -> None:
    bus = LoggedBus()
    bus.begin(position("X1"), answer=2)
    refused = 0
    while not bus.free:
        with pytest.raises(Refused, match="the bus still carries a command or an answer"):
            bus.begin(move("Y1", 8))
        refused += 1
        bus.wait(bus.now + 10)
    assert refused > 20
    bus.send(move("Y1", 8))
    times = [(type(event), event.at) for event in bus.log if isinstance(event, CommandSent | AnswerEnded)]
    assert [kind for kind, _ in times] == [CommandSent, AnswerEnded, CommandSent]
    assert times == sorted(times, key=lambda pair: pair[1])


@pytest.mark.sigma_row(9)
def test_a_dead_microcomputer_gives_no_answer_within_the_time_limit() -> None:
    bus = LoggedBus("dead:Z1")
    with pytest.raises(NoAnswer, match="NOANSWER 2: 0 of 2 bytes arrived before the time limit"):
        bus.ask(position("Z1"), 2)
    assert bus.now == bus.timing.command + bus.timing.time_limit


@pytest.mark.sigma_row(10)
def test_status_goes_from_free_to_busy_and_back() -> None:
    bus = LoggedBus()
    assert bus.status(X1) is Status.FREE
    bus.send(move("X1", 267))
    assert (bus.status(X1), bus.page(0)) == (Status.BUSY, 0b00_01_00_00_01)
    assert bus.wait_free(X1, LONG) is Status.FREE
    assert bus.now == pytest.approx(107_000, abs=200)


@pytest.mark.sigma_row(11)
def test_the_end_of_the_rail_stops_a_motor_and_pulls_the_interrupt() -> None:
    bus = LoggedBus()
    bus.send(move("X1", 20_000))
    assert not bus.interrupt
    bus.settled("X1")
    assert (bus.status(X1), bus.interrupt) == (Status.RAIL, True)
    assert 16_000 <= bus.true_place("X1") <= 16_000 + 640


@pytest.mark.sigma_row(11)
def test_force_over_the_threshold_stops_the_motor_of_its_axis_alone() -> None:
    bus = LoggedBus()
    bus.send(move("X1", 8000))
    bus.send(move("Y1", 8000))
    bus.pass_to(50_000)
    bus.machine.memory.forces[NUMBERS["FORCE1"]] = (-5.0, 0.0, 0.0)
    bus.touched(NUMBERS["FORCE1"])
    bus.settled("X1")
    assert (bus.status(X1), bus.status(Y1), bus.interrupt) == (Status.FORCE, Status.BUSY, True)
    bus.settled("Y1")
    assert (bus.status(Y1), bus.true_place("Y1")) == (Status.FREE, 10_667 // 4 + 8000)


@pytest.mark.sigma_row(11)
def test_a_motor_that_is_pressed_does_not_start_but_away_from_what_it_has_hit() -> None:
    bus, wrist = LoggedBus(), NUMBERS["FORCE1"]
    bus.send(move("X1", 4000))
    bus.pass_to(100_000)
    bus.machine.memory.forces[wrist] = (9.0, 0.0, 0.0)
    bus.touched(wrist)
    bus.settled("X1")
    hit = bus.true_place("X1")
    bus.send(move("X1", 100))
    bus.settled("X1")
    assert (bus.status(X1), bus.true_place("X1")) == (Status.FORCE, hit)
    bus.send(move("X1", -100))
    bus.settled("X1")
    assert (bus.status(X1), bus.true_place("X1")) == (Status.FREE, hit - 100)


@pytest.mark.sigma_row(13)
def test_the_count_at_an_abort_is_that_of_the_abort_and_the_stop_keeps_step() -> None:
    bus, wrist = LoggedBus(), NUMBERS["FORCE1"]
    bus.send(move_slow("X1", 2000, 50.0))
    bus.pass_to(400_000)
    bus.machine.memory.forces[wrist] = (9.0, 0.0, 0.0)
    bus.touched(wrist)
    at_scan = -(-(bus.now + 1) // 1000) * 1000
    bus.pass_to(at_scan)
    met = bus.true_place("X1") - 4000
    bus.settled("X1")
    assert abs(signed(bus.ask(position("X1", at_abort=True), 2)) - met) <= 1
    assert signed(bus.ask(position("X1"), 2)) == bus.true_place("X1") - 4000
    assert 0 < bus.true_place("X1") - 4000 - met < 10


@pytest.mark.sigma_row(11)
def test_with_a_broken_wire_the_interrupt_stays_low() -> None:
    bus = LoggedBus("no-interrupt")
    bus.send(move("X1", 20_000))
    bus.settled("X1")
    assert (bus.status(X1), bus.interrupt) == (Status.RAIL, False)


@pytest.mark.sigma_row(12)
def test_a_motor_stops_at_the_rail_though_no_one_looks() -> None:
    bus = LoggedBus()
    bus.send(move("Z1", 30_000))
    bus.wait(10**9)
    while bus.next_event is not None:  # the endless loop of a program that reads nothing
        bus.wait(10**9)
    assert bus.true_place("Z1") < 5_333 + 700
    assert bus.motor(NUMBERS["Z1"]).status is Status.RAIL


@pytest.mark.sigma_row(14)
@pytest.mark.parametrize("next_one", [move("X1", -8), position("X1"), set_position("X1", 5)])
def test_the_next_command_that_is_accepted_clears_line_a(next_one: Command) -> None:
    bus = LoggedBus()
    bus.send(move("X1", 20_000))
    bus.settled("X1")
    assert bus.status(X1).aborted
    if next_one.op == Op.POSITION:
        bus.ask(next_one, 2)
    else:
        bus.send(next_one)
    assert bus.statuses("X1")[:3] == ["0-1", "1-0", "0-1"]
    bus.settled("X1")
    assert (bus.status(X1), bus.interrupt) == (Status.FREE, False)


@pytest.mark.sigma_row(14)
def test_at_the_rail_a_motor_accepts_motion_away_from_it_only() -> None:
    bus = LoggedBus()
    bus.send(move("X1", 20_000))
    bus.settled("X1")
    there = bus.true_place("X1")
    bus.send(move("X1", 100))
    bus.settled("X1")
    assert (bus.status(X1), bus.true_place("X1")) == (Status.RAIL, there)


@pytest.mark.sigma_row(24)
def test_a_force_microcomputer_is_always_busy_and_takes_commands() -> None:
    bus = LoggedBus()
    bus.machine.memory.forces[NUMBERS["FORCE1"]] = (0.0, 0.0, 5.0)
    bus.touched(NUMBERS["FORCE1"])
    bus.pass_to(2_000)
    bus.send(threshold(1, "Z", 25.0))
    assert signed(bus.ask(force(1, "Z"), 2)) == 500
    assert (bus.status(NUMBERS["FORCE1"]), bus.statuses("FORCE1")) == (Status.BUSY, [])


@pytest.mark.sigma_row(25)
def test_a_raised_threshold_lets_an_axis_press_and_the_standard_one_stops_it_again() -> None:
    bus, wrist = LoggedBus(), NUMBERS["FORCE1"]
    for newtons, ends in ((25.0, Status.FREE), (None, Status.FORCE)):
        bus.machine.memory.forces[wrist] = (0.0, 0.0, 0.0)
        bus.touched(wrist)
        bus.send(threshold(1, "Z", newtons))
        bus.send(move("Z1", 800))
        bus.pass_to(bus.now + 20_000)
        bus.machine.memory.forces[wrist] = (0.0, 0.0, 20.0)
        bus.touched(wrist)
        assert bus.wait_free(NUMBERS["Z1"], LONG) is ends


@pytest.mark.sigma_row(28)
def test_the_beam_tells_whether_something_is_between_the_fingers() -> None:
    bus = LoggedBus()
    bus.send(actuate(1, "HAND", 1))
    assert bus.wait_free(NUMBERS["HAND1"], LONG) is Status.FREE
    assert bus.now == pytest.approx(150_000, abs=200)
    answers = []
    for cut in (True, False):
        bus.machine.memory.cut[NUMBERS["HAND1"]] = cut
        answers += bus.ask(beam(1), 1)
    assert answers == [1, 0]
    assert bus.machine.memory.devices[NUMBERS["HAND1"]] == (1, 0, 0, 0)


@pytest.mark.sigma_row(41)
def test_sixteen_pages_of_five_connect_eighty_and_two_more_bits_all_of_them() -> None:
    segments = tuple(range(-1, 25))

    def layout(count: int, *, more: bool) -> Layout:
        places = tuple(Place(number=n, kind="motor", segment=n // 10) for n in range(count))
        return Layout(places=places, behind=segments, more_pages=more)

    layout(80, more=False).check()
    with pytest.raises(
        BadArgument,
        match=r"microcomputer 80 are not connected: 16 pages of 5 connect only microcomputers 0 to 79; "
        "with two more output bits",
    ):
        layout(81, more=False).check()
    layout(256, more=True).check()
    assert (layout(1, more=False).pages, layout(1, more=True).pages) == (16, 64)


@pytest.mark.sigma_row(42)
def test_an_eleventh_microcomputer_works_behind_a_regenerator() -> None:
    bus = LoggedBus(layout=LINE)
    bus.send(move(FEEDER, 400))
    bus.settled(FEEDER)
    assert signed(bus.ask(position(FEEDER), 2)) == 400


@pytest.mark.sigma_row(42)
@pytest.mark.parametrize(("number", "turned"), [(X1, ()), (FEEDER, (1,)), (REMOVER, (1, 2))])
def test_only_regenerators_on_the_way_of_an_answer_turn_round(number: int, turned: tuple[int, ...]) -> None:
    bus = LoggedBus(layout=LINE)
    bus.ask(position(number), 2)
    assert {event.turned for event in bus.log if isinstance(event, ByteSpoken)} == {turned}


@pytest.mark.sigma_row(42)
def test_through_a_regenerator_that_does_not_turn_no_data_come() -> None:
    bus = LoggedBus("no-turn:1", layout=LINE)
    assert bus.ask(echo(X1, b"\x12\x34\x56"), 3) == b"\x12\x34\x56"
    assert bus.ask(echo(REMOVER, b"\x12\x34\x56"), 3) == b"\xff\xff\xff"


@pytest.mark.sigma_row(43)
def test_an_answer_of_six_bytes_has_six_strobes() -> None:
    bus = LoggedBus(layout=LINE)
    assert bus.ask(sense(SENSOR), 6) == bytes((1, 2, 3, 4, 5, 6))
    assert sum(isinstance(event, ByteSpoken) for event in bus.log) == 6


@pytest.mark.sigma_row(43)
def test_a_computer_that_expects_the_wrong_number_of_bytes_is_told_so() -> None:
    bus = LoggedBus(layout=LINE)
    with pytest.raises(StrayAnswer, match="STRAY 24: a byte arrived that no question asked for"):
        bus.ask(sense(SENSOR), 5)
    bus.wait(bus.now + 1_000)
    with pytest.raises(NoAnswer, match="NOANSWER 24: 6 of 7 bytes arrived"):
        bus.ask(sense(SENSOR), 7)
    assert bus.ask(sense(SENSOR), 6) == bytes((1, 2, 3, 4, 5, 6))


@given(st.lists(st.tuples(st.sampled_from(AXES), st.integers(1, 300), st.integers(0, 3_000)), max_size=12))
@settings(max_examples=10)
@pytest.mark.sigma_row(5)
def test_in_any_order_of_commands_and_frees_nothing_is_misread(orders: list[tuple[str, int, int]]) -> None:
    bus = LoggedBus(clock_spread=0.02)
    for axis, steps, pause in orders:
        bus.send(move(axis, steps))
        bus.wait(bus.now + pause)
    assert {event.frame for event in bus.taken()} <= {event.frame for event in bus.sent()}


@pytest.mark.parametrize("per_mille", [-45, 120])
def test_a_clock_within_its_limits_reads_right(per_mille: int) -> None:
    bus = LoggedBus(f"clock:X1:{per_mille}")
    for number in range(200):
        bus.wait(bus.now + number % 7)
        assert bus.ask(echo(X1, b"\x55\xaa\x33"), 3) == b"\x55\xaa\x33"


@pytest.mark.parametrize("per_mille", [-60, 150])
def test_a_clock_beyond_its_limits_takes_a_byte_for_its_neighbour(per_mille: int) -> None:
    bus = LoggedBus(f"clock:Y1:{per_mille}")
    for number in range(60):
        bus.send(limit_speed("X1", 0x1234 + number))
        bus.wait(bus.now + number % 11)
    right = {event.frame for event in bus.sent()}
    assert any(event.frame not in right for event in bus.taken("Y1"))
    assert {event.frame for event in bus.taken("X1")} <= right


def _worked(bus: LoggedBus) -> None:
    bus.send(move("X1", 700))
    bus.send(move("Y1", -100))
    bus.begin(position("Z1"), answer=2)


@pytest.mark.parametrize("microseconds", [200, 207, 290, 305, 333, 412, 431, 9_000, 150_000])
def test_a_state_that_is_kept_with_bytes_under_way_goes_on_the_same_to_the_byte(microseconds: int) -> None:
    whole, broken, resumed = LoggedBus(), LoggedBus(), LoggedBus()
    for bus in (whole, broken):
        _worked(bus)
    while broken.now < microseconds:
        broken.wait(microseconds)
    kept = msgspec.json.encode(broken.memory)
    broken.wait(LONG)
    resumed.remember(msgspec.json.decode(kept, type=BusMemory))
    for bus in (whole, resumed):
        while bus.now < 300_000:
            bus.wait(300_000)
        assert bus.answer() == b"\0\0"
    assert msgspec.json.encode(resumed.memory) == msgspec.json.encode(whole.memory)


def test_a_state_that_is_kept_while_a_limited_motor_moves_is_taken_back_the_same_to_the_byte() -> None:
    bus = LoggedBus()
    bus.send(limit_speed("X1", 250))
    for command in (move("X1", 40), move_slow("X1", 40, 20.0)):
        bus.send(command)
        kept = msgspec.json.encode(bus.memory)
        bus.remember(msgspec.json.decode(kept, type=BusMemory))
        assert msgspec.json.encode(bus.memory) == kept
        bus.settled("X1")


def test_what_another_bus_remembers_is_refused() -> None:
    with pytest.raises(BadFile, match="belongs to another bus"):
        LoggedBus().remember(copied(LoggedBus(layout=LINE).memory))


def test_a_machine_is_the_same_whether_its_bus_is_watched_or_not() -> None:
    watched, alone = LoggedBus(), LoggedBus()
    alone.tell.clear()
    for bus in (watched, alone):
        _worked(bus)
        bus.wait(bus.now + 33)
    assert msgspec.json.encode(watched.memory) == msgspec.json.encode(alone.memory)


def test_a_microcomputer_of_another_number_answers_in_the_place_of_its_own() -> None:
    bus = LoggedBus("address:X1:2")
    with pytest.raises(NoAnswer):
        bus.ask(self_test("X1"), 1)
    bus.log.clear()
    bus.ask(self_test("Z1"), 1)
    assert bus.statuses("X1")[0] == bus.statuses("Z1")[0] == "0-1"


@pytest.mark.parametrize(("settle", "first"), [(4, X1), (8, 0xFF)])
def test_data_that_settle_after_the_strobe_is_seen_are_misread(settle: int, first: int) -> None:
    bus = LoggedBus(f"slow-lines:{settle}")
    bus.send(limit_speed("X1", 50))
    assert bus.taken("Y1")[0].frame[0] == first
