"""Writes the table of docs/figures.md on trials of the pump from the files in docs/trials/, and makes such files.

python docs/make_trials.py                                  # the table anew
python docs/make_trials.py NAME COMMIT DIR                  # the file of the batch in DIR, and the table anew

DIR is what `handeye trials assembly --out DIR` has left; of a batch that was broken off, the trials before the first
that is missing. A file has a line a trial, and above them the command, the
commit, the versions, and the digest of the plan that was carried out. Batches of one plan and one kind of worlds are
added up: other commits of handeye may lie between them, if the same seed gives the same events.
"""

import csv
import io
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Final

ROOT: Final = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

from handeye.files import Kind, write_over  # noqa: E402
from handeye.trials.batch.folder import Head, read_batch  # noqa: E402
from handeye.trials.batch.rates import rate  # noqa: E402
from handeye.trials.batch.row import Row  # noqa: E402

PAGE: Final = ROOT / "docs" / "figures.md"
FOLDER: Final = ROOT / "docs" / "trials"
BEGIN, END = "<!-- Below: docs/make_trials.py -->\n", "<!-- Above: docs/make_trials.py -->\n"
COLUMNS: Final = ("seed", "verdict", "stage", "cause", "arm_s", "cpu_s", "events")
FACTS: Final = ("command", "commit", "plan", "worlds", "versions")
"""What stands above the trials of a batch."""
TRIALS: Final = Kind("file of trials", b"# command: ", ending=".csv")


@dataclass(frozen=True, slots=True)
class Batch:
    """A batch as its file has it."""

    name: str
    facts: Mapping[str, str]
    trials: Sequence[Mapping[str, str]]

    @property
    def kind(self) -> tuple[str, str]:
        """Batches of one kind are added up."""
        return self.facts["plan"], self.facts["worlds"]


# -- files -----------------------------------------------------------------------------------------------


def file_of(head: Head, rows: Sequence[Row], commit: str) -> bytes:
    """A batch as a file."""
    facts = (_command(head, len(rows)), commit, head.plan, worlds(head), _versions(head.versions))
    out = io.StringIO()
    for name, value in zip(FACTS, facts, strict=True):
        out.write(f"# {name}: {value}\n")
    table = csv.writer(out, lineterminator="\n")
    table.writerow(COLUMNS)
    table.writerows(map(_values, rows))
    return out.getvalue().encode()


def worlds(head: Head) -> str:
    """What the worlds of a batch have in common, and what the program does without."""
    changed = head.world.overrides
    parts = [head.world.level, *(f"--without {name}" for name in (*changed.without, *head.without))]
    parts += [] if head.on_stop == "abort" else [f"--on-stop {head.on_stop}"]
    parts += [f"--set {name}={value}" for name, value in changed.set.items()]
    return " ".join((*parts, *(f"--fault {fault.name}" for fault in head.world.faults)))


def _command(head: Head, n: int) -> str:
    level, *others = worlds(head).split(" ")
    chosen = [] if level == "nominal" else ["--level", level]
    chosen += [] if head.camera == "auto" else ["--camera", head.camera]
    return " ".join(("handeye trials assembly", f"--n {n}", f"--seed {head.world.seed}", *chosen, *others))


def _versions(versions: Mapping[str, str]) -> str:
    return ", ".join(f"{name} {version}" for name, version in versions.items())


def _values(row: Row) -> tuple[object, ...]:
    failed = row.verdict != "assembled"
    arm_s = "" if row.result is None else row.result.timing.manipulation_s
    why = (row.stage, row.cause) if failed else ("", "")
    return (row.seed, row.verdict, *why, arm_s, row.cpu_s, row.events)


def read(file: Path) -> Batch:
    """A batch from its file."""
    lines = file.read_text(encoding="utf-8").splitlines()
    facts = dict(line.removeprefix("# ").split(": ", 1) for line in lines[: len(FACTS)])
    return Batch(file.stem, facts, tuple(csv.DictReader(lines[len(FACTS) :])))


# -- the table -------------------------------------------------------------------------------------------


def table(batches: Sequence[Batch]) -> str:
    """Batches one by one, those of one kind together, and what failed."""
    kinds = dict.fromkeys(batch.kind for batch in batches)
    return "\n".join((_rows(batches, kinds), *_failures(batches)))


def _rows(batches: Sequence[Batch], kinds: Mapping[tuple[str, str], None]) -> str:
    lines = [
        "| worlds | plan | command | commit | assembled | silent | Wilson 95 % | at least | arm, s | CPU h |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for kind in kinds:
        mine = [batch for batch in batches if batch.kind == kind]
        lines += [
            _row(batch.trials, kind, f"`{batch.facts['command']}`", batch.facts["commit"]) for batch in mine
        ]
        if len(mine) > 1:
            lines.append(_row([trial for batch in mine for trial in batch.trials], kind, "together", ""))
    return "\n".join(lines) + "\n"


def _row(trials: Sequence[Mapping[str, str]], kind: tuple[str, str], command: str, commit: str) -> str:
    verdicts = Counter(trial["verdict"] for trial in trials)
    sure = rate(verdicts["assembled"], len(trials))
    if sure.wilson95 is None or sure.p_s is None:
        raise SystemExit(f"no trials: {command}")
    low, high = sure.wilson95
    arm = sorted(float(trial["arm_s"]) for trial in trials if trial["verdict"] == "assembled")
    times = f"{arm[0]:.0f} to {arm[-1]:.0f}, median {median(arm):.0f}" if arm else ""
    hours = sum(float(trial["cpu_s"]) for trial in trials) / 3600
    plan, worlds = kind
    return (
        f"| {worlds} | `{plan[:8]}` | {command} | {commit} | {sure.successes} of {sure.trials} | {verdicts['silent']} "
        f"| {low:.1%} to {high:.1%} | {sure.p_s:.1%} | {times} | {hours:.1f} |"
    )


def _failures(batches: Sequence[Batch]) -> Iterator[str]:
    """What failed, stage by stage."""
    for batch in batches:
        failed = [trial for trial in batch.trials if trial["verdict"] != "assembled"]
        if not failed:
            continue
        yield f"Not assembled of `{batch.facts['command']}`:\n"
        causes = Counter((trial["stage"], trial["verdict"], trial["cause"]) for trial in failed)
        for (stage, verdict, cause), count in causes.most_common():
            seeds = [trial["seed"] for trial in failed if (trial["stage"], trial["cause"]) == (stage, cause)]
            more = "" if count <= 3 else ", ..."
            yield f"- {stage}: {verdict}, {cause} ({count}: {', '.join(seeds[:3])}{more})"
        yield ""


def page(text: str, made: str) -> str:
    """The whole page with this table."""
    above, _, rest = text.partition(BEGIN)
    return above + BEGIN + "\n" + made + "\n" + END + rest.partition(END)[2]


def main(words: Sequence[str]) -> None:
    """Make a file, if one is asked for, and the table."""
    if words:
        name, commit, folder = words
        head, found = read_batch(Path(folder))
        rows = [row for number, row in enumerate(found) if row.trial == number]
        write_over(FOLDER / f"{name}.csv", file_of(head, rows, commit), TRIALS)
    batches = [read(file) for file in sorted(FOLDER.glob("*.csv"))]
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8"), table(batches)), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
