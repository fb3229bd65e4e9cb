"""Two gantries with physics: rails, reflexes, forces, beams, and what a collision leaves."""

import json
from collections.abc import Callable
from itertools import pairwise, permutations

import numpy as np
import pytest
from gantry_bench import LONG, Machine
from mal_bench import ROOT, mal
from table_pages import maker

from handeye.core.variation import WorldSpec
from handeye.execution.servo import ServoPeriod
from handeye.ports.microbus import Status
from handeye.program.events import AnyEvent, to_line
from handeye.runs.advance import advance
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.sigma import protocol
from handeye.systems.sigma.gantries.crash import Crash, crash, lines
from handeye.systems.sigma.mal.happenings import CountDoubtful
from handeye.systems.sigma.mal.virtual_machine import DOUBT_N
from handeye.systems.sigma.protocol import NUMBERS, STEP_MM
from handeye.systems.sigma.run.plan import MalPlan

Command = Callable[..., tuple[int, str, str]]


@pytest.mark.slow
@pytest.mark.sigma_row(11)
@pytest.mark.sigma_row(12)
def test_the_switch_of_a_rail_stops_an_arm_in_time_though_the_computer_hangs() -> None:
    machine = Machine(3)
    machine.run("10 ORIGIN Y2\n20 MOVE Y2 BY 440 NOWAIT\n30 STOP\n")  # and nothing is executed any more
    assert machine.bus.wait_free(NUMBERS["Y2"], LONG) is Status.RAIL
    assert machine.bus.interrupt
    machine.rest()
    assert 400 < machine.place("Y2") * STEP_MM < 432
    assert abs(machine.place("Y2") - machine.count("Y2")) <= 1


def hit(found: Crash, axis: int) -> tuple[str, int, bool]:
    """Status, steps lost, and doubt of an axis."""
    return found.axes[axis].status, found.axes[axis].lost, found.axes[axis].doubted


@pytest.mark.slow
@pytest.mark.sigma_row(11)
@pytest.mark.sigma_row(13)
def test_at_50_mm_s_the_reflex_saves_the_counts_and_none_is_doubted() -> None:
    found = crash(50.0, reflex=True)
    assert [hit(found, axis) for axis in (0, 1)] == [("1-1", 0, False), ("0-0", 0, False)]
    assert found.axes[0].force < DOUBT_N
    assert abs(found.axes[0].counted - found.axes[0].true) < STEP_MM
    assert found.message == "ABORT X1 FORCE 160.16: the task MAIN, line 40"


@pytest.mark.slow
@pytest.mark.sigma_row(12)
def test_the_reflex_stops_an_arm_whose_computer_hangs() -> None:
    found = crash(50.0, reflex=True, endless_loop=True)
    assert hit(found, 0) == ("1-1", 0, False)
    assert found.axes[0].believed == pytest.approx(200, abs=0.02)
    assert found.axes[0].true < 161


@pytest.mark.slow
def test_without_the_reflex_the_program_believes_that_it_has_arrived() -> None:
    found = crash(50.0, reflex=False)
    assert found.message == "ARRIVED AT 200"
    assert all(axis.lost > 100 and axis.status == "0-0" and not axis.doubted for axis in found.axes)


@pytest.mark.slow
@pytest.mark.sigma_row(44)
def test_at_full_speed_both_arms_lose_steps_and_both_are_doubted() -> None:
    found = crash(None, reflex=True)
    assert all(axis.lost > 50 and axis.doubted for axis in found.axes)
    assert found.axes[1].status == "0-0"
    assert "the counts of X1 and X2 are doubtful until ORIGIN" in found.message


@pytest.mark.slow
@pytest.mark.sigma_row(44)
def test_an_arm_that_is_hit_above_its_wrist_is_doubted_though_it_feels_nothing() -> None:
    found = crash(None, reflex=True, lower=2)
    assert found.axes[1].lost > 50
    assert found.axes[1].force < DOUBT_N
    assert all(axis.doubted for axis in found.axes)


@pytest.mark.slow
def test_steps_that_no_wrist_has_felt_are_found_by_origin() -> None:
    found = crash(50.0, reflex=True, lower=1)
    assert all(axis.lost > 50 and not axis.doubted for axis in found.axes)
    assert "LOSTSTEPS: the count of X1 was wrong by" in found.origin
    assert "and the count of X2 was wrong by" in found.origin


@pytest.mark.sigma_row(22)
def test_origin_lets_the_rotor_rest_before_it_turns_round_so_that_no_pole_is_lost() -> None:
    machine = Machine(25)  # whose motor of X1 is weak
    machine.bus.send(protocol.origin("X1"))
    assert machine.bus.wait_free(0, LONG) is Status.FREE
    assert machine.gantries.memory.slipped[0] == 0


def test_a_motor_that_turns_round_at_once_loses_no_pole() -> None:
    machine = Machine(0)
    for steps in (1000, -390, 200, -8, 5):
        machine.bus.send(protocol.move("X1", steps))
        assert machine.bus.wait_free(0, LONG) is Status.FREE
    machine.rest()
    assert machine.gantries.memory.slipped[0] == 0
    assert machine.count("X1") == 807


@pytest.mark.slow
def test_origin_ends_the_doubt() -> None:
    text = "10 ORIGIN Z1\n20 LIMIT Z1, 30\n30 ON ABORT GOTO 50\n40 MOVE Z1 TO 195 SLOW 30\n50 ORIGIN Z1\n"
    ran = Machine().run(text)
    assert [event.axis for event in ran.events if isinstance(event, CountDoubtful)] == ["Z1"]
    assert ran.vm.memory.doubtful == ()
    assert not ran.fault


@pytest.mark.slow
@pytest.mark.sigma_row(23)
def test_two_moves_overlap_and_a_line_is_straight_in_truth() -> None:
    ways = {}
    for option in ("", " LINE"):
        machine, places = Machine(), list[tuple[float, float]]()
        ran = machine.run("10 ORIGIN X1, Y1\n")
        machine.gantries.bench.after_step.append(
            lambda machine=machine, places=places: places.append((machine.place("X1"), machine.place("Y1")))
        )
        ran = machine.run(f"10 ORIGIN X1, Y1\n20 MOVE X1 TO 50, Y1 TO 20{option}\n")
        assert not ran.fault
        way = np.array(places) * STEP_MM
        way = way[(way[:, 0] > 0.1) | (way[:, 1] > 0.1)]
        ways[option] = np.abs(way @ (20, -50)).max() / np.hypot(20, 50)
    assert ways[""] > 2
    assert ways[" LINE"] < 0.5


@pytest.mark.slow
@pytest.mark.sigma_row(24)
def test_a_force_microcomputer_takes_commands_while_it_scans_and_an_arm_moves() -> None:
    machine = Machine()
    bus, number = machine.bus, NUMBERS["FORCE1"]
    bus.send(protocol.move("X1", 4000))
    seen = set[Status]()
    for newtons in (25.0, 4.0) * 5:
        seen.add(bus.status(number))
        bus.send(protocol.threshold(1, "X", newtons))
        assert abs(protocol.signed(bus.ask(protocol.force(1, "X"), 2)) * protocol.FORCE_STEP_N) < 4
    assert bus.status(NUMBERS["X1"]) is Status.BUSY
    assert seen == {Status.BUSY}
    bus.send(protocol.threshold(1, "X", 0.1))  # which the inertia of the hand exceeds
    assert bus.wait_free(NUMBERS["X1"], LONG) is Status.FORCE


@pytest.mark.slow
@pytest.mark.sigma_row(46)
def test_all_orders_of_three_moves_and_all_at_once_end_at_the_same_place() -> None:
    ends, goals = list[tuple[float, ...]](), {"X1": 30, "Y1": 25, "Z1": 20}
    orders = [*permutations(goals), ()]
    for order in orders:
        machine = Machine(25)
        lines = [f"MOVE {axis} TO {goals[axis]}" for axis in order] or ["MOVE X1 TO 30, Y1 TO 25, Z1 TO 20"]
        ran = machine.run(
            "10 ORIGIN X1, Y1, Z1\n" + "".join(f"{20 + n} {line}\n" for n, line in enumerate(lines))
        )
        machine.rest()
        assert not ran.fault
        assert [machine.count(axis) for axis in goals] == [800, 667, 533]
        ends.append(tuple(machine.place(axis) for axis in goals))
    assert np.ptp(np.array(ends), axis=0).max() < 1


@pytest.mark.slow
@pytest.mark.sigma_row(25)
def test_a_raised_limit_lets_z_press_on_the_board_and_the_standard_one_stops_it() -> None:
    text = """10 ORIGIN Z1
20 ON ABORT GOTO 60
30 MOVE Z1 TO 175
40 MOVE Z1 TO 190 SLOW 10
50 STOP
60 PRINT POS(Z1)
65 ON ABORT GOTO 110
70 LIMIT Z1, 25
80 MOVE Z1 BY -2
100 MOVE Z1 TO 190 SLOW 10
110 PRINT POS(Z1)
115 ON ABORT GOTO 160
120 MOVE Z1 BY -5
130 LIMIT Z1, STANDARD
150 MOVE Z1 TO 190 SLOW 10
160 PRINT POS(Z1)
"""
    found = [float(line) for line in Machine().run(text).printed]
    assert found[0] == pytest.approx(180.1, abs=0.15)  # 4 N bend the wrist by .2 mm
    assert found[1] == pytest.approx(181.25, abs=0.15)
    assert found[2] == pytest.approx(180.1, abs=0.15)


@pytest.mark.sigma_row(26)
@pytest.mark.slow
def test_fast_moves_in_empty_space_trip_no_reflex_unless_the_accelerometers_are_off(command: Command) -> None:
    code, out, _ = command("sigma", "moves", "--n", "1", "--seed", "7", "--json")
    on, off = json.loads(out)["figures"]["moves"]
    assert (code, on["tripped"], off["tripped"]) == (0, 0, on["moves"])
    assert on["force"] < 1 < 4 < off["force"]
    assert (
        "without accelerometers: the reflex stopped 8 of 8 moves" in command("sigma", "moves", "--n", "1")[1]
    )


@pytest.mark.sigma_row(27)
def test_a_load_of_5_n_is_read_to_a_tenth() -> None:
    machine = Machine()
    data = machine.gantries.bench.data
    data.xfrc_applied[machine.gantries.bench.model.body("hand_1").id, 2] = -5.0
    machine.rest(0.3)
    ran = machine.run("10 PRINT FORCE(Z1), FORCE(X1)\n")
    along, across = map(float, ran.printed[0].split())
    assert along == pytest.approx(5, abs=0.1)
    assert across == pytest.approx(0, abs=0.1)


@pytest.mark.slow
@pytest.mark.sigma_row(28)
def test_a_block_between_the_fingers_cuts_the_beam() -> None:
    text = "10 ORIGIN X1, Y1, Z1\n20 MOVE X1 TO 100, Y1 TO 50\n30 MOVE Z1 TO 150\n40 PRINT BEAM(1)\n"
    assert [Machine(block=where).run(text).printed for where in ("100 50 45", "130 50 45")] == [["1"], ["0"]]


@pytest.mark.sigma_row(45)
@pytest.mark.parametrize("ramped", [True, False])
def test_a_constant_speed_needs_its_ramp_to_lose_no_pole(ramped: bool) -> None:
    machine = Machine()
    machine.bus.motor(0).ramped = ramped
    machine.bus.send(protocol.move_slow("X1", 4000, 200))
    assert machine.bus.wait_free(0, LONG) is Status.FREE
    machine.rest()
    assert (machine.gantries.memory.slipped[0] == 0) == ramped


@pytest.mark.slow
def test_a_run_kept_anywhere_goes_on_to_the_same_events() -> None:
    text = """10 ON ABORT GOTO 60
20 ORIGIN Z1
30 MOVE Z1 TO 178
40 MOVE Z1 TO 185 SLOW 20
50 STOP
60 PRINT POS(Z1), FORCE(Z1)
65 ON ABORT GOTO 80
70 MOVE Z1 BY 1
80 MOVE Z1 BY -3
"""

    def begun() -> Runner:
        plan = MalPlan(name="kept.mal", text=text, arm="gantries")
        return Runner(
            Checkpoint(setup=Setup(system="sigma", plan=plan, world=WorldSpec(seed=5), camera="auto"))
        )

    whole = begun()
    advance(whole)
    whole.finish()
    events = [*map(to_line, whole.events)]
    assert sum(b"MotorAborted" in event for event in events) > 1  # pressed twice: the second time at once
    first = begun()
    for steps in range(1, whole.position):
        advance(first, steps=1)
        again = Runner(first.checkpoint())
        advance(again)
        again.finish()
        assert [*map(to_line, again.events)] == events, steps


class Order(Observer):
    """Notes what happens, and when the arms are watched."""

    def __init__(self) -> None:
        self.seen: list[str] = []

    def event(self, event: AnyEvent) -> None:
        self.seen.append(type(event).__name__)

    def tick(self, period: ServoPeriod) -> None:
        self.seen.append("period")


def test_a_step_has_finished_when_its_motions_have_so_that_a_trace_can_be_cut_there() -> None:
    order = Order()
    plan = MalPlan(name="cut.mal", text="10 ORIGIN Z1\n20 MOVE Z1 TO 60\n30 MOVE Z1 TO 0\n", arm="gantries")
    setup = Setup(system="sigma", plan=plan, world=WorldSpec(seed=5), camera="auto")
    advance(Runner(Checkpoint(setup=setup), observers=lambda _: [order]))
    after = [b for a, b in pairwise(order.seen) if a == "StepFinished"]
    assert order.seen.count("period") > 20
    assert "period" not in after


@pytest.mark.sigma_row(35)
@pytest.mark.slow
def test_in_the_hand_over_the_arms_never_touch() -> None:
    machine = Machine(2)
    touched = []
    model, data = machine.gantries.bench.model, machine.gantries.bench.data
    arm = {body: model.body(body).rootid[0] for body in range(model.nbody)}

    def look() -> None:
        if not data.ncon:
            return
        pairs = {arm[int(model.geom_bodyid[g])] for contact in data.contact for g in contact.geom}
        if len(pairs - {0}) > 1:
            touched.append(machine.bus.now)

    machine.gantries.bench.after_step.append(look)
    ran = machine.run(mal("handover"))
    assert ran.printed[0].split()[:2] == ["PIECES", "4"]
    assert touched == []


def test_a_seed_is_for_the_machine_that_has_errors(command: Command) -> None:
    code, _, err = command("sigma", "run", str(ROOT / "plans/handover.mal"), "--seed", "3", "--no-keep")
    assert (code, "--seed applies only to `--arm gantries`" in err) == (2, True)


def test_time_passes_in_pieces_so_that_a_long_wait_can_be_interrupted() -> None:
    bus = Machine().bus
    assert bus.wait(LONG) <= 200_000


@pytest.mark.slow
def test_a_crash_is_a_command_whose_page_shows_it(command: Command) -> None:
    text = (ROOT / "docs/safety_study.md").read_text(encoding="utf-8")
    code, out, _ = command("sigma", "crash", "--speed", "50")
    assert code == 0
    assert f"$ handeye sigma crash --speed 50\n{out}" in text
    assert lines(crash(50.0, reflex=True)) == out.splitlines()
    assert command("sigma", "crash", "--speed", "1")[0] == 2


@pytest.mark.slow
def test_the_table_of_the_safety_study_is_made_by_the_program() -> None:
    made = maker()
    assert made.page("safety_study", made.TABLES["safety_study"]()) == made.place("safety_study").read_text(
        "utf-8"
    )
