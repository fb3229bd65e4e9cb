"""Touches in physics: the period, the servo and the speed of a guarded descent."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from ml_bench import ROOT

from handeye.core.errors import BadArgument
from handeye.systems.ml.bench.touch import STIFFNESS, lines, touch, worst
from handeye.systems.ml.bench.touches import touches_page
from handeye.systems.ml.machine.spec import GRAM_FORCE

Command = Callable[..., tuple[int, str, str]]


def test_the_limit_is_noticed_in_the_first_reading_beyond_it() -> None:
    for phase in (0.0, 0.5):
        found = touch(10, 50, 50, phase=phase)
        assert found.noticed in found.readings
        at = [n for n, time in enumerate(found.times) if time <= found.noticed][-1]
        assert found.forces[at] / 2 > 300 * GRAM_FORCE > found.forces[at - 10] / 2


@pytest.mark.slow
def test_the_way_is_bounded_by_the_limit_the_period_and_the_lag_of_the_servo() -> None:
    for period, bandwidth, speed in ((5, 50, 100), (10, 20, 100), (10, 50, 200), (50, 50, 50)):
        found = worst(period, bandwidth, speed)
        assert 0.6 * found.bound < found.way < 1.07 * found.bound
        assert found.force == pytest.approx(2 * STIFFNESS * found.way / 1000, rel=0.05)


def test_a_slower_clock_goes_on_farther_and_a_stiffer_servo_starts_harder() -> None:
    ways = [touch(period, 50, 100).way for period in (2, 10, 50)]
    assert 1.5 * ways[0] < ways[1] < ways[2] / 1.5
    jolts = [touch(10, bandwidth, 200) for bandwidth in (10, 50)]
    assert [each.trips for each in jolts] == [False, True]


def test_equal_touches_are_equal() -> None:
    assert touch(20, 50, 100) == touch(20, 50, 100)


@pytest.mark.parametrize(("values", "sentence"), [
    ((0, 50, 25), "the period must be from 1 to 100 ms, not 0"),
    ((10, 200, 25), "the bandwidth must be from 5 to 120 Hz, not 200"),
    ((10, 50, 201), "the speed must be from 1 to 200 mm/s, not 201"),
    ((10, 50, 25, 5), "the limit must be from 10 to 1500 grams, not 5"),
    ((10, 50, 25, 300, 1.0), "the phase must be from 0 to 0.999 periods, not 1"),
    ((10, 50, float("nan")), "the speed must be from 1 to 200 mm/s, not nan"),
])  # fmt: skip
def test_values_out_of_range_are_refused(values: tuple[float, ...], sentence: str) -> None:
    with pytest.raises(BadArgument) as refused:
        touch(*values)  # type: ignore[arg-type]  # the first is whole
    assert str(refused.value) == sentence


def test_the_command_prints_a_touch(command: Command) -> None:
    code, out, _ = command("ml", "touch", "--speed", "50", "--json")
    found = json.loads(out)
    assert (code, found["period"], found["way"]) == (0, 10, touch(10, 50, 50).way)
    _, out, _ = command("ml", "touch", "--speed", "50")
    assert f"the slide goes on by   {found['way']:.2f} mm" in out.splitlines()
    code, _, err = command("ml", "touch", "--page", "x.html", "--speed", "3")
    assert (code, Path("x.html").exists()) == (2, False)
    assert err.startswith("handeye: --page shows all periods")


def test_the_figures_of_the_page_in_the_docs_are_those_of_the_physics() -> None:
    text = (ROOT / "docs/ten_milliseconds.md").read_text(encoding="utf-8")
    way, force = (row.split("|") for row in text.splitlines() if row.startswith("| 20 ms |"))
    found = worst(20, 50, 100)
    assert (way[6].strip(), force[6].strip()) == (f"{found.way:.2f}", f"{found.force:.1f}")
    assert "\n".join(lines(touch())) in text


def test_the_page_has_a_touch_for_each_choice() -> None:
    one = touch(10, 50, 50)
    page = touches_page([one] * 120).decode()
    data = json.loads(page.split('id="touches" type="application/json">')[1].split("</script>")[0])
    assert len(data["touches"]) == len(data["period"]) * len(data["bandwidth"]) * len(data["speed"])
    assert data["touches"][0]["way"] == one.way
