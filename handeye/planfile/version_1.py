"""Plans of version 1: stops with a field for each kind of guard, steps that did not say where they stand."""

import re
from collections.abc import Iterator
from typing import Any, Final

Data = dict[str, Any]

SAME_ARM: Final = {"6863f8cd01ff": "40fac2bbfe2d"}
"""Digests of an arm's figures as they were taken in version 1, and of the same figures as they are taken since."""
_LABELS: Final = re.compile(r"\s*((?:[A-Za-z_]\w*\s*:\s*)+)", re.ASCII)
_WORD: Final = re.compile(r"\s*(\w*)", re.ASCII)
_NO_STEP: Final = frozenset(
    {"", "STOP", "FORCE", "FREE", "SPIN", "VIA", "TOUCH", "TORQUE", "TRANS", "VECT", "STAGE"}
)
"""Words of lines that a label goes on from, to the step below."""


def to_version_2(plan: Data) -> Data:
    """The plan in version 2.

    What its text does not tell plainly stays unsaid: modifiers, and labels of calls of a macro.
    """
    plan["arm_digest"] = SAME_ARM.get(plan["arm_digest"], plan["arm_digest"])
    program = plan["program"]
    texts = {"": program["source"], **program.get("required", {})}
    places: dict[tuple[str, int], list[Data]] = {}
    for step in program["steps"]:
        places.setdefault((step.get("file", ""), step["line"]), []).append(step)
        _convert(step["operation"])
        _locate(step, texts)
    for file, text in texts.items():
        for line, macro, labels in _lines(text, {line for key, line in places if key == file}):
            for step in places.get((file, line), ()):
                step |= ({"macro": macro} if macro else {}) | ({"labels": labels} if labels else {})
    return plan


def _convert(operation: Data) -> None:
    if operation["op"] == "search":
        operation.setdefault("limit", 49)
    stop = operation.pop("stop", None)
    if stop is not None:
        operation["guards"] = _guards(stop)


def _guards(stop: Data) -> list[Data]:
    """The guards of a stop: exactly one, but that a moment could stand beside a force."""
    fields = {
        "force": "force",
        "against": "force",
        "moment": "moment",
        "torque": "torque",
        "touch": "fingers",
    }
    met = {kind: stop[kind] for kind in fields if stop.get(kind) is not None}
    if len(met) != 1 and met.keys() not in ({"force", "moment"}, {"against", "moment"}):
        raise ValueError("a stop has one condition")
    return [{"guard": kind, fields[kind]: value} for kind, value in met.items()]


def _locate(step: Data, texts: dict[str, str]) -> None:
    """Find the statement of a step on its line."""
    line = dict(enumerate(texts[step.get("file", "")].split("\n"), 1)).get(step["line"], "")
    column = line.find(step["text"])
    if column >= 0:
        step["span"] = [column, column + len(step["text"])]


def _lines(text: str, steps: set[int]) -> Iterator[tuple[int, str, list[str]]]:
    """The lines of steps, with the macro they stand in and the labels on them or above them."""
    macro, labels = "", list[str]()
    for number, line in enumerate(text.split("\n"), 1):
        if not line.strip():
            macro, labels = ("", []) if macro else (macro, labels)
            continue
        found = _LABELS.match(line)
        labels += [] if found is None else [label.strip() for label in found[1].split(":")[:-1]]
        rest = line[0 if found is None else found.end() :]
        if number in steps:
            yield number, macro, labels
            labels = []
        elif match := re.match(r"\s*DEFINE\s+(\w+)", rest, re.ASCII | re.IGNORECASE):
            macro = match[1].upper()
        elif _word(rest) not in _NO_STEP:
            labels = []


def _word(text: str) -> str:
    found = _WORD.match(text)
    return "" if found is None else found[1].upper()
