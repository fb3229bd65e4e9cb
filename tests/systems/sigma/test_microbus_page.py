"""The page of the MICROBUS shows what is printed and drawn; `--update -n 0` writes what is today."""

import re
import shlex
from collections.abc import Callable
from pathlib import Path
from typing import Final

import pytest
from figures import as_recorded
from walked_pages import walked, with_outputs

from handeye.systems.sigma.bus.demo import demonstrate
from handeye.systems.sigma.bus.diagram import as_svg, diagram
from handeye.systems.sigma.bus.faults import defect
from handeye.systems.sigma.mal.virtual_machine import STATEMENT_US
from handeye.systems.sigma.motors import drawing
from handeye.systems.sigma.motors.study import study
from handeye.systems.sigma.protocol import Timing
from handeye.systems.sigma.run.over_wires import over_wires
from handeye.systems.sigma.run.plan import MalPlan

DOCS: Final = Path(__file__).parents[3] / "docs"
PAGE: Final = DOCS / "microbus.md"
Command = Callable[..., tuple[int, str, str]]


def _pictures() -> dict[str, str]:
    shown = demonstrate()
    late = demonstrate([defect("long-strobe")], late_riser=True)
    program = MalPlan(
        name="handover.mal", text=(DOCS.parent / "plans/handover.mal").read_text("utf-8")
    ).program
    _, bus, log = over_wires(program, STATEMENT_US)
    return {
        "microbus_run.svg": as_svg(diagram("handover.mal", log, 0, bus.now, bus.timing)),
        "microbus_command.svg": as_svg(shown.diagrams[0]),
        "microbus_answer.svg": as_svg(shown.diagrams[1]),
        "microbus_late_riser.svg": as_svg(late.diagrams[0]),
        "sigma_axis.svg": drawing.as_svg(study(mass=8.0, steps=8000)),
    }


@pytest.mark.slow
def test_the_page_shows_what_its_commands_print(
    command: Command, request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("handeye.cli.common.screen.width", 120)
    Path("handover.mal").write_bytes((DOCS.parent / "plans/handover.mal").read_bytes())

    def run(line: str) -> tuple[int, str]:
        code, out, _ = command(*shlex.split(line))
        return code, out

    typed = walked(PAGE.read_text(encoding="utf-8"), run)
    if request.config.getoption("--update"):
        PAGE.write_text(with_outputs(PAGE.read_text(encoding="utf-8"), typed), encoding="utf-8")
        return
    assert [each.line for each in typed if each.code not in (0, 1)] == []
    assert [(each.line, each.printed) for each in typed if not each.stands] == []
    assert len(typed) >= 10


def test_the_drawings_are_those_that_the_program_makes(request: pytest.FixtureRequest) -> None:
    for name, drawn in _pictures().items():
        place = DOCS / "pictures" / name
        if request.config.getoption("--update"):
            place.write_text(drawn, encoding="utf-8")
        assert as_recorded(drawn, place.read_text(encoding="utf-8")) == place.read_text(encoding="utf-8")


def test_the_table_has_every_time_of_the_protocol() -> None:
    rows = re.findall(r"^\| (`.*?`) \| ([\d, ]+) \|", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    shown = {
        name: int(value)
        for names, values in rows
        for name, value in zip(re.findall(r"`(\w+)`", names), values.split(", "), strict=True)
    }
    assert shown == {name: getattr(Timing(), name) for name in Timing.__struct_fields__}
