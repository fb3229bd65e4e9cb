"""The agents' bench: its tasks, its entrants, its scores."""

import json
import re
import runpy
import shlex
import sys
from pathlib import Path

import pytest
from conftest import Command
from cyclopts import CycloptsError

from handeye.agents.bench_entrant import Entrant, lost, solved, verdicts
from handeye.agents.bench_feedback import FEEDBACK, feedback
from handeye.agents.bench_page import bench_page
from handeye.agents.bench_result import BenchResult, scored, to_json
from handeye.agents.bench_task import BenchTask, bench_task, bench_tasks
from handeye.agents.call import Call
from handeye.agents.hidden_seeds import commitment
from handeye.agents.judging import Outcome, Verdict
from handeye.cli import app
from handeye.core.errors import BadFile

TASKS = bench_tasks()
EVERY = pytest.mark.parametrize("task", TASKS.values(), ids=TASKS)
ROOT = Path(__file__).parent.parent.parent
LONGEST = 670  # words of a brief, so that it is one page


@EVERY
def test_a_brief_is_one_page_and_says_what_an_entrant_must_know(task: BenchTask) -> None:
    brief = task.brief
    assert brief.startswith("# ")
    assert len(brief.split()) <= LONGEST
    for said in (
        "**What differs",
        "**What is right.**",
        f"**What to leave.** Your program, as `{task.program}` in this folder",
        "**What counts.** Score: (accepted - 2 silent) / worlds.",
        f"**How to try it.** `handeye bench agents {task.name} --try .` judges your program",
    ):
        assert said in brief
    assert ("do not use `handeye docs`" in brief) == (task.file.tier == "bare")
    assert not re.search(r"^\{", brief, re.MULTILINE)
    if not task.file.orders:
        assert re.search(rf"the seeds {task.file.public[0]} (to|and) {task.file.public[-1]}", brief)


def test_there_are_enough_tasks_in_each_language() -> None:
    languages = [task.file.language for task in TASKS.values()]
    assert len(TASKS) >= 30
    for language, least in {"al": 10, "trig": 10, "ml": 5, "mal": 5}.items():
        assert languages.count(language) >= least
    assert {task.file.tier for task in TASKS.values()} == {"macros", "language", "bare", "repair"}


def test_the_page_lists_the_tasks() -> None:
    made = runpy.run_path(str(ROOT / "docs/make_agents_bench.py"))
    page = (ROOT / "docs/agents_bench.md").read_text(encoding="utf-8")
    assert made["between"](page, "tasks", made["tasks"]()) == page


@EVERY
def test_the_commands_of_a_brief_can_be_typed(task: BenchTask) -> None:
    commands = re.findall(r"`handeye ([^`]*)`", task.brief)
    assert len(commands) >= 2
    for command in commands:
        try:
            app.parse_args(shlex.split(command), exit_on_error=False, print_error=False)
        except CycloptsError as error:
            pytest.fail(f"{command}: {error}")


@EVERY
def test_the_repository_is_committed_to_the_hidden_seeds_of_each_task(task: BenchTask) -> None:
    assert re.fullmatch("" if task.file.orders else "[0-9a-f]{64}", task.file.hidden)


@EVERY
def test_the_own_solutions_of_a_task_can_be_judged(task: BenchTask, tmp_path: Path) -> None:
    for kind in ("reference", "trivial"):
        solved(task, Entrant(command=kind), tmp_path / kind, Call())
        assert (tmp_path / kind / task.program).is_file()
    if not task.file.orders:
        assert len(task.setups(tmp_path / "reference", task.file.public)) == len(task.file.public)


JUDGED = [
    ("pin", "reference", 0, "accepted"),
    ("pin", "trivial", 0, "silent"),  # findings of the task's referee
    ("stand_gently", "trivial", 0, "silent"),  # the pin must stand on the face
    ("touch_and_return", "trivial", 0, "silent"),  # the pin must be back
    ("stack_elsewhere", "trivial", 0, "stopped"),
    ("reversible", "trivial", 0, "stopped"),  # the arm must undo its work
    ("sort_by_width", "trivial", 1, "silent"),  # printed lines
    ("find_the_stop", "trivial", 1, "silent"),  # measured values
    ("find_the_stop", "trivial", 2, "silent"),  # impossible work
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "command", "seed", "outcome"), JUDGED)
def test_each_kind_of_referee_tells_right_from_wrong(
    tmp_path: Path, name: str, command: str, seed: int, outcome: str
) -> None:
    task = bench_task(name)
    solved(task, Entrant(command=command), tmp_path / "a", Call())
    assert [each.outcome for each in verdicts(task, tmp_path / "a", [seed], Call())] == [outcome]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("program", "seed", "outcome"),
    [('WAIT "NO"\n', 0, "stopped"), ('WAIT "NO"\n', 1, "accepted"), ("OPEN 1\n", 1, "silent")],
)
def test_where_the_work_is_impossible_only_a_stop_is_right(
    tmp_path: Path, program: str, seed: int, outcome: str
) -> None:
    (tmp_path / "solution.al").write_text(program)
    (found,) = verdicts(bench_task("honest_search"), tmp_path, [seed], Call())
    assert found.outcome == outcome


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "outcomes"),
    [("deadlock", ["accepted", "stopped"]), ("rendezvous", ["accepted", "silent"])],
)
def test_a_program_is_judged_in_every_order_of_its_tasks(
    tmp_path: Path, name: str, outcomes: list[str]
) -> None:
    task, found = bench_task(name), []
    for kind in ("reference", "trivial"):
        solved(task, Entrant(command=kind), tmp_path / kind, Call())
        found += verdicts(task, tmp_path / kind, [5, 6], Call())
    assert [each.outcome for each in found] == outcomes


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


@pytest.mark.parametrize(
    ("done", "said"),
    [
        ("(here / 'feedback.md').mkdir()", "something other than a file in the place of feedback.md"),
        ("(here / 'feedback.md').symlink_to('/dev/null')", "something other than a file in the place of"),
        ("here.rename(here.parent / 'b')", "the entrant has removed, replaced or locked the folder"),
    ],
)
def test_an_entrant_that_blocks_its_feedback_loses_the_task(tmp_path: Path, done: str, said: str) -> None:
    task, file = bench_task("pin"), tmp_path / "entrant.py"
    file.write_text(f"import pathlib\nhere = pathlib.Path.cwd()\n{done}\n")
    command = shlex.join([sys.executable, str(file)])
    effort = solved(task, Entrant(command=command, rounds=3), tmp_path / "a", Call())
    assert effort.rounds == 1
    assert said in effort.barred
    assert {each.outcome for each in lost(task, [1, 2], effort.barred)} == {"stopped"}


def test_the_bench_goes_on_after_an_entrant_that_blocks_its_feedback(
    command: Command, tmp_path: Path
) -> None:
    (tmp_path / "entrant.py").write_text("import os\nos.mkdir('feedback.md')\n")
    words = shlex.join([sys.executable, str(tmp_path / "entrant.py")])
    code, out, err = command("bench", "agents", "deadlock", "--command", words, "--rounds", "2", "--json")
    assert code == 0
    assert json.loads(out)["tasks"][0]["stopped"] == 1
    assert "something other than a file in the place of feedback.md" in err


def test_a_brief_can_be_read_without_a_command(command: Command) -> None:
    code, out, _ = command("bench", "agents", "tower", "--brief", "mine")
    assert (code, out) == (0, "mine: brief.md, solution.trig\n")
    for name, data in bench_task("tower").given().items():
        assert Path("mine", name).read_bytes() == data
    code, _, err = command("bench", "agents", "tower", "--brief", "mine")
    assert (code, "the folder mine cannot be created: File exists" in err) == (2, True)
    assert command("bench", "agents", "--brief", "all")[1].count("\n") == len(TASKS)
    assert Path("all/pin/brief.md").is_file()


def test_feedback_says_what_was_measured_and_why_no_step_was_made() -> None:
    good = Verdict(seed=0, outcome="accepted", measured=("tilt (at most 3 deg): 0.5",), steps=("1 OPEN",))
    bad = [Verdict(seed=seed, outcome="stopped", message="no hole") for seed in (1, 2)]
    orders = Verdict(seed=3, outcome="stopped", message="deadlock", listed=False)
    told = feedback([good, *bad, orders], "trace")
    assert told.endswith(
        "- seed 0: accepted\n  - tilt (at most 3 deg): 0.5\n- seed 1: stopped: no hole\n- seed 2: stopped: no hole\n"
        "- seed 3: stopped: deadlock\n\n## No steps (seed 1, 2)\n\nThe program did not make a step: no hole\n"
    )
    assert "tilt" in feedback([good], "errors")
    assert "tilt" not in feedback([good], "verdict")


@pytest.mark.slow
def test_an_accepted_program_learns_how_close_it_was_to_the_limits(tmp_path: Path) -> None:
    task = bench_task("stand_gently")
    solved(task, Entrant(command="reference"), tmp_path / "a", Call())
    (found,) = verdicts(task, tmp_path / "a", [0], Call())
    assert found.outcome == "accepted"
    assert any("greatest force between pin and plate (at most 30 N): " in each for each in found.measured)


def test_one_program_can_be_tried(command: Command, tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/solution.mal").write_text("10 PRINT 1\n")
    code, out, _ = command("bench", "agents", "deadlock", "--try", "mine")
    assert code == 0
    assert out.startswith("# Your solution in the public worlds")
    assert "stopped: solution.mal lacks lines that the brief says to keep, or has more of them" in out


@pytest.mark.slow
def test_the_tasks_can_be_checked(command: Command) -> None:
    code, out, err = command("bench", "agents", "deadlock", "--check", "--json")
    assert code == 0
    (found,) = json.loads(out)
    assert (found["worlds"], found["reference_accepted"], found["trivial_accepted"]) == (1, 1, 0)
    assert "deadlock, trivial, seed 0: stopped: no task can continue" in err


def test_a_solution_keeps_the_lines_of_the_table(tmp_path: Path) -> None:
    task = bench_task("stack_elsewhere")
    solved(task, Entrant(command="reference"), tmp_path / "a", Call())
    file = tmp_path / "a/solution.trig"
    file.write_text(
        file.read_text(encoding="utf-8").replace("* STACK 3 X 120 Y 70", "* STACK 3 X -50 Y -100")
    )
    with pytest.raises(BadFile, match=r"solution\.trig lacks lines that the brief says to keep"):
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
    assert b"71" not in bench_page(hidden).partition(b"<body>")[2]
    assert b"A &lt;pin&gt;" in bench_page(hidden)


def test_other_seeds_than_the_committed_ones_are_refused(command: Command, tmp_path: Path) -> None:
    (tmp_path / "tries/pin").mkdir(parents=True)
    (tmp_path / "seeds.json").write_text(json.dumps({"salt": "0" * 16, "seeds": {"pin": [1, 2]}}))
    code, out, err = command("bench", "agents", "pin", "--solutions", "tries", "--hidden", "seeds.json")
    assert (code, out) == (2, "")
    assert "the hidden seeds of the task pin do not match the SHA-256 in its task.toml" in err


def test_a_commitment_depends_on_salt_task_and_order() -> None:
    kinds = [("a", "pin", [1, 2]), ("b", "pin", [1, 2]), ("a", "nip", [1, 2]), ("a", "pin", [2, 1])]
    assert len({commitment(*each) for each in kinds}) == len(kinds)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("nix",), "the bench has no task `nix`"),
        (("pin", "--command", "false", "--hidden", "none.json"), "none.json: there is no such file"),
        (("pin",), "give one of --command, --solutions, --try, --brief and --check"),
        (("pin", "--check", "--try", "."), "give one of --command, --solutions, --try, --brief and --check"),
        (("--try", "."), "--try needs the name of one task"),
        (("pin", "--try", "nowhere"), "nowhere: there is no such folder"),
        (("pin", "--command", "no-such-program"), "the command cannot be started: No such file or directory"),
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
