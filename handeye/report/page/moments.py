"""Prepares data for the page's script: steps, stages and captions with their times."""

from collections.abc import Sequence
from typing import Any

import msgspec

from handeye.core.markup import Markup, element
from handeye.core.plain_text import printable
from handeye.program.events import StepStarted
from handeye.report.facts.outcome import Outcome
from handeye.report.facts.told import CaptionedEvent
from handeye.report.page.source import line_id
from handeye.report.recorded import RecordedRun
from handeye.trace.sentences import measures_of, sentence


def moments(run: RecordedRun, outcome: Outcome, told: Sequence[CaptionedEvent]) -> Markup:
    """Return the steps, stages and captions of a run, with their times, as an invisible HTML element."""
    files = ("", *run.program.required)
    steps = [event for event in run.trace.events if isinstance(event, StepStarted)]
    measures = measures_of(run.trace.head.task)
    data = {
        "begin": run.begins,
        "end": run.ends,
        "view": {"right": "room", "ended": "room", "wrong": "pump"}.get(outcome.kind, "hand"),
        "show": run.begins if outcome.good else outcome.time,
        "steps": [[step.time, line_id(step.line, step.file, files)] for step in steps],
        "stages": [[each.begin, each.end, printable(each.name)] for each in run.trace.stages],
        "told": [[each.time, printable(sentence(each.event, measures))] for each in told],
    }
    return element("script", json_markup(data), id="moments", type="application/json")


def json_markup(data: Any) -> Markup:
    """Encode data as JSON for an HTML element. No text in the data can end this element."""
    return Markup(msgspec.json.encode(data).decode().replace("<", "\\u003c"))
