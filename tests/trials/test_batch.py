"""A batch keeps each trial as it ends, goes on where it was broken off, and counts what it has."""

import json
import resource
import signal
import time
from collections.abc import Callable, Generator, Sequence
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from conftest import Command
from results import result
from short_runs import FEEL, plan_of

from handeye.core.errors import SEARCH_EXHAUSTED, InvalidInput
from handeye.core.resources import plans
from handeye.core.variation import WorldSpec
from handeye.planfile.store import read_plan, write_plan
from handeye.program.events import AnyEvent, ErrorRaised, SearchAdvanced, StepStarted
from handeye.program.taught import load_taught
from handeye.results.result import Check
from handeye.tasks import task
from handeye.trace.tables import check_tables, csv_bytes, write_tables
from handeye.trials.comparing import paired
from handeye.trials.figures import Figures, mcnemar, rate
from handeye.trials.figures import figures as figures_of
from handeye.trials.folder import BatchFolder, Head, read_batch
from handeye.trials.page import sweep_page
from handeye.trials.plans.distributions import margins
from handeye.trials.plans.row import Contact, Row, SearchEnd, contacts, searches
from handeye.trials.plans.trial import ASSEMBLY, DISMANTLING, Trial, Watch, answered
from handeye.trials.sweep import Case, Engine, GuardedWork, cases, processes, rows_of
from handeye.trials.sweep import carry_out as carry_out_sweep
from handeye.trials.tables import tables as tables_of
from handeye.trials.workers import Answer

WORLD = WorldSpec(seed=5)
TRIAL = Trial(plan=plan_of(FEEL), world=WORLD, camera="ray")
RIGHT = result(completed=True, assembled=True)
FAR = Check(
    ok=False, subject="pin", value=4, relation="at most", limit=3, unit="mm", sentence="pin (at most 3 mm)"
)
WRONG = result(completed=True, assembled=False, checks={"pins": FAR})
STOPPED = result(completed=False, assembled=None, message="no gasket lies on the base")


def row(case: Case) -> Row:
    """What nobody has tried: trial 1 is stopped, trial 2 silently wrong."""
    (number,) = case.trials
    return Row(trial=number, seed=case.seed, result={1: STOPPED, 2: WRONG}.get(number, RIGHT))


class Canned:
    """Answers in reverse order, and breaks down after some answers."""

    def __init__(self, breaks_after: int = 99) -> None:
        self.breaks_after, self.tried = breaks_after, list[int]()

    def __call__(
        self, work: GuardedWork[Row], cases: Sequence[Case]
    ) -> Generator[Answer[Case, list[Row]], None, None]:
        for number, case in enumerate(reversed(cases)):
            if number == self.breaks_after:
                raise KeyboardInterrupt
            self.tried += case.trials
            yield Answer(item=case, value=[row(case)])


def carry_out(
    cases: Sequence[Case], engine: Engine, *, trial: Trial = TRIAL, folder: BatchFolder[Row] | None = None
) -> tuple[Row, ...]:
    return carry_out_sweep(ASSEMBLY, trial, cases, engine, folder=folder)


def figures(rows: Sequence[Row], command: Callable[[Row], str] = lambda _: "") -> Figures:
    return figures_of(ASSEMBLY, rows, command)


def opened(path: Path, trial: Trial = TRIAL) -> BatchFolder[Row]:
    return BatchFolder(path, ASSEMBLY, trial.head(ASSEMBLY), trial.plan)


def test_a_batch_goes_on_where_it_was_broken_off(tmp_path: Path) -> None:
    jobs, folder = cases(5, range(5)), opened(tmp_path)
    with pytest.raises(KeyboardInterrupt):
        carry_out(jobs, Canned(2), folder=folder)
    folder.close()
    with (tmp_path / "trials.jsonl").open("ab") as file:
        file.write(b'{"trial":2,"seed"')  # as where the parent was killed
    again = opened(tmp_path)
    engine = Canned()
    rows = carry_out(jobs, engine, folder=again)
    again.close()
    assert (sorted(again.rows), engine.tried) == ([("", k) for k in range(5)], [2, 1, 0])
    assert rows == carry_out(jobs, Canned()) == read_batch(tmp_path)[1]
    assert [each.seed for each in rows] == [5, 6, 7, 8, 9]


@pytest.mark.parametrize("ended", ["killed", "processor limit", "wall limit", "machine"])
def test_what_the_machine_broke_off_is_tried_again_when_the_batch_goes_on(tmp_path: Path, ended: str) -> None:
    folder = opened(tmp_path)
    folder.append(Row(trial=0, seed=5, ended=ended))  # type: ignore[arg-type]
    folder.append(Row(trial=1, seed=6, ended="raised", raised="ValueError: one that comes again"))
    folder.append(Row(trial=2, seed=7, ended="simulated limit"))
    folder.close()
    again, engine = opened(tmp_path), Canned()
    rows = carry_out(cases(5, range(3)), engine, folder=again)
    again.close()
    assert (engine.tried, [each.verdict for each in rows]) == ([0], ["assembled", "failed", "failed"])
    assert read_batch(tmp_path)[1] == rows
    opened(tmp_path).close()


@pytest.mark.parametrize(
    ("error", "ended"),
    [
        (MemoryError(), "machine"),
        (OSError(28, "No space left on device"), "machine"),
        (ValueError("no"), "raised"),
    ],
)
def test_an_exception_is_the_machine_s_or_the_program_s(error: Exception, ended: str) -> None:
    def work(_: Case) -> list[Row]:
        raise error

    (found,) = GuardedWork(work, Row)(Case(trials=(0,), seed=5))
    assert (found.ended, found.verdict) == (ended, "failed")


def test_a_paused_trial_is_not_over_its_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    watch = Watch(simulated_s=9.0, cpu_s=1.0)
    later = time.monotonic() + 1e6
    monkeypatch.setattr(time, "monotonic", lambda: later)
    assert not watch.over()
    spent = time.process_time() + 1.1
    monkeypatch.setattr(time, "process_time", lambda: spent)
    assert (watch.over(), watch.ended) == (True, "processor limit")


def test_a_batch_of_seeds_that_do_not_follow_each_other_goes_on_with_the_same_ones(tmp_path: Path) -> None:
    chosen = (20261126, 1795000000, 7, 2**53 - 1)
    trial = replace(TRIAL, world=WorldSpec(seed=chosen[0]))
    jobs = [Case(trials=(k,), seed=seed) for k, seed in enumerate(chosen)]

    def listed(seeds: tuple[int, ...]) -> BatchFolder[Row]:
        return BatchFolder(tmp_path, ASSEMBLY, trial.head(ASSEMBLY, seeds), trial.plan)

    folder = listed(chosen)
    with pytest.raises(KeyboardInterrupt):
        carry_out(jobs, Canned(2), folder=folder)
    folder.close()
    with pytest.raises(InvalidInput, match="differs in seeds; "):
        listed((*chosen[:3], 8))
    again, engine = listed(chosen), Canned()
    rows = carry_out(jobs, engine, folder=again)
    again.close()
    assert (engine.tried, [each.seed for each in rows]) == ([1, 0], [*chosen])
    assert read_batch(tmp_path)[1] == rows


def test_a_trial_of_a_seed_that_is_not_the_batch_s_is_refused(tmp_path: Path) -> None:
    folder = BatchFolder(tmp_path, ASSEMBLY, TRIAL.head(ASSEMBLY, (5, 9)), TRIAL.plan)
    folder.append(Row(trial=1, seed=6, result=RIGHT))
    folder.close()
    with pytest.raises(InvalidInput, match="line 2, has the seed 6, which is not that of trial 1"):
        read_batch(tmp_path)


@pytest.mark.parametrize("seed", [-1, 2**53])
def test_a_seed_that_there_is_none_of_is_refused_wherever_it_is_read(tmp_path: Path, seed: int) -> None:
    with pytest.raises(InvalidInput, match=rf"^a seed must be a whole number from 0 to .*, not {seed}$"):
        Case(trials=(0,), seed=seed)
    folder = opened(tmp_path)
    folder.close()
    file = tmp_path / "trials.jsonl"
    file.write_bytes(file.read_bytes().replace(b'"seed":5', f'"seed":{seed}'.encode()))
    with pytest.raises(InvalidInput, match=r"line 1, .*Expected `int` .= .*`\$\.world\.seed`"):
        read_batch(tmp_path)


def test_a_folder_takes_one_batch(tmp_path: Path) -> None:
    opened(tmp_path).close()
    high = msgspec.structs.replace(WORLD, level="high")
    with pytest.raises(
        InvalidInput, match=r"holds 0 trials of another batch, which differs in worlds; choose "
    ):
        opened(tmp_path, replace(TRIAL, world=high))
    other = Trial(plan=plan_of("OPEN 1\n"), world=WORLD, camera="gl", simulated_limit_s=1)
    with pytest.raises(InvalidInput, match="differs in plan, camera, limit of simulated time; "):
        opened(tmp_path, other)


def test_a_folder_of_something_else_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(InvalidInput, match=r"holds other files \(`mine\.txt`\); choose a new folder, or an "):
        opened(tmp_path)
    (tmp_path / "trials.jsonl").write_text("mine\n")
    with pytest.raises(
        InvalidInput, match=r"trials\.jsonl, line 1, cannot be read by this version of handeye: "
    ):
        opened(tmp_path)


@pytest.mark.parametrize("mine", [b"my notes", b"line 1\nline 2\nthe last one has no end"])
def test_notes_of_somebody_are_not_taken_for_a_batch_that_was_cut_short(tmp_path: Path, mine: bytes) -> None:
    (tmp_path / "trials.jsonl").write_bytes(mine)
    with pytest.raises(InvalidInput, match=r"trials\.jsonl, line 1, cannot be read"):
        opened(tmp_path)
    assert {file.name: file.read_bytes() for file in tmp_path.iterdir()} == {"trials.jsonl": mine}


def test_another_batch_that_was_cut_short_is_refused_as_it_is(tmp_path: Path) -> None:
    opened(tmp_path).close()
    with (tmp_path / "trials.jsonl").open("ab") as file:
        file.write(b'{"trial":2,"seed"')
    kept = (tmp_path / "trials.jsonl").read_bytes()
    with pytest.raises(InvalidInput, match=r"of another batch, which differs in worlds"):
        opened(tmp_path, replace(TRIAL, world=msgspec.structs.replace(WORLD, level="high")))
    assert (tmp_path / "trials.jsonl").read_bytes() == kept


def test_the_plan_in_the_folder_is_that_of_the_batch(tmp_path: Path) -> None:
    opened(tmp_path).close()
    write_plan(tmp_path / "plan.json", plan_of("OPEN 1\n"))
    with pytest.raises(InvalidInput, match=r"plan\.json is not the plan of the batch in "):
        opened(tmp_path)
    (tmp_path / "plan.json").unlink()
    opened(tmp_path).close()
    assert read_plan(tmp_path / "plan.json") == TRIAL.plan


@pytest.mark.parametrize(
    ("line", "why"),
    [
        (b'{"trial":0,"seed":77,"ended":"killed"}', "has the seed 77, which is not that of trial 0"),
        (b'{"trial":0,"seed":5,"ended":"ended"}', "a trial that counts as 'ended' has no result"),
    ],
)
def test_a_trial_that_cannot_be_of_the_batch_is_refused(tmp_path: Path, line: bytes, why: str) -> None:
    opened(tmp_path).close()
    with (tmp_path / "trials.jsonl").open("ab") as file:
        file.write(line + b"\n")
    with pytest.raises(InvalidInput, match=rf"trials\.jsonl, line 2, .*{why}"):
        read_batch(tmp_path)


def test_two_commands_do_not_write_one_batch(tmp_path: Path) -> None:
    folder = opened(tmp_path)
    with pytest.raises(InvalidInput, match=r"another command is writing to .*trials\.jsonl now"):
        opened(tmp_path)
    folder.close()


def test_a_full_disk_keeps_what_was_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder, jobs = opened(tmp_path), cases(5, range(2))
    folder.append(row(jobs[0]))
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)
    monkeypatch.setattr(signal, "SIGXFSZ", signal.signal(signal.SIGXFSZ, signal.SIG_IGN))
    resource.setrlimit(resource.RLIMIT_FSIZE, ((tmp_path / "trials.jsonl").stat().st_size + 10, limit[1]))
    try:
        with pytest.raises(InvalidInput, match=r"trials\.jsonl cannot be written"):
            carry_out(jobs, Canned(), folder=folder)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
    folder.close()
    assert read_batch(tmp_path)[1] == (row(jobs[0]),)


def test_figures_count_what_ended_how_and_tell_the_command_of_each_failure() -> None:
    rows = carry_out(cases(5, range(4)), Canned())
    lost = rows_of(ASSEMBLY, Answer(item=cases(5, [4])[0], killed=2))
    found = figures([*rows, *lost], lambda each: f"again {each.seed}")
    assert (found.n, found.right, found.outcomes["stopped"], found.silent_failures, found.failed, found.killed) == (
        5, 2, 1, 1, 1, 2,
    )  # fmt: skip
    assert [(each.trial, each.stage, each.cause, each.command) for each in found.failures] == [
        (1, "check the gasket", "the gasket is not in place", "again 6"),
        (2, "referee", "pins", "again 7"),
        (4, "", "its process was killed twice", "again 9"),
    ]


def test_a_rate_has_wilsons_interval_and_an_exact_lower_bound() -> None:
    """Wilson's by its closed form; the exact one by the chance that it gives."""
    sure = rate(57, 60)
    z, p = 1.959964, 57 / 60
    middle, half = p + z**2 / 120, z * (p * (1 - p) / 60 + z**2 / 14400) ** 0.5
    assert sure.wilson95 == pytest.approx([(middle + s * half) / (1 + z**2 / 60) for s in (-1, 1)], abs=1e-6)
    from scipy.stats import binom

    assert binom.sf(56, 60, sure.p_s) == pytest.approx(0.05)
    assert rate(2995, 2995).p_s == pytest.approx(0.999, abs=1e-6)
    assert rate(0, 0).wilson95 is None


def test_pairs_are_compared_by_mcnemars_exact_test() -> None:
    assert (mcnemar(0, 0), mcnemar(3, 3)) == (1.0, 1.0)
    assert mcnemar(0, 6) == mcnemar(6, 0) == pytest.approx(2 / 2**6)


# -- trials that are carried out ---------------------------------------------------------------------


@pytest.mark.slow
def test_a_kept_process_comes_to_the_same_as_a_new_one(tmp_path: Path) -> None:
    """The third trial of one process, to the byte of its events, is that of a process that has done nothing yet."""
    jobs = cases(5, range(3))
    kept = carry_out(jobs, processes(1))
    (new,) = carry_out(jobs[2:], processes(1))
    assert kept[2].events == new.events
    assert len({each.events for each in kept}) == 3


@pytest.mark.slow
def test_calls_of_the_operator_are_answered_as_the_batch_says() -> None:
    trial = Trial(plan=plan_of("CLOSE 2\n"), world=WORLD, camera="ray", on_stop="retry:2")
    found = trial(cases(5, range(1))[0])[0]
    assert found.verdict == "stopped"
    assert found.result is not None
    assert len(found.result.interventions) == 2
    assert answered([found]) == 1
    assert trial.head(ASSEMBLY).differs(TRIAL.head(ASSEMBLY)) == ["plan", "answers of the operator"]


@pytest.mark.slow
def test_an_exception_is_a_result() -> None:
    rows = carry_out(cases(5, range(1)), processes(1), trial=replace(TRIAL, camera="none"))
    assert (rows[0].ended, rows[0].verdict) == ("raised", "failed")
    assert rows[0].cause.startswith("NoSuchName: ")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("simulated", "cpu", "ended"), [(1.0, 99.0, "simulated limit"), (99.0, 1e-6, "processor limit")]
)
def test_a_trial_that_takes_too_long_has_failed(simulated: float, cpu: float, ended: str) -> None:
    trial = Trial(plan=plan_of(FEEL), world=WORLD, camera="ray", simulated_limit_s=simulated, cpu_limit_s=cpu)
    found = trial(cases(5, range(1))[0])[0]
    assert (found.ended, found.verdict) == (ended, "failed")


def test_what_a_trial_leaves_can_be_read_by_other_programs(tmp_path: Path) -> None:
    folder = opened(tmp_path)
    folder.append(row(cases(5, [0])[0]))
    folder.close()
    head, first = map(json.loads, (tmp_path / "trials.jsonl").read_text().splitlines())
    assert (head["format"], head["world"]["seed"], first["result"]["assembled"]) == ("handeye batch", 5, True)


# -- figures ------------------------------------------------------------------------------------------

PROGRAM = plan_of("SEARCH .2\nL: MOVE T1\nAOJ L\nMOVE P1\nMOVE T2\nOPEN 1\n").program
WHERE = {"pin": ("T1", "T2")}


def happened(*what: str) -> list[AnyEvent]:
    """Steps by their texts, tries and errors."""
    numbers = {step.text: number for number, step in enumerate(PROGRAM.steps)}
    made: list[AnyEvent] = []
    for each in what:
        if each.startswith("try"):
            made.append(SearchAdvanced(time=0.0, count=int(each[3:]), offset=(0.0, 0.0)))
        elif each == "error":
            made.append(ErrorRaised(time=0.0, number=SEARCH_EXHAUSTED, cause=None))
        else:
            made.append(StepStarted(time=0.0, step=numbers[each], line=1, text=each))
    return made


def test_a_contact_operation_lasts_until_the_hand_goes_elsewhere() -> None:
    events = happened("SEARCH .2", "MOVE T1", "AOJ L", "try1", "MOVE T1", "MOVE P1", "MOVE T2")
    for completed in (True, False):
        assert [*contacts(PROGRAM, events, WHERE, completed=completed)] == [
            Contact(operation="pin", at="T1", done=True),
            Contact(operation="pin", at="T2", done=completed),
        ]


def test_a_search_counts_its_places_and_ends_in_vain_at_the_last() -> None:
    tried = happened("SEARCH .2", "MOVE T1", "AOJ L", "try1", "MOVE T1", "AOJ L", "try2", "MOVE T1")
    assert [*searches(PROGRAM, tried)] == [SearchEnd(at="T1", places=3, found=True)]
    assert [*searches(PROGRAM, [*tried, *happened("error")])] == [SearchEnd(at="T1", places=3, found=False)]
    assert [*searches(PROGRAM, happened("SEARCH .2", "OPEN 1"))] == []


def test_the_finding_with_the_least_margin_for_its_spread_is_the_next_to_fail() -> None:
    def judged(seed: int, tilt: float, clamp: float) -> Row:
        checks = {
            "tilt": msgspec.structs.replace(FAR, ok=True, value=tilt, limit=3),
            "clamp": msgspec.structs.replace(
                FAR, ok=True, value=clamp, limit=40, relation="at least", unit="N"
            ),
        }
        found = result(completed=True, assembled=True, checks=checks)
        return Row(trial=seed, seed=seed, result=found)

    tilt, clamp = margins([judged(1, 1.0, 80.0), judged(2, 2.0, 82.0)])
    assert (tilt.finding, tilt.median, tilt.worst, tilt.worst_seed, tilt.deviations) == (
        "tilt",
        1.5,
        1.0,
        2,
        3.0,
    )
    assert (clamp.finding, clamp.worst, clamp.worst_seed, clamp.deviations) == ("clamp", 40.0, 1, 41.0)


def test_failures_are_counted_by_stage_and_cause() -> None:
    rows = [
        *carry_out(cases(5, range(4)), Canned()),
        row(Case(trials=(1,), seed=99)),
    ]
    found = figures(rows, lambda each: f"again {each.seed}")
    assert [(each.stage, each.count, each.command) for each in found.causes] == [
        ("check the gasket", 2, "again 6"), ("referee", 1, "again 7"),
    ]  # fmt: skip


def test_batches_are_compared_over_the_seeds_that_both_have() -> None:
    first = carry_out(cases(5, range(4)), Canned())
    other = [msgspec.structs.replace(each, result=STOPPED) for each in first[:3]]
    head = TRIAL.head(ASSEMBLY)
    (found,) = paired(["first", "other"], [(head, first), (head, tuple(other))])
    assert (found.pairs, found.first_right, found.right, found.only_first, found.only_this, found.noticed) == (
        3, 1, 0, 1, 0, 3,
    )  # fmt: skip
    with pytest.raises(
        InvalidInput, match=r"^other has no seed in common with the first batch; only trials "
    ):
        paired(["first", "other"], [(head, first[:1]), (head, first[1:])])


def test_batches_that_assemble_alike_are_told_apart_by_the_time_of_the_arm() -> None:
    def batch(*seconds: float) -> tuple[Head, tuple[Row, ...]]:
        timing = [msgspec.structs.replace(RIGHT.timing, manipulation_s=each) for each in seconds]
        results = [msgspec.structs.replace(RIGHT, timing=each) for each in timing]
        rows = [Row(trial=k, seed=k, result=each) for k, each in enumerate(results)]
        return TRIAL.head(ASSEMBLY), tuple(rows)

    first = batch(400, 401, 402, 403, 404, 405)
    names = ["first", "slower", "alike"]
    slower, alike = paired(names, [first, batch(405, 406, 407, 408, 409, 410), first])
    longer = slower.measures["arm time, s"]
    assert (slower.p, longer.pairs, longer.more, longer.p) == (1, 6, 5, 2 / 2**6)
    assert (alike.measures["arm time, s"].more, alike.measures["arm time, s"].p) == (0, 1)
    (apart,) = paired(names[:2], [first, (first[0], (Row(trial=0, seed=0, result=STOPPED),))])
    assert apart.measures == {}


def test_batches_of_other_worlds_or_other_work_are_not_compared() -> None:
    rows = carry_out(cases(5, range(2)), Canned())
    head, other = TRIAL.head(ASSEMBLY), TRIAL.head(DISMANTLING)
    drawn = msgspec.structs.replace(head, world=msgspec.structs.replace(WORLD, drawing=WORLD.drawing - 1))
    with pytest.raises(
        InvalidInput, match=r"^other comes from another version of handeye, in which the same seeds give "
    ):
        paired(["first", "other"], [(head, rows), (drawn, rows)])
    with pytest.raises(InvalidInput, match=r"^other holds trials of another kind"):
        paired(["first", "other"], [(head, rows), (other, rows)])


def test_what_cannot_be_left_is_told_before_a_trial_is_carried_out(command: Command, tmp_path: Path) -> None:
    write_plan(tmp_path / "open.plan.json", plan_of("OPEN 2\n"))
    words = ("trials", "assembly", "--plan", "open.plan.json", "--n", "1", "--out", "batch")
    (tmp_path / "batch").mkdir()
    (tmp_path / "batch" / "trials.jsonl").touch()
    (tmp_path / "batch" / "tables" / "mine").mkdir(parents=True)
    (tmp_path / "batch" / "tables" / "mine" / "it.csv").write_text("mine")
    code, out, err = command(*words, "--tables", "csv")
    assert (code, out, "tables holds other files (`mine/it.csv`)" in err) == (2, "", True)
    (tmp_path / "batch" / "figures.html").write_text("mine")
    code, out, err = command(*words)
    assert (code, out, "figures.html exists and is not a page of trials" in err) == (2, "", True)
    assert read_batch(tmp_path / "batch")[1] == ()
    (tmp_path / "mine.html").write_text("mine")
    code, out, err = command(*words[:-1], "mine.html")
    assert (code, out, "mine.html exists and is not a page of trials" in err) == (2, "", True)


def test_only_tables_that_handeye_wrote_are_replaced(tmp_path: Path) -> None:
    rows = carry_out(cases(5, range(2)), Canned())
    write_tables(tmp_path / "tables", tables_of(ASSEMBLY, rows, figures(rows)), "csv")
    (tmp_path / "tables" / "mine").mkdir()
    (tmp_path / "tables" / "mine" / "it.csv").write_text("mine")
    with pytest.raises(InvalidInput, match=r"holds other files \(`mine/it\.csv`\)"):
        check_tables(tmp_path / "tables", "csv")


@pytest.mark.parametrize("columns", ["20", "80"])
def test_names_of_batches_are_shown_as_they_are(
    command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, columns: str
) -> None:
    names = ["first", "[/]", "[bold]", "[1]", ":smile:", "esc\x1b[31m"]
    for name in names:
        folder = opened(tmp_path / name)
        carry_out(cases(5, range(2)), Canned(), folder=folder)
        folder.close()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", columns)
    code, out, _ = command("trials", "compare", *names)
    rows = [line.split()[0] for line in out.splitlines() if "1 of 2" in line]
    assert (code, rows) == (0, [*names[1:-1], "esc\N{REPLACEMENT CHARACTER}[31m"])


def test_page_and_tables_have_all_figures_and_nothing_from_outside() -> None:
    rows = carry_out(cases(5, range(4)), Canned())
    found = figures(rows, lambda each: f"handeye assemble --seed {each.seed}")
    page = sweep_page("it", ASSEMBLY, rows, found).decode()
    assert ("2 of 4 assembled" in page, "handeye assemble --seed 7" in page, "://" in page) == (
        True,
        True,
        False,
    )
    made = {table.name: table for table in tables_of(ASSEMBLY, rows, found)}
    assert [*made] == ["trials", "margins", "failures"]
    assert made["failures"]["seed"].tolist() == [6, 7]
    assert csv_bytes(made["trials"]).startswith(b"trial,seed,condition,verdict,")


def test_contact_operations_of_the_pump_happen_at_positions_that_are_taught() -> None:
    taught = load_taught(plans() / "water_pump.toml").positions
    assert {each for positions in task().contacts.values() for each in positions} <= {*taught}
