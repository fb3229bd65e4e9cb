"""Write the table of docs/figures.md on trials of the pump from the files in docs/trials/, and make these files.

python docs/make_trials.py                       # the table
python docs/make_trials.py NAME COMMIT DIR       # the file of the batch in DIR, and the table

DIR is the output folder of `handeye trials assembly --out DIR`. Of an interrupted batch, the trials before the first
trial without a result count. A file has a line for each trial. Above them are the command, the commit, digests of code
and plan, the worlds, the versions, and (since it is recorded) the renderer of the pictures. The table adds up batches
of one plan, one kind of worlds, one renderer and the same code, which includes the scenes. Batches of the newest
program that was counted come first, in a table of their own; change `NEWEST` with it.
"""

import csv
import io
import shlex
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Final

ROOT: Final = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

from handeye.core.files import Kind, write_over  # noqa: E402
from handeye.report.facts.again import sense_words, world_words  # noqa: E402
from handeye.trials.comparing import PairedTrial, beside  # noqa: E402
from handeye.trials.figures import rate  # noqa: E402
from handeye.trials.folder import Head, read_batch  # noqa: E402
from handeye.trials.plans.row import OUTCOMES, Row  # noqa: E402
from handeye.trials.plans.trial import SIMULATED_LIMIT_S  # noqa: E402
from handeye.trials.sweep import FAILED  # noqa: E402

PAGE: Final = ROOT / "docs" / "figures.md"
FOLDER: Final = ROOT / "docs" / "trials"
BEGIN, END = "<!-- Below: docs/make_trials.py -->\n", "<!-- Above: docs/make_trials.py -->\n"
COLUMNS: Final = ("seed", "verdict", "stage", "cause", "arm_s", "cpu_s", "events")
PROGRAM: Final = "water_pump"
"""The program whose plan `handeye trials assembly` runs if no plan is given."""
NEWEST: Final = ("65c5f280", "64baaebf")
"""The commits of the newest program that was counted, and of the same program before its last correction."""
NEWEST_TITLE: Final = "### The newest program counted\n"
EARLIER_TITLE: Final = "### Earlier programs\n"
PAIRED: Final = """\
In the next table, each batch of the first column was run without a sense or with another program. The
second column names the batch of the full program in the same worlds:

| batch | compared to | assembled | there | only here | only there | p | noticed | silent | unfinished | arm | p |
|---|---|---|---|---|---|---|---|---|---|---|---|"""
FAILURES: Final = """\
The last table lists the trials that did not assemble the pump. *Message* is what the run reported as it stopped:

| batch | stage | ended | message | worlds | seeds |
|---|---|---|---|---|---|"""
FACTS: Final = ("command", "commit", "code", "plan", "worlds", "versions", "renderer")
"""What stands above the trials of a batch."""
FIGURES: Final = Kind("page of figures", b"# Success rates", ending=".md")
TRIALS: Final = Kind("file of trials", b"# command: ", ending=".csv")


BatchKind = tuple[str, str, str, str]  # plan, worlds, code and renderer


@dataclass(frozen=True, slots=True)
class Batch:
    """A batch, as its file describes it."""

    name: str
    facts: Mapping[str, str]
    trials: Sequence[Mapping[str, str]]

    @property
    def kind(self) -> BatchKind:
        """Plan, worlds, code and renderer; the table adds up batches of one kind."""
        return self.facts["plan"], self.facts["worlds"], self.facts["code"], self.facts.get("renderer", "")

    @property
    def level(self) -> str:
        return self.facts["worlds"].partition(" ")[0]

    @property
    def whole(self) -> bool:
        """Whether the batch runs the task's own program, with all its senses, in unchanged worlds of a level."""
        return self.facts["worlds"] == self.level and "--plan" not in self.facts["command"]

    @property
    def outcomes(self) -> Mapping[tuple[str, int, int], PairedTrial]:
        return {("", int(trial["seed"]), 0): _outcome(trial) for trial in self.trials}


def _outcome(trial: Mapping[str, str]) -> PairedTrial:
    verdict = trial["verdict"]
    arm = {"arm": float(trial["arm_s"])} if trial["arm_s"] else {}
    return PairedTrial(OUTCOMES.get(verdict, "wrong"), verdict == FAILED, arm)


# -- files -----------------------------------------------------------------------------------------------


def file_of(head: Head, rows: Sequence[Row], commit: str) -> bytes:
    """A batch as a file."""
    if head.kind != "assembly":
        raise SystemExit(f"these are no trials of assembling, but of this: {head.kind}")
    facts = (
        _command(head, len(rows)), commit, head.code, head.plan, worlds(head), _versions(head.versions),
        renderers(rows) or head.camera,
    )  # fmt: skip
    out = io.StringIO()
    for name, value in zip(FACTS, facts, strict=True):
        out.write(f"# {name}: {value}\n")
    table = csv.writer(out, lineterminator="\n")
    table.writerow(COLUMNS)
    table.writerows(map(_values, rows))
    return out.getvalue().encode()


def worlds(head: Head) -> str:
    """The level of a batch's worlds and all its other options; the table adds up batches for which these are equal."""
    return shlex.join([head.world.level, *_options(head)])


def renderers(rows: Sequence[Row]) -> str:
    """The renderers of the pictures of a batch, as its trials record them: `OpenGL (EGL)`."""
    return ", ".join(sorted({row.result.camera.renderer for row in rows if row.result is not None}))


def _options(head: Head) -> list[str]:
    """Words of the command that runs a batch, except seed, level and number."""
    _, _, *words = world_words(head.world, PROGRAM)
    words = words if head.world.level == "nominal" else words[2:]
    words += sense_words(head.without)
    words += [] if head.on_stop == "abort" else ["--on-stop", head.on_stop]
    limit = head.simulated_limit_s
    return words + ([] if limit in (None, SIMULATED_LIMIT_S) else ["--simulated-limit", f"{limit:g}"])


def _command(head: Head, n: int) -> str:
    """The command that runs a batch; if its plan is not the task's own, `handeye plan` makes it first."""
    level = [] if head.world.level == "nominal" else ["--level", head.world.level]
    plan = [] if head.program == PROGRAM else ["--plan", f"{head.program}.plan.json"]
    seeds = (
        ["--seeds", ",".join(map(str, head.seeds[:n]))]
        if head.seeds
        else ["--n", str(n), "--seed", str(head.world.seed)]
    )
    words = [*seeds, *level, *_options(head), "--camera", head.camera, *plan]
    return shlex.join(["handeye", "trials", "assembly", *words])


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
    above = [line for line in lines if line.startswith("# ")]
    facts = dict(line.removeprefix("# ").split(": ", 1) for line in above)
    return Batch(file.stem, facts, tuple(csv.DictReader(lines[len(above) :])))


# -- the table -------------------------------------------------------------------------------------------


def table(batches: Sequence[Batch]) -> str:
    """Batches of the newest program and of earlier ones, pairs of batches world by world, and the failures."""
    newest = [batch for batch in batches if batch.facts["commit"] in NEWEST]
    earlier = [batch for batch in batches if batch.facts["commit"] not in NEWEST]
    rows = (*_rows(NEWEST_TITLE, newest), *_rows(EARLIER_TITLE, earlier))
    return "\n".join((*rows, *_pairs(batches), *_failures(batches)))


def _rows(title: str, batches: Sequence[Batch]) -> Iterator[str]:
    """Batches one by one, and batches of one kind together, under a title."""
    if not batches:
        return
    kinds = dict.fromkeys(batch.kind for batch in batches)
    yield title
    lines = [
        "| worlds | plan | command | commit | assembled | silent | Wilson 95 % | at least | arm, s | CPU h |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for kind in kinds:
        mine = [batch for batch in batches if batch.kind == kind]
        lines += [_row(batch.trials, kind, _linked(batch), batch.facts["commit"]) for batch in mine]
        if len(mine) > 1:
            lines.append(_row([trial for batch in mine for trial in batch.trials], kind, "together", ""))
    yield "\n".join(lines) + "\n"


def _linked(batch: Batch) -> str:
    """The command of a batch; if it lists many seeds, the first with a link to the file that has all."""
    command = batch.facts["command"]
    head, word, seeds = command.partition("--seeds ")
    listed, rest = seeds.partition(" ")[::2]
    if listed.count(",") < 20:
        return f"`{command}`"
    return f"`{head}{word}{listed.partition(',')[0]},...{' ' * bool(rest)}{rest}` ([seeds](trials/{batch.name}.csv))"


def _row(trials: Sequence[Mapping[str, str]], kind: BatchKind, command: str, commit: str) -> str:
    verdicts = Counter(trial["verdict"] for trial in trials)
    sure = rate(verdicts["assembled"], len(trials))
    if sure.wilson95 is None or sure.p_s is None:
        raise SystemExit(f"no trials: {command}")
    low, high = sure.wilson95
    arm = sorted(float(trial["arm_s"]) for trial in trials if trial["verdict"] == "assembled")
    times = f"{arm[0]:.0f} to {arm[-1]:.0f}, median {median(arm):.0f}" if arm else ""
    hours = sum(float(trial["cpu_s"]) for trial in trials) / 3600
    plan, worlds, *_ = kind
    return (
        f"| {worlds} | `{plan[:8]}` | {command} | {commit} | {sure.successes} of {sure.trials} | {verdicts['silent']} "
        f"| {low:.1%} to {high:.1%} | {sure.p_s:.1%} | {times} | {hours:.1f} |"
    )


def _pairs(batches: Sequence[Batch]) -> Iterator[str]:
    """Each batch next to a batch of the task's program with all its senses, of the same code and level."""
    lines = [
        _pair(first, other) for first in batches if first.whole for other in batches if _alike(first, other)
    ]
    if lines:
        yield PAIRED
        yield from lines
        yield ""


def _alike(first: Batch, other: Batch) -> bool:
    same = other.facts["code"] == first.facts["code"] and other.level == first.level
    return same and not other.whole and not first.outcomes.keys().isdisjoint(other.outcomes)


def _pair(first: Batch, other: Batch) -> str:
    found = beside(other.name, first.outcomes, other.outcomes)
    counts = (
        *(f"{found.right} of {found.pairs}", found.first_right, found.only_this, found.only_first),
        *(f"{found.p:.2g}", found.noticed, found.silent, found.failed),
    )
    times = ("", "")
    if "arm" in found.measures:
        longer = found.measures["arm"]
        times = (f"{longer.more:+.1f} s in {longer.pairs}", f"{longer.p:.2g}")
    return f"| {' | '.join(map(str, (other.name, first.name, *counts, *times)))} |"


def _failures(batches: Sequence[Batch]) -> Iterator[str]:
    """A table of the failures, batch by batch and stage by stage."""
    lines = [line for batch in batches for line in _failed(batch)]
    if lines:
        yield FAILURES
        yield from lines
        yield ""


def _failed(batch: Batch) -> Iterator[str]:
    """Rows of the failures of a batch."""
    failed = [trial for trial in batch.trials if trial["verdict"] != "assembled"]
    for (stage, verdict, cause), count in Counter(map(_why, failed)).most_common():
        seeds = [trial["seed"] for trial in failed if _why(trial) == (stage, verdict, cause)]
        more = "" if count <= 3 else ", ..."
        yield f"| {batch.name} | {stage} | {verdict} | `{cause}` | {count} | {', '.join(seeds[:3])}{more} |"


def _why(trial: Mapping[str, str]) -> tuple[str, str, str]:
    """Where, how and why a trial failed."""
    return trial["stage"], trial["verdict"], trial["cause"]


def page(text: str, made: str) -> str:
    """The whole page with this table."""
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        raise SystemExit(f"{PAGE} has no place for the table")
    above, _, rest = text.partition(BEGIN)
    return above + BEGIN + "\n" + made + "\n" + END + rest.partition(END)[2]


def main(words: Sequence[str]) -> None:
    """Make a file, if the command asks for one, and the table."""
    if len(words) not in (0, 3):
        raise SystemExit(__doc__)
    if words:
        name, commit, folder = words
        head, found = read_batch(Path(folder))
        rows = [row for number, row in enumerate(found) if row.trial == number]
        write_over(FOLDER / f"{name}.csv", file_of(head, rows, commit), TRIALS)
    batches = [read(file) for file in sorted(FOLDER.glob("*.csv"))]
    write_over(PAGE, page(PAGE.read_text(encoding="utf-8"), table(batches)).encode(), FIGURES)


if __name__ == "__main__":
    main(sys.argv[1:])
