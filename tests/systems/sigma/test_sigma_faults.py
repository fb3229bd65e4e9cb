"""Faults in physics: what each does to the gantries, and the trials that plant them in a job."""

import json
from collections.abc import Callable

import pytest
from gantry_bench import LONG, Machine

from handeye.core.errors import BadArgument
from handeye.ports.microbus import Status
from handeye.systems.sigma import protocol
from handeye.systems.sigma.diagnosis.faults import FAULTS
from handeye.systems.sigma.gantries.faults import catalogue, every_fault
from handeye.systems.sigma.protocol import NUMBERS

Command = Callable[..., tuple[int, str, str]]


def forces(fault: str, newtons: float = 5.0) -> list[float]:
    """What wrist 1 reads along X, Y and Z with a load along Z."""
    machine = Machine(None, fault)
    data = machine.gantries.bench.data
    data.xfrc_applied[machine.gantries.bench.model.body("hand_1").id, 2] = -newtons
    machine.rest(0.15)
    asked = (machine.bus.ask(protocol.force(1, axis), 2) for axis in "XYZ")
    return [round(protocol.signed(answer) * protocol.FORCE_STEP_N, 2) for answer in asked]


def test_a_job_can_have_each_fault_that_its_bus_has_room_for() -> None:
    kinds = {name.partition(".")[0] for name in catalogue().matrix}
    assert {*FAULTS} - kinds == {"regenerator"}  # SUPERSIGMA alone fills one segment
    assert len(catalogue().matrix) == len(kinds)
    assert "status.X1.A.high" in catalogue().matrix
    assert "switch.Z2.high.on" in catalogue().kinds


@pytest.mark.parametrize(
    ("fault", "read"),
    [
        ("gauge.1.Z.dead", [0, 0, 0]),
        ("gauge.1.X.offset", [1.5, 0, 5]),
        ("multiplexer.1.Z", [5, 5, 5]),
        ("converter.1.6.0", [0, 0, 1.8]),  # of 100 steps of .05 N, the bits 6, 5 and 2 are set
        ("accelerometer.1.Z", [0, 0, 5]),
    ],
)
def test_a_fault_of_a_wrist_changes_what_it_reads(fault: str, read: list[float]) -> None:
    assert forces(fault) == pytest.approx(read, abs=0.11)


def test_pulses_that_are_left_out_are_counted_but_not_made() -> None:
    machine = Machine(None, "pulses.X1.20")
    begin = machine.place("X1")
    for steps in (1000, -390):
        machine.bus.send(protocol.move("X1", steps))
        assert machine.bus.wait_free(0, LONG) is Status.FREE
    machine.rest()
    assert machine.count("X1") == 610
    slipped = 4 * machine.gantries.memory.slipped[0]
    assert machine.place("X1") - begin == pytest.approx(610 - 50 + 19 + slipped, abs=0.6)


def test_a_motor_with_one_phase_or_a_sagging_supply_is_weaker() -> None:
    whole, half, sagging = (Machine(None, *names) for names in ((), ("phase.X1",), ("supply",)))
    for axis in ("X1", "Y1", "Z1"):
        sagging.bus.send(protocol.move(axis, 400))
    sagging.rest(0.02)
    pulls = [each.gantries.bench.model.actuator_forcerange[:3, 1].copy() for each in (whole, half, sagging)]
    whole.rest(0.01)
    assert half.gantries._pulls([[0.0] * 6]).tolist() == [[100, 200, 200, 200, 200, 200]]  # type: ignore[arg-type]
    assert (pulls[2] < 85).all()


@pytest.mark.parametrize(
    ("fault", "status"), [("switch.Y1.high.on", Status.RAIL), ("switch.Y1.high.off", Status.FREE)]
)
def test_a_switch_that_is_stuck_stops_a_motor_always_or_never(fault: str, status: Status) -> None:
    machine = Machine(None, fault)
    machine.rest(0.01)
    machine.bus.send(protocol.move("Y1", 10_667 - 400 + 40))
    assert machine.bus.wait_free(NUMBERS["Y1"], LONG) is status


def test_slow_fingers_are_still_open_when_the_hand_says_that_it_is_done() -> None:
    for fault, done in (("fingers.2", True), ("fingers.1", False)):
        machine = Machine(None, fault)
        machine.bus.send(protocol.actuate(1, "HAND", 1))
        machine.rest(0.15)
        assert bool(machine.gantries.bench.data.ten_length[0] < 0.005) is done


def test_beams_that_are_stuck_read_one_level() -> None:
    assert [
        Machine(None, f"beam.1.{level}").gantries.beam(NUMBERS["HAND1"]) for level in ("cut", "free")
    ] == [True, False]


@pytest.mark.slow
def test_a_program_that_stops_before_its_first_statement_has_stopped_and_is_not_done(
    command: Command,
) -> None:
    words = "sigma chess --pieces 1 --seed 11 --fault status.X1.A.high --no-keep --json"
    code, out, _ = command(*words.split())
    found = json.loads(out)
    assert (code, found["completed"], found["message"]) == (
        1,
        False,
        "ABORT X1 RAIL 0.00; no task started this motion",
    )
    assert [fault["name"] for fault in found["world"]["faults"]] == ["status.X1.A.high"]


@pytest.mark.slow
def test_trials_of_faults_say_what_the_program_and_the_diagnosis_found(command: Command) -> None:
    words = "faults --task chess --seed 11 --only status.X1.A.high --jobs 1 --json"
    code, out, _ = command(*words.split())
    (found,) = json.loads(out)["faults"]
    assert (code, found["outcome"], found["named"]) == (0, "named", "status line A of X1")
    assert command("faults", "--task", "gantries", "--only", "supply")[0] == 2
    assert command("faults", "--task", "chess", "--stage", "1")[0] == 2


def test_a_fault_of_a_segment_that_is_not_there_is_refused() -> None:
    assert "interface.1" not in every_fault()
    with pytest.raises(BadArgument):
        catalogue().kind("interface")
