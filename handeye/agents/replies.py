"""The reply of a tool: a text to read, and the same content as data."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import msgspec
from msgspec import UNSET

from handeye.agents.judging import outcome_of
from handeye.api.diagnostic import Diagnostic
from handeye.api.plans import Plan
from handeye.api.run import Run
from handeye.api.state import Answer
from handeye.core.plain_text import counted
from handeye.debugger.formatting import as_json, as_text
from handeye.results.result import Result
from handeye.results.world_page import QuantityReport, how

MOST_STEPS: Final = 40  # executed steps that a reply lists
_ANSWERS: Final = "; `run` continues this run if you give an `answer`: retry, proceed or skip"
_SETTING: Final = ("timing", "versions", "camera", "world")  # of a result, which tell an agent nothing


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """What a tool answers."""

    text: str
    data: dict[str, Any] | None = None
    png: bytes | None = None  # a picture
    failed: bool = False  # the call could not be executed; the text says why


def on_script(name: str, found: Iterable[Diagnostic]) -> Reply:
    """Reply with the diagnostics of a script."""
    diagnostics = tuple(found)
    errors = sum(each.severity == "error" for each in diagnostics)
    text = "\n\n".join(
        [*map(str, diagnostics), f"{name}: {counted(errors, 'error') if errors else 'no errors'}"]
    )
    listed = [msgspec.to_builtins(each) for each in diagnostics]
    for each in listed:
        del each["shown"]
    return Reply(text=text, data={"ok": not errors, "diagnostics": listed})


def on_plan(plan: Plan, stage: int | None) -> Reply:
    """Reply with the stages of a plan, or with the steps of one stage."""
    stages = [
        {
            "number": each.number,
            "name": each.name,
            "steps": len(each.steps),
            "seconds": round(each.seconds, 2),
        }
        for each in plan.stages
    ]
    data: dict[str, Any] = {
        "name": plan.name,
        "task": plan.record.task,
        "stages": stages,
        "seconds": plan.seconds,
    }
    lines = [f"{plan.name}, task {plan.record.task}: {plan.seconds:.1f} s of planned motion"]
    lines += ["{number:3}  {name}: {steps} steps, {seconds} s".format(**each) for each in stages]
    if stage is not None:
        steps = plan.stages[stage - 1].steps
        data["steps"] = [
            {"step": s.step, "line": s.line, "text": s.text, "seconds": s.seconds} for s in steps
        ]
        lines += ["", *(f"{s.step:4}  line {s.line}: {s.text}" for s in steps)]
    data["warnings"] = [each.message for each in plan.diagnostics]
    return Reply(text="\n".join([*lines, *map(str, plan.diagnostics)]), data=data)


def on_world(task: str, quantities: Sequence[QuantityReport]) -> Reply:
    """Reply with the distribution of each quantity over the worlds. The reply does not give the value of a quantity in
    any single world.
    """
    rows = [
        {
            "name": each.name,
            "unit": each.unit,
            "nominal": each.nominal,
            "distribution": each.distribution,
            "spread": each.spread,
            "source": each.source,
        }
        for each in quantities
    ]
    text = "\n".join(f"{each.name}: {how(each)}. {each.source}" for each in quantities)
    return Reply(text=text or "no quantity has such a name", data={"task": task, "quantities": rows})


def on_run(name: str, run: Run, answer: Answer) -> Reply:
    """Reply with the present place of a run, and with the steps that the call has executed."""
    state = run.state
    data: dict[str, Any] = msgspec.json.decode(as_json(answer))
    for key in ("events", "command", "source", "error", "said", "pause"):
        data.pop(key, None)
    why = state.why + (_ANSWERS if run.ended and not run.completed else "")
    data |= {"run": name, "why": why, "ended": run.ended, "did": data["did"][-MOST_STEPS:]}
    shown = as_text(msgspec.structs.replace(answer, said=UNSET), MOST_STEPS)
    return Reply(text=f"run {name}\n{shown}\n{why}", data=data)


OUTCOMES: Final = {
    "accepted": "the program reported success, and the referee accepts the work",
    "silent": "the program reported success, but the referee rejects the work: a silent failure",
    "stopped": "the program stopped and called the operator",
}


def on_result(name: str, result: Result) -> Reply:
    """Reply with the verdict on a run that has ended."""
    word = outcome_of(result)
    findings = [check.told for check in result.checks]
    lines = [f"run {name}: {word}; {OUTCOMES[word]}"]
    lines += [result.message] if result.message else []
    lines += [f"{'ok      ' if check.ok else 'rejected'}  {check.told}" for check in result.checks]
    data = msgspec.to_builtins(result)
    for key in _SETTING:
        data.pop(key, None)
    seconds = result.timing.working_s
    data |= {"run": name, "outcome": word, "seconds": seconds, "findings": findings}
    return Reply(text="\n".join([*lines, f"{seconds:.1f} s simulated"]), data=data)
