"""What holds for every text whatsoever."""

import re
import string
from pathlib import Path

import pytest
from al_support import LISTING, TAUGHT, diagnose, said
from any_texts import PUMP, ROOT, spoiled, texts
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from handeye import al
from handeye.al import AL
from handeye.al.parser import parse
from handeye.al.scanner import scan
from handeye.arm.robots.stanford import STANFORD
from handeye.core.diagnostics import has_errors, render
from handeye.core.errors import InvalidInput
from handeye.core.source import Source, read_source
from handeye.planning.planner import plan_program
from handeye.program.taught import load_taught

PUMP_TAUGHT = load_taught(ROOT / "plans" / "water_pump.toml")


@given(texts)
def test_no_text_makes_the_compiler_fail(text: str) -> None:
    source = Source(name="any.al", text=text)
    program, diagnostics = al.compile_text(source, TAUGHT)
    assert (program is None) == any(d.severity == "error" for d in diagnostics)
    assert all(render(d, source) for d in diagnostics)


@pytest.mark.slow
@settings(max_examples=25)
@given(spoiled([PUMP]))
def test_no_spoiling_of_the_pump_script_makes_checker_or_planner_fail(text: str) -> None:
    source = Source(name="water_pump.al", text=text)
    program, diagnostics = al.compile_text(source, PUMP_TAUGHT)
    if program is not None:
        plan, problems = plan_program(program, STANFORD, AL)
        assert (plan is None) == has_errors(problems)
        diagnostics += problems
    assert all(render(d, source) for d in [*diagnostics, *al.extensions(source)])


@pytest.mark.slow
@settings(max_examples=50)
@given(spoiled([PUMP]))
def test_tidying_a_spoiled_pump_script_keeps_what_it_says(text: str) -> None:
    assert said(parse(al.format_text(text))[0]) == said(parse(text)[0])


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.binary(max_size=80))
@example(b"\xef\xbb\xbfPARK")
@example(b"PARK\0\r\n\xff")
@example(b"PARK\rSTOP")  # lines that end as on early Macintosh computers
def test_any_bytes_in_a_file_are_a_text_or_refused_in_a_sentence(tmp_path: Path, data: bytes) -> None:
    file = tmp_path / "any.al"
    file.write_bytes(data)
    try:
        text = data.removeprefix(b"\xef\xbb\xbf")
        assert read_source(file).text.encode() == (text if b"\n" in text else text.replace(b"\r", b"\n"))
    except InvalidInput as refused:
        pattern = r"any\.al is not UTF-8 text: byte \d+ is 0x[0-9a-f]{2}$"
        assert re.search(pattern, str(refused))  # noqa: PT017 - a file may also be read; that is held to above


@given(texts)
@example("DEFINE M\x1f\n")  # no blank, though Python takes it for one
@example("CHANGE [0, 0] 1")  # without its blank `0,0` would be a wrongly written number
@example("CHANGE [0 ,0] 1")
@example("OPEN O.5")
@example("OPEN O .5")
def test_formatting_keeps_the_meaning(text: str) -> None:
    tree, mistakes = parse(text)
    again, still = parse(al.format_text(text))
    assert said(again) == said(tree)
    assert [d.code for d in still] == [d.code for d in mistakes]


@given(texts)
def test_formatting_twice_changes_nothing_more(text: str) -> None:
    once = al.format_text(text)
    assert al.format_text(once) == once


@given(texts)
def test_formatting_keeps_every_line_and_comment(text: str) -> None:
    before, after = scan(text), scan(al.format_text(text))
    assert [line.comment for line in after] == [line.comment for line in before]
    assert [line.is_blank for line in after] == [line.is_blank for line in before]


@given(st.text(alphabet=string.printable, max_size=60))
def test_scanning_loses_no_visible_character(text: str) -> None:
    seen = "".join("".join(t.text for t in line.tokens) + (line.comment or "") for line in scan(text))
    assert "".join(seen.split()) == "".join(text.split())


def test_steps_lead_only_to_steps() -> None:
    program, _ = al.compile_text(Source(name="x.al", text=LISTING), TAUGHT)
    assert program is not None
    targets = [step.next for step in program.steps]
    assert all(t is None or 0 <= t < len(program.steps) for t in targets)


def test_listing_is_laid_out_in_columns() -> None:
    assert al.format_text("l1: move   T ;go\n stop [ 0 0  -50 ]\n;note\n\n  ;note") == (
        "l1:     MOVE    T               ;go\n        STOP    [0 0 -50]\n;note\n\n        ;note\n"
    )


def test_long_program_is_compiled_in_full() -> None:
    text = "".join(LISTING.replace("L1", f"L{i}") for i in range(140))
    assert diagnose(text) == []
    assert len(al.compile_text(Source(name="x.al", text=text), TAUGHT)[0].steps) == 2100
