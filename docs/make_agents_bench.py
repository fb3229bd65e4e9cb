"""Write the tables of docs/agents_bench.md: the tasks and, with FILE, how their own solutions were judged.

python docs/make_agents_bench.py [FILE]

FILE is the output of `handeye bench agents --check --json` for all tasks.
"""

import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import msgspec

ROOT: Final = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

from handeye.agents.bench_check import TaskCheck  # noqa: E402
from handeye.agents.bench_task import BenchTask, bench_tasks  # noqa: E402

PAGE: Final = ROOT / "docs" / "agents_bench.md"
LANGUAGES: Final = {"al": "AL", "trig": "TRIG", "ml": "ML", "mal": "MAL"}


def ordered() -> list[BenchTask]:
    """Return all tasks, in the order of their languages, and by name."""
    known = [*LANGUAGES]
    return sorted(bench_tasks().values(), key=lambda task: (known.index(task.file.language), task.name))


def tasks() -> str:
    """Return the table of the tasks."""
    found = ordered()
    lines = ["| task | language | tier | what to do |", "|---|---|---|---|"]
    lines += [
        f"| `{each.name}` | {LANGUAGES[each.file.language]} | {each.file.tier} | {each.file.about} |"
        for each in found
    ]
    count = Counter(each.file.language for each in found)
    told = ", ".join(f"{count[ending]} in {name}" for ending, name in LANGUAGES.items())
    return "\n".join([f"{len(found)} tasks: {told}.", "", *lines, ""])


def measured(checks: Sequence[TaskCheck]) -> str:
    """Return the table of the verdicts on the own solutions of those tasks that were checked."""
    by_name = {each.task: each for each in checks}
    lines = [
        "| task | worlds | reference: accepted | trivial: accepted | trivial: silent | trivial: score |",
        "|---|---|---|---|---|---|",
    ]
    for task in ordered():
        if (each := by_name.get(task.name)) is None:
            continue
        score = f"{each.trivial_score:.2f}".replace("0.00", "0").replace("-0.", "-.").removeprefix("0")
        cells = each.worlds, each.reference_accepted, each.trivial_accepted, each.trivial_silent, score or "0"
        lines.append(f"| `{task.name}` | {' | '.join(map(str, cells))} |")
    return "\n".join([*lines, ""])


def between(page: str, name: str, text: str) -> str:
    """Return a page with another text between the marks called `name`."""
    begin, end = f"<!-- Below: {name} -->\n", f"<!-- Above: {name} -->\n"
    before, _, rest = page.partition(begin)
    return before + begin + text + end + rest.partition(end)[2]


if __name__ == "__main__":
    text = between(PAGE.read_text(encoding="utf-8"), "tasks", tasks())
    if sys.argv[1:]:
        found = msgspec.json.decode(Path(sys.argv[1]).read_bytes(), type=list[TaskCheck])
        text = between(text, "measured", measured(found))
    PAGE.write_text(text, encoding="utf-8")
