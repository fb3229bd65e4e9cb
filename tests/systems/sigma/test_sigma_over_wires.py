"""MAL programs over the wires: the frames that Python sends, kept and resumed, with faults, and the load of the bus."""

import json
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from pathlib import Path

import pytest
from mal_bench import PLANS, mal

import handeye
from handeye.core.variation import WorldSpec
from handeye.program.events import to_line
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import read_checkpoint, write_checkpoint
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.sigma.bus.events import CommandSent
from handeye.systems.sigma.bus.faults import defect
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.run.over_wires import over_wires
from handeye.systems.sigma.run.plan import MalPlan

Command = Callable[..., tuple[int, str, str]]


@pytest.mark.sigma_row(49)
def test_a_python_program_sends_the_same_bytes_as_the_same_mal() -> None:
    text = "10 ORIGIN X1\n20 MOVE X1 BY 30\n30 B = BEAM(1)\n40 ACTUATE HAND1 = 1\n50 MOVE X1 BY -3\n"
    found, _, log = over_wires(program_of("same.mal", text), 2000)
    assert found.completed
    bus = handeye.Microbus()
    bus.command("X1", "ORIGIN")
    bus.wait("X1")
    bus.command("X1", steps=800)
    bus.wait("X1")
    bus.ask("HAND1", "BEAM")
    bus.command("HAND1", "ACTUATE", value=1)
    bus.wait("HAND1")
    bus.command("X1", steps=-80)
    assert bus.frames == [event.frame.hex(" ") for event in log if isinstance(event, CommandSent)]


@pytest.mark.sigma_row(40)
def test_a_run_over_the_wires_is_kept_anywhere_and_resumed_to_the_same_bytes(tmp_path: Path) -> None:
    def begun() -> Runner:
        plan = MalPlan(name="handover.mal", text=mal("handover"), arm="wired")
        return Runner(
            Checkpoint(setup=Setup(system="sigma", plan=plan, world=WorldSpec(seed=0), camera="auto"))
        )

    whole = begun()
    advance(whole)
    whole.finish()
    for steps in (2, 29):
        first = begun()
        advance(first, steps=steps)
        write_checkpoint(tmp_path / f"{steps}.checkpoint", first.checkpoint())
        second = Runner(read_checkpoint(tmp_path / f"{steps}.checkpoint"))
        advance(second)
        second.finish()
        assert [*map(to_line, second.events)] == [*map(to_line, whole.events)]


def test_a_dead_microcomputer_stops_a_program_that_asks_it() -> None:
    found, _, _ = over_wires(
        program_of("ask.mal", "10 B = BEAM(1)\n20 PRINT B\n"), 2000, [defect("dead:HAND1")]
    )
    assert not found.completed
    assert found.message.endswith("arrived before the time limit (HAND1)")


def test_a_slow_clock_is_seen_in_what_is_taken() -> None:
    text = "10 FOR N = 1 TO 9\n20 MOVE X1 BY 5\n30 NEXT N\n"
    found, _, _ = over_wires(program_of("slow.mal", text), 2000, [defect("clock:Y2:200")])
    assert (found.completed, found.misread) == (True, 9)


@pytest.mark.parametrize(
    "fault", ["dead:X1", "dead-interface", "address:X1:1", "clock:X1:200", "status-b:X1:0"]
)
def test_a_motor_that_does_not_begin_stops_the_program_at_its_first_command(fault: str) -> None:
    found, _, _ = over_wires(program_of("one.mal", "10 MOVE X1 BY 5\n"), 2000, [defect(fault)])
    assert found.message == "line 10: NOTSTARTED: X1 has not begun to execute its command"


def test_a_hand_that_does_not_begin_stops_the_program_and_one_that_switches_a_lamp_need_not_be_busy() -> None:
    text = "10 ACTUATE LAMP = 1\n20 ACTUATE HAND1 = 1\n"
    assert over_wires(program_of("hand.mal", text), 2000)[0].completed
    found, _, _ = over_wires(program_of("hand.mal", text), 2000, [defect("dead:HAND1")])
    assert found.message == "line 20: NOTSTARTED: HAND1 has not begun to execute its command"


def test_the_bus_of_a_program_is_a_command_with_a_drawing(command: Command) -> None:
    where = str(PLANS / "handover.mal")
    code, out, _ = command(
        "sigma", "bus", "run", where, "--begin", "1.24", "--end", "1.26", "--out", "run.svg"
    )
    assert code == 0
    assert "87 commands in 16.9" in out
    root = ElementTree.fromstring(Path("run.svg").read_text("utf-8"))  # noqa: S314 - our own
    assert "handover.mal" in [element.text for element in root.iter()]
    code, out, _ = command("sigma", "bus", "run", where, "--json")
    found = json.loads(out)["figures"]
    assert (code, found["completed"], found["commands"], found["misread"]) == (0, True, 87, 0)
    assert found["saturation"] == pytest.approx(found["per_second"] / 10_000)


def test_a_drawing_of_a_whole_run_has_every_command_and_a_row_a_receiver(command: Command) -> None:
    command("sigma", "bus", "run", str(PLANS / "handover.mal"), "--out", "whole.svg")
    root = ElementTree.fromstring(Path("whole.svg").read_text("utf-8"))  # noqa: S314 - our own
    assert len([e for e in root.iter() if e.tag.endswith("rect") and e.get("class") == "d"]) == 5 * 87
    texts = [e.text or "" for e in root.iter() if e.tag.endswith("text")]
    assert [texts.count(name) for name in ("X1", "FORCE2", "ms")] == [1, 1, 1]
    own = [int(found[1]) for text in texts if (found := re.fullmatch(r"\d+ frames, (\d+) own", text))]
    assert sum(own) == 87


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("none.mal", "none.mal"),
        (f"{PLANS}/handover.mal --out a.svg --begin 3 --end 2", "a diagram must begin at 0 s or later"),
        (f"{PLANS}/handover.mal --out a.svg --begin nan", "a diagram must begin at 0 s or later"),
        (f"{PLANS}/handover.mal --out a.svg --end 1e9", "a diagram must begin at 0 s or later"),
        (f"{PLANS}/handover.mal --begin 3", "apply only to the diagram: give --out too"),
        (f"{PLANS}/handover.mal --all-lines", "apply only to the diagram: give --out too"),
        (f"{PLANS}/handover.mal --fault dead:77", "there is no microcomputer 77"),
    ],
)
def test_a_run_that_cannot_be_is_refused_in_a_sentence(words: str, why: str, command: Command) -> None:
    code, _, err = command("sigma", "bus", "run", *words.split())
    assert code == 2
    assert why in " ".join(err.split())
