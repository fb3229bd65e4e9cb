"""What `python -m benchmarks language` measures, and how it says so."""

import json
import re
from collections.abc import Iterator

import pytest
from conftest import Command

from benchmarks.keystrokes import typed
from benchmarks.language import Waiting, script
from handeye.al import compile_text
from handeye.core.source import Source
from handeye.program.taught import Taught

QUICK = Waiting(what="a check", seconds=(0.03, 0.01, 0.02), target=0.025)
SLOW = Waiting(what="a plan", seconds=(2.0, 3.0), target=1.0)


def result_of(monkeypatch: pytest.MonkeyPatch, *found: Waiting) -> None:
    def measured(times: int) -> Iterator[Waiting]:
        assert times == 15
        yield from found

    monkeypatch.setattr("benchmarks.language.measure", measured)


@pytest.mark.parametrize("lines", [1000, 2400])
def test_a_measured_script_has_its_lines_and_nothing_is_said_about_it(lines: int) -> None:
    text = script(lines, 1)
    program, diagnostics = compile_text(Source(name="pins.al", text=text), Taught())
    assert text.count("\n") == lines
    assert program is not None
    assert diagnostics == []


def test_no_measured_script_is_the_one_before() -> None:
    first, second = script(50, 1).splitlines(), script(50, 2).splitlines()
    shared = [line for line in first if line in second]
    assert [line for line in shared if re.search(r"\d_\d|\[(18|30)", line)] == []


def test_a_median_is_held_to_its_target() -> None:
    assert (QUICK.median, QUICK.is_short) == (0.02, True)
    assert (SLOW.median, SLOW.is_short) == (2.5, False)


def test_a_slow_computer_misses_a_target_and_is_no_failure(
    monkeypatch: pytest.MonkeyPatch, benchmark: Command
) -> None:
    result_of(monkeypatch, QUICK, SLOW)
    code, out, _ = benchmark("language")
    assert code == 0
    assert out.splitlines() == [
        "a check                       20.0 ms  (under 25 ms)  15 times, 10.0 to 30.0 ms",
        "a plan                      2500.0 ms  (not under 1000 ms)  15 times, 2000.0 to 3000.0 ms",
    ]


def test_the_bench_tells_a_program_what_it_measured(
    monkeypatch: pytest.MonkeyPatch, benchmark: Command
) -> None:
    result_of(monkeypatch, QUICK)
    code, out, err = benchmark("language", "--json")
    (measured,) = json.loads(out)["measured"]
    assert (code, measured["median_wall_s"], measured["met"], len(measured["each_wall_s"])) == (
        0,
        0.02,
        True,
        3,
    )
    assert err.startswith("a check")


def test_the_bench_wants_to_measure_at_least_once(benchmark: Command) -> None:
    assert benchmark("language", "--times", "0") == (
        2,
        "",
        "handeye: the number of times must be at least 1, not 0\n",
    )


@pytest.mark.slow
def test_every_keystroke_is_answered_by_the_language_server() -> None:
    assert len(typed("        MOVE    P\n        SAVE    H\n", 2, 3)) == 3
