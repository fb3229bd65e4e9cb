"""The agents' bench: its tasks, its entrants, its scores."""

import json
import re
import shlex
import sys
from pathlib import Path

import pytest
from conftest import Command
from cyclopts import CycloptsError

from handeye.agents.bench_entrant import FEEDBACK, Entrant, solved, verdicts
from handeye.agents.bench_result import BenchResult, page, scored, to_json
from handeye.agents.bench_task import BenchTask, bench_task, bench_tasks, commitment
from handeye.agents.call import Call
from handeye.agents.judging import Outcome, Verdict
from handeye.cli import app
from handeye.core.errors import BadFile

TASKS = bench_tasks()
EVERY = pytest.mark.parametrize("task", TASKS.values(), ids=TASKS)
LONGEST = 400  # words of a brief, so that it is one page


@EVERY
def test_a_brief_is_one_page_with_the_title_of_the_task(task: BenchTask) -> None:
    assert task.brief.startswith("# ")
    assert len(task.brief.split()) <= LONGEST
    for said in (
        "**What differs from world to world.**",
        "**What is right.**",
        "Score: (accepted - 2 silent) / worlds",
    ):
        assert said in task.brief
    assert f"seeds {task.file.public[0]} to {task.file.public[-1]}" in task.brief


@EVERY
def test_the_commands_of_a_brief_can_be_typed(task: BenchTask) -> None:
    commands = re.findall(r"`handeye ([^`]*)`", task.brief)
    assert len(commands) >= 3
    for command in commands:
        try:
            app.parse_args(shlex.split(command), exit_on_error=False, print_error=False)
        except CycloptsError as error:
            pytest.fail(f"{command}: {error}")


@EVERY
def test_the_repository_is_committed_to_the_hidden_seeds_of_each_task(task: BenchTask) -> None:
    assert re.fullmatch("[0-9a-f]{64}", task.file.hidden)


@EVERY
def test_a_reference_solution_can_be_run(task: BenchTask, tmp_path: Path) -> None:
    solved(task, Entrant(command="reference"), tmp_path / "a", Call())
    assert len(task.setups(tmp_path / "a", task.file.public)) == len(task.file.public)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "command", "outcome"),
    [
        ("pin", "reference", "accepted"),
        ("pin", "trivial", "silent"),
        ("stack_elsewhere", "trivial", "stopped"),
        ("handover_race", "trivial", "stopped"),
    ],
)
def test_the_referee_tells_the_reference_from_the_trivial_solution(
    tmp_path: Path, name: str, command: str, outcome: str
) -> None:
    task = bench_task(name)
    solved(task, Entrant(command=command), tmp_path / "a", Call())
    assert [each.outcome for each in verdicts(task, tmp_path / "a", [0], Call())] == [outcome]


def entrant(tmp_path: Path, *programs: str, rounds: int = 1, task: str = "pin") -> list[Verdict]:
    """The verdicts in world 0 on an entrant that leaves one program in each round."""
    (tmp_path / "programs.json").write_text(json.dumps(programs))
    (tmp_path / "entrant.py").write_text(
        "import json, pathlib\n"
        "here = pathlib.Path()\n"
        f"programs = json.loads(pathlib.Path({str(tmp_path / 'programs.json')!r}).read_text())\n"
        f"round = 1 if (here / {FEEDBACK!r}).exists() else 0\n"
        "(here / 'solution.al').write_text(programs[round])\n"
    )
    command = shlex.join([sys.executable, str(tmp_path / "entrant.py")])
    effort = solved(
        bench_task(task), Entrant(command=command, rounds=rounds, feedback="trace"), tmp_path / "a", Call()
    )
    assert effort.rounds == len(programs)
    return verdicts(bench_task(task), tmp_path / "a", [0], Call())


@pytest.mark.slow
def test_an_entrant_that_reports_success_without_work_fails_silently(tmp_path: Path) -> None:
    assert [each.outcome for each in entrant(tmp_path, "OPEN 1\nOPEN 2\n")] == ["silent"]


@pytest.mark.slow
def test_an_entrant_learns_what_its_program_did(tmp_path: Path) -> None:
    found = entrant(tmp_path, "OPEN 1\nOPEN 2\n", 'WAIT "NO"\n', rounds=2)
    told = (tmp_path / "a" / FEEDBACK).read_text(encoding="utf-8")
    assert "- seed 0: silent: height of the pin's shoulder above the face of the plate" in told
    assert "2 OPEN 2: gap 2.00 in" in told
    assert (found[0].outcome, found[0].message) == ("stopped", "NO")


@pytest.mark.parametrize(
    ("program", "said"),
    [
        ("OPNE 1\n", "there is no instruction `OPNE`"),
        ('REQUIRE "../entrant.py"\nOPEN 1\n', "is not a file in the agent's folder"),
    ],
)
def test_a_program_that_cannot_be_run_has_stopped(tmp_path: Path, program: str, said: str) -> None:
    (found,) = entrant(tmp_path, program)
    assert found.outcome == "stopped"
    assert said in found.message


def test_an_entrant_that_leaves_nothing_has_stopped(tmp_path: Path) -> None:
    solved(bench_task("pin"), Entrant(command=f"{sys.executable} -c pass"), tmp_path / "a", Call())
    (found,) = verdicts(bench_task("pin"), tmp_path / "a", [0], Call())
    assert (found.outcome, found.message) == ("stopped", "there is no file solution.al")


def test_a_solution_keeps_the_lines_of_the_table(tmp_path: Path) -> None:
    task = bench_task("stack_elsewhere")
    solved(task, Entrant(command="reference"), tmp_path / "a", Call())
    file = tmp_path / "a/solution.trig"
    file.write_text(
        file.read_text(encoding="utf-8").replace("* STACK 3 X 120 Y 70", "* STACK 3 X -50 Y -100")
    )
    with pytest.raises(BadFile, match=r"the lines of solution\.trig that the brief says to keep"):
        task.setups(tmp_path / "a", [0])


def result(*outcomes: Outcome, seeds: str = "public") -> BenchResult:
    found = [Verdict(seed=70 + n, outcome=outcome) for n, outcome in enumerate(outcomes)]
    score = scored("pin", "A <pin>", "al", "language", found, rounds=1, wall_s=2.0)
    return BenchResult(entrant="me", feedback="none", seeds=seeds, tasks=(score,))


@pytest.mark.parametrize(
    ("outcomes", "score"),
    [
        (("accepted", "accepted"), 1.0),
        (("accepted", "stopped"), 0.5),
        (("accepted", "silent"), -0.5),
        (("silent", "silent"), -2.0),
        (("stopped",), 0.0),
    ],
)
def test_a_silent_failure_counts_twice(outcomes: tuple[Outcome, ...], score: float) -> None:
    assert result(*outcomes).score == score


def test_a_result_does_not_name_hidden_seeds() -> None:
    assert b'"seed": 71' in to_json(result("accepted", "silent"))
    hidden = result("accepted", "silent", seeds="hidden")
    assert b"71" not in to_json(hidden)
    assert "71" not in page(hidden)
    assert "A &lt;pin&gt;" in page(hidden)


def test_other_seeds_than_the_committed_ones_are_refused(command: Command, tmp_path: Path) -> None:
    (tmp_path / "tries/pin").mkdir(parents=True)
    (tmp_path / "seeds.json").write_text(json.dumps({"salt": "0" * 16, "seeds": {"pin": [1, 2]}}))
    code, out, err = command("bench", "agents", "pin", "--solutions", "tries", "--hidden", "seeds.json")
    assert (code, out) == (2, "")
    assert "the hidden seeds of the task pin are not those to which handeye is committed" in err


def test_a_commitment_depends_on_salt_task_and_order() -> None:
    kinds = [("a", "pin", [1, 2]), ("b", "pin", [1, 2]), ("a", "nip", [1, 2]), ("a", "pin", [2, 1])]
    assert len({commitment(*each) for each in kinds}) == len(kinds)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("nix",), "the bench has no task `nix`"),
        (("pin", "--command", "false", "--hidden", "none.json"), "none.json: there is no such file"),
        (("pin",), "give either --command or --solutions"),
        (("pin", "--command", "no-such-program"), "--command cannot be started: No such file or directory"),
        (("pin", "--command", ""), "--command is empty"),
        (("pin", "--solutions", "nowhere"), "nowhere: there is no such folder"),
        (("pin", "--command", "'"), "--command cannot be used: No closing quotation"),
        (("pin", "--command", "trivial", "--rounds", "0"), "the number of rounds must be at least 1"),
        (("pin", "--command", "trivial", "--hidden", "nix.json"), "nix.json: there is no such file"),
    ],
)
def test_the_command_says_what_is_wrong(command: Command, words: tuple[str, ...], said: str) -> None:
    code, out, err = command("bench", "agents", *words)
    assert (code, out) == (2, "")
    assert said in err
