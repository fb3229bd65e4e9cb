"""Writes the feedback on a solution of the agents' bench, for its entrant."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Final, Literal

from handeye.agents.judging import Verdict

Feedback = Literal["verdict", "errors", "trace"]
FEEDBACK: Final = "feedback.md"  # file that the entrant finds after its first round


def feedback(found: Sequence[Verdict], kind: Feedback) -> str:
    """Write the feedback on a solution. Feedback of the kind `verdict` gives only the verdicts. The other kinds add
    the errors and the referee's measurements. The kind `trace` also adds what the last steps did.
    """
    lines = ["# Your solution in the public worlds", ""]
    for each in found:
        lines.append(f"- seed {each.seed}: {each.outcome if kind == 'verdict' else each.told}")
        if kind != "verdict":
            lines += [f"  - {measured}" for measured in each.measured]
    if kind == "trace":
        lines += _traces(found)
    return "\n".join(lines) + "\n"


def _traces(found: Sequence[Verdict]) -> Iterator[str]:
    """Yield a section with the last steps of each world in which the solution was not accepted. If the program made no
    step in several worlds, for the same reason, these worlds share a section.
    """
    wrong = (each for each in found if each.outcome != "accepted" and each.listed)
    for (_, why), worlds in groupby(wrong, lambda each: (each.seed if each.steps else None, each.message)):
        group = list(worlds)
        if group[0].steps:
            yield from ("", f"## Seed {group[0].seed}: the last steps", "", "```", *group[0].steps, "```")
        else:
            seeds = ", ".join(str(each.seed) for each in group)
            yield from ("", f"## No steps (seed {seeds})", "", f"The program did not make a step: {why}")
