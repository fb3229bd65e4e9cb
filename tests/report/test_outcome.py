"""The outcome of a run is read from its last events and from the referee's word."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import pytest
from recordings import EVENTS
from report_pages import Node, page_of, recorded, tree
from results import result

from handeye.program import events as happened
from handeye.program.diagnosis.causes import NothingBetween
from handeye.program.events import AnyEvent
from handeye.report.facts.outcome import Kind, outcome
from handeye.report.recorded import RecordedRun
from handeye.results.result import Check, Result

WRONG = Check(
    ok=False, subject="gap under a head", value=5.0, relation="at most", limit=0.2, unit="mm",
    sentence="gap under a head (at most 0.2 mm)",
)  # fmt: skip
STARTED = happened.StepStarted(time=1.0, step=1, line=4, text="CLOSE .1")
CALLED = happened.OperatorCalled(time=2.0, message="THE GASKET LIES OFF ITS PLACE")
STOPPED: Sequence[AnyEvent] = (
    STARTED,
    CALLED,
    happened.StageFinished(time=2.0, stage="open", status="stopped"),
    happened.RunFinished(time=2.0, completed=False),
)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    return recorded(tmp_path_factory.mktemp("run") / "trace.mcap")


def ending(run: RecordedRun, events: Sequence[AnyEvent], came: Result | None = None) -> RecordedRun:
    """The run, which ends with these events after it has begun its first stage."""
    return replace(run, trace=replace(run.trace, events=(*run.trace.events[:2], *events)), result=came)


def reasons(head: Node) -> list[str]:
    """What is said large in the head of a page."""
    return [node.text for node in head.all("p") if node.attributes.get("class") == "reason"]


DONE = [EVENTS[-1]]


@pytest.mark.parametrize(
    ("events", "came", "kind"),
    [
        (DONE, result(completed=True, assembled=True), "right"),
        (DONE, result(completed=True, assembled=False, checks={"gap": WRONG}), "wrong"),
        (DONE, result(completed=True, assembled=None), "ended"),
        (DONE, None, "ended"),
        (STOPPED, None, "stopped"),
        ([STARTED, happened.PanicStopped(time=2.0)], None, "panic"),
        ([STARTED], None, "paused"),
    ],
)
def test_it_is_of_one_kind(run: RecordedRun, events: list[AnyEvent], came: Result | None, kind: Kind) -> None:
    assert outcome(ending(run, events, came)).kind == kind


def test_a_trace_that_was_cut_short_breaks_off_whatever_it_says(run: RecordedRun) -> None:
    assert outcome(replace(ending(run, [STARTED, CALLED]), whole=False)).kind == "broken off"


def test_a_stop_is_told_with_its_line_its_stage_and_its_reason(run: RecordedRun) -> None:
    found = outcome(ending(run, STOPPED))
    assert (found.step, found.stage, found.call, found.time) == (STARTED, "open", CALLED, 2.0)


def test_a_call_that_was_answered_stops_nothing(run: RecordedRun) -> None:
    answered = happened.OperatorAnswered(time=2.0, choice="proceed", step=2)
    assert outcome(ending(run, [STARTED, CALLED, answered])).kind == "paused"


def test_a_run_that_failed_leads_with_the_reason_the_line_and_its_stage(run: RecordedRun) -> None:
    head = tree(page_of(ending(run, STOPPED))).all("header")[0]
    assert head.all("h1")[0].text == "Stopped in “open”."
    assert reasons(head) == ["The program called the operator: “THE GASKET LIES OFF ITS PLACE”."]
    assert head.all("h2")[0].text == "Line 4, 0:02.0 into the run, 0 of 3 stages done"
    (lit,) = (node for node in head.all("li") if node.attributes.get("class") == "on")
    assert (lit.text.strip(), lit.attributes["value"]) == ("CLOSE .1", "4")


def test_the_last_guarded_motions_of_a_run_that_failed_are_unfolded(run: RecordedRun) -> None:
    folds = tree(page_of(ending(run, STOPPED))).one("felt").all("details")
    assert ["open" in fold.attributes for fold in folds] == [*[False] * (len(folds) - 1), True]


@pytest.mark.parametrize(
    ("call", "reason"),
    [
        ({"error": 6}, "Error 6: the search has tried all its places."),
        (
            {"cause": NothingBetween(gap=0.0254)},
            "At most one finger touches; the gap is 1.00 in.",
        ),
        ({}, "The program called the operator."),
    ],
)
def test_a_call_without_a_message_is_told_by_its_error_or_its_cause(
    run: RecordedRun, call: dict[str, Any], reason: str
) -> None:
    called = happened.OperatorCalled(time=2.0, message="", **call)
    head = tree(page_of(ending(run, [STARTED, called]))).all("header")[0]
    assert reasons(head) == [reason]


def test_work_that_is_not_right_leads_with_what_is_wrong(run: RecordedRun) -> None:
    came = result(completed=True, assembled=False, checks={"gap": WRONG})
    head = tree(page_of(ending(run, DONE, came))).all("header")[0]
    assert head.all("h1")[0].text == "The program reported success, but the pump is not right."
    assert reasons(head) == ["Gap under a head: 5 mm; allowed: at most 0.2 mm."]


def test_the_panic_button_is_told_where_it_was_hit(run: RecordedRun) -> None:
    head = tree(page_of(ending(run, [STARTED, happened.PanicStopped(time=2.0)]))).all("header")[0]
    assert head.all("h1")[0].text == "The panic button stopped the run in “open”."
    assert reasons(head)[0].startswith("The user stopped the run.")


def test_figures_of_which_there_are_none_are_not_told(run: RecordedRun) -> None:
    (figures,) = tree(page_of(run)).all("header")[0].all("dl")
    assert "0" not in [figure.text for figure in figures.all("dd")]
    assert tree(page_of(ending(run, DONE))).all("header")[0].all("dl") == []
