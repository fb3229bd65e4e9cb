"""The bus from the command line and from Python: demonstrations, statistics, self-tests, and its diagrams."""

import json
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from pathlib import Path

import pytest
from sigma_bench import LoggedBus

import handeye
from handeye.ports.microbus import Status
from handeye.systems.sigma.bus.demo import demonstrate, verdict
from handeye.systems.sigma.bus.diagram import as_svg, as_text
from handeye.systems.sigma.bus.faults import KINDS, defect
from handeye.systems.sigma.bus.layout import LINE, SUPERSIGMA
from handeye.systems.sigma.bus.statistics import error_rate
from handeye.systems.sigma.diagnosis.power_on import power_on, told
from handeye.systems.sigma.protocol import AXES, NUMBERS, move, position, set_position

Command = Callable[..., tuple[int, str, str]]


@pytest.mark.sigma_row(4)
def test_the_demonstration_has_a_late_riser_that_does_no_harm(command: Command) -> None:
    code, out, _ = command("sigma", "bus", "demo", "--late-riser")
    assert code == 0
    assert out.endswith("every byte arrived as it was sent; the count of Y1 is 4668, as it should be\n")


@pytest.mark.sigma_row(4)
def test_with_a_long_strobe_the_late_riser_takes_a_command_that_was_never_sent(command: Command) -> None:
    code, out, _ = command("sigma", "bus", "demo", "--late-riser", "--fault", "long-strobe", "--json")
    found = json.loads(out)
    figures = found["figures"]
    assert (code, found["completed"], figures["count"], figures["expected"]) == (1, False, 767, 4668)
    assert "Y1 takes 01 07 01 02 FF, which was never sent, and acts: SET_POSITION Y1 767" in found["message"]
    assert {event["kind"] for event in figures["events"]} >= {
        "sent",
        "taken",
        "spoken",
        "heard",
        "answered",
        "status",
    }


@pytest.mark.parametrize(
    ("fault", "harm"),
    [
        ("dead:Y1", "NOANSWER 1"),
        ("clock:Y1:200", "Y1 takes"),
        ("stuck-high:0:3", "X1 does not act on 00 01 07 01 02, which was sent to X1"),
        ("dead-interface", "NOANSWER"),
        ("slow-lines:8", "takes FF"),
        ("address:X1:1", "X1 acts on 01 05 00 00 00, which was sent to Y1"),
    ],
)
def test_a_fault_of_the_bus_does_its_harm(fault: str, harm: str) -> None:
    shown = demonstrate([defect(fault)])
    assert not shown.right
    assert harm in " ".join(verdict(shown))


@pytest.mark.parametrize("fault", KINDS)
def test_every_kind_of_fault_can_be_asked_for_by_its_name_alone(fault: str) -> None:
    LoggedBus(fault, layout=LINE).send(move("X1", 8))


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("demo --fault nonsense", "there is no bus fault `nonsense`; the bus faults are stuck-low"),
        ("demo --fault no-turn", "there is no regenerator before segment 1 on this bus"),
        ("demo --fault dead:Q9", "there is no microcomputer `Q9`"),
        ("demo --fault dead:77", "there is no microcomputer 77 on this bus"),
        ("demo --fault stuck-low:0:9", "the bit of a fault must be between 0 and 7, not 9"),
        (
            "demo --fault dead:X1:3",
            "`dead:X1:3` has too many fields for this fault: write dead:MICROCOMPUTER",
        ),
        ("errors --clock 80", "the error of the clocks must be between 0 and 50 percent, not 80"),
        ("demo --out a.png", "a.png: the name of the SVG drawing must end in .svg"),
    ],
)
def test_what_cannot_be_shown_is_refused_in_a_sentence(words: str, why: str, command: Command) -> None:
    code, _, err = command("sigma", "bus", *words.split())
    assert code == 2
    assert why in " ".join(err.split())


def test_a_drawing_is_not_written_over_unless_that_is_said(command: Command) -> None:
    assert command("sigma", "bus", "demo", "--out", "bus.svg")[0] == 0
    drawn = Path("bus.svg").read_bytes()
    code, _, err = command("sigma", "bus", "demo", "--out", "bus.svg")
    assert (code, "--overwrite replaces it" in err) == (2, True)
    assert command("sigma", "bus", "demo", "--out", "bus.svg", "--overwrite")[0] == 0
    assert Path("bus.svg").read_bytes() == drawn


def test_the_drawing_has_all_lines_and_what_each_receiver_took() -> None:
    shown = demonstrate([defect("long-strobe")], late_riser=True, all_lines=True)
    root = ElementTree.fromstring(as_svg(shown.diagrams[0]))  # noqa: S314 - our own
    texts = [element.text for element in root.iter() if element.tag.endswith("text")]
    lines = [f"D{bit}" for bit in range(8)] + ["/DATA READY", "/ANSWER READY", "interrupt"]
    assert {*lines, *(f"{name} {line}" for name in NUMBERS for line in "AB")} <= {*texts}
    wrong = [e.text for e in root.iter() if e.tag.endswith("text") and e.get("class") == "r"]
    assert wrong == ["01", "07", "01", "02", "FF"]


def test_the_text_shows_where_bytes_begin_and_where_they_are_taken() -> None:
    lines = as_text(demonstrate().diagrams[0], 115, ascii=True)
    data = next(line for line in lines if line.startswith("data"))
    assert re.findall(r"\|(\w\w)", data) == ["00", "01", "07", "01", "02"]
    taken = next(line for line in lines if line.startswith("Z2"))
    assert [data[: place + 1].count("|") for place, sign in enumerate(taken) if sign == "^"] == [
        1,
        2,
        3,
        4,
        5,
    ]
    assert all(ord(sign) < 128 for line in lines[1:] for sign in line)
    assert max(map(len, lines)) <= 115


@pytest.mark.sigma_row(5)
@pytest.mark.slow
def test_no_command_of_two_hundred_thousand_is_misread_by_clocks_within_two_percent() -> None:
    rate = error_rate(0.02, 200_000)
    assert (rate.misread, rate.whole + rate.missed) == (0, 200_000)
    assert rate.whole > 110_000


@pytest.mark.sigma_row(5)
@pytest.mark.slow
def test_errors_begin_at_five_percent() -> None:
    none, some = error_rate(0.048, 20_000), error_rate(0.06, 20_000)
    assert none.misread == 0
    assert some.misread > 20
    assert some.fast == pytest.approx(0.049, abs=0.001)
    assert some.slow is None


def test_the_statistics_are_a_command(command: Command) -> None:
    code, out, _ = command("sigma", "bus", "errors", "--commands", "300", "--clock", "2", "--json")
    (rate,) = json.loads(out)["figures"]["rates"]
    assert (code, rate["commands"], rate["misread"]) == (0, 300, 0)


@pytest.mark.sigma_row(38)
@pytest.mark.parametrize(
    ("fault", "named"),
    [
        (
            "dead-interface:2",
            "segment 2: no microcomputer on this segment answers: the interface",
        ),
        ("dead:Z1", "Z1: it is dead: it does not answer"),
        ("dead:FORCE2", "FORCE2: it is dead: it does not answer"),
        ("stuck-high:1:3", "segment 1: data line 3 is stuck high"),
        ("clock:HAND2:-100", "HAND2: its clock is wrong"),
        ("address:X1:1", "X1: it answers to Y1's number instead of its own"),
        ("status-a:Y2:1", "status line of Y2: line A is high, although no motion was aborted"),
        *((f"stuck-low:0:{bit}", f"segment 0: data line {bit} is stuck low") for bit in range(8)),
    ],
)
def test_the_self_tests_of_power_on_name_the_part_that_fails(fault: str, named: str) -> None:
    layout = LINE if fault in ("dead-interface:2", "stuck-high:1:3") else SUPERSIGMA
    (found,) = told(power_on(LoggedBus(fault, layout=layout), layout))
    assert found.startswith(named)


@pytest.mark.sigma_row(42)
@pytest.mark.parametrize("segment", [1, 2])
def test_a_regenerator_that_does_not_turn_is_named(segment: int) -> None:
    found = told(power_on(LoggedBus(f"no-turn:{segment}", layout=LINE), LINE))
    assert found == [
        f"regenerator {segment}: it does not reverse its direction: strobes of answers arrive, but no data"
    ]


@pytest.mark.sigma_row(38)
def test_behind_a_dead_interface_all_fail_and_elsewhere_all_work() -> None:
    bus = LoggedBus("dead-interface:2", layout=LINE)
    for place in LINE.places:
        bus.send(set_position(place.number, 5))
    acted = {event.number for event in bus.taken() if event.own}
    assert acted == {place.number for place in LINE.places if place.segment < 2}


@pytest.mark.sigma_row(38)
def test_a_dead_microcomputer_fails_alone() -> None:
    bus = LoggedBus("dead:Y1")
    for axis in AXES:
        bus.send(move(axis, 40))
    bus.settled(*AXES)
    moved = {axis for axis in AXES if bus.motor(NUMBERS[axis]).sent(bus.now * 1_000_000) == 40}
    assert moved == {*AXES} - {"Y1"}


def test_the_self_tests_are_a_command(command: Command) -> None:
    assert command("sigma", "bus", "test", "--line")[:2] == (
        0,
        "no fault found in the computer, segments, microcomputers and status lines\n",
    )
    assert command("sigma", "bus", "test", "--fault", "dead:Z1")[:2] == (
        1,
        "Z1: it is dead: it does not answer\n",
    )


@pytest.mark.sigma_row(49)
def test_a_python_program_sends_asks_and_reads_status_as_the_computer_does() -> None:
    driven = handeye.Microbus()
    driven.command("X1", "ORIGIN")
    assert driven.status("X1") == "busy"
    assert driven.wait("X1") == "free"
    driven.command("X1", steps=800)
    assert (driven.wait("X1"), driven.ask("X1"), driven.interrupt) == ("free", 800, False)
    driven.command("X1", steps=-2000)
    assert (driven.wait("X1"), driven.interrupt) == ("rail", True)
    assert driven.ask("X1", "ABORT_POSITION") == -1
    assert driven.frames[:3] == ["00 04 00 00 00", "00 01 00 03 20", "00 05 00 00 00"]
    assert "X1 takes 00 01 00 03 20, and acts: MOVE X1 by 800 steps, curve 0" in "\n".join(driven.log)
    assert "/DATA READY" in driven.diagram(0, 0.0002)
    assert driven.svg(0, 0.0002).startswith("<svg ")


@pytest.mark.sigma_row(49)
def test_the_log_from_python_is_that_of_the_port() -> None:
    driven, bus = handeye.Microbus(seed=3), LoggedBus(seed=3)
    driven.command("Z2", steps=-250, curve=1)
    driven.wait("Z2")
    driven.ask("Z2")
    bus.send(move("Z2", -250, 1))
    assert bus.wait_free(NUMBERS["Z2"], 10**8) is Status.FREE
    bus.ask(position("Z2"), 2)
    from handeye.systems.sigma.bus.words import event_text

    assert driven.log == [event_text(event) for event in sorted(bus.log, key=lambda event: event.at)]


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        (
            lambda bus: bus.command("Q1", steps=1),
            "there is no microcomputer `Q1`; the microcomputers are X1, Y1",
        ),
        (lambda bus: bus.command("X1", "JUMP"), "there is no operation `JUMP`; the operations are MOVE"),
        (lambda bus: bus.command("X1"), "a move in steps must be between 1 and 65535, not 0"),
        (lambda bus: bus.command("X1", steps=1, curve=5), "a curve must be between 0 and 4, not 5"),
        (lambda bus: bus.command("X1", "POSITION"), "POSITION is a question; use ask"),
        (lambda bus: bus.ask("X1", "MOVE"), "the answer to MOVE has no known length"),
        (lambda bus: bus.pause(-1), "a time on the bus must be between 0 and 86400 s, not -1 s"),
        (lambda bus: bus.diagram(1, 0), "a diagram must end after its beginning"),
        (lambda _: handeye.Microbus(faults=["dead:Q"]), "there is no microcomputer `Q`"),
        (lambda _: handeye.Microbus(clock_spread=2), "the clock error must be a fraction from 0 to 1"),
    ],
)
def test_a_wrong_call_from_python_is_refused_in_a_sentence(
    wrong: Callable[[handeye.Microbus], object], why: str
) -> None:
    with pytest.raises(handeye.InvalidInput, match=re.escape(why)):
        wrong(handeye.Microbus())


def test_supersigma_fills_one_segment_and_a_line_has_three() -> None:
    assert [len(segment) for segment in SUPERSIGMA.segments] == [10]
    assert [len(segment) for segment in LINE.segments] == [10, 10, 6]
