"""The tables by cycle: what is recorded is what the tables contain, in a run, after going back, and from a file."""

import gzip
import json
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from msgspec.structs import replace
from run_bench import FELT, HELD, NEAR, begin, lines, program, ran

from handeye.core.errors import BadFile, InvalidInput
from handeye.execution.servo import ServoPeriod
from handeye.program.events import LineTyped
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import read_checkpoint, write_checkpoint
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.systems.ml.dashboard.history import History, packed, unpacked
from handeye.systems.ml.run.running import RunningMl
from handeye.view.moment import Newest
from handeye.view.stepping import stepping_page

Command = Callable[..., tuple[int, str, str]]
EXAMPLE = program("guarded_move")
SENSES = ("--sense", "4=-700", "--sense", "8=300", "--sense", "5=500@3:2750")
BOTH_ARMS = "10 DMOTOR 3 500\n20 PUT US 3 2 7\n30 STOP\n100 TRACE\n105 DMOTOR 3 -800\n110 LOAD 1 1\n115 STOP"


@cache
def example() -> History:
    """The tables of the paper's example, in which sensor 5 reads 500 grams."""
    return tables(ran(EXAMPLE, HELD, NEAR, FELT))


def tables(runner: Runner) -> History:
    assert isinstance(runner.system, RunningMl)
    return runner.system.tables


def word(done: History, table: str, line: int, word: int, cycle: int) -> int:
    return done.value(done.find(table).number(line, word), cycle)


@pytest.mark.slow
@pytest.mark.parametrize("left", [None, 100])
def test_after_a_run_the_record_agrees_with_every_word_of_every_table(left: int | None) -> None:
    runner = ran(BOTH_ARMS, left=left)
    done, system = tables(runner), runner.system
    assert isinstance(system, RunningMl)
    different = []
    for segment in done.segments:
        level = system.machine.levels["left" if segment.side == "left" else "right"]
        lines = range(1, 130 if segment.table == "TK" else segment.shape.lines + 1)
        for line in lines if segment.table != "PF" else ():  # which reading an external table changes
            for at in range(1, segment.shape.words + 1):
                if level.read(segment.table, line, at) != done.value(segment.number(line, at), done.last):
                    different.append((segment.side, segment.table, line, at))
    assert different == []
    assert len({segment.table for segment in done.segments}) == 30


def test_a_flag_is_on_in_the_cycle_of_its_limit_and_off_in_the_cycle_after_sensor() -> None:
    done = example()
    assert [word(done, "ST", 5, 11, cycle) for cycle in (111, 112, 113)] == [0, 1, 0]
    assert [word(done, "MT", 3, 1, cycle) for cycle in (0, 111, 112)] == [0, 2709, 2787]
    assert (word(done, "MT", 3, 4, 111), word(done, "MT", 3, 4, 112)) == (4000, 2787)  # the freeze
    assert [word(done, "AR", 1, 3, cycle) for cycle in (112, 113)] == [288, 520]


def test_a_word_that_a_program_writes_is_changed_in_the_next_cycle() -> None:
    done = tables(ran("10 DMOTOR 2 100\n20 PUT MT 2 8 10\n30 DMOTOR 2 50"))
    speed = done.find("MT").number(2, 8)
    cycle = next(cycle for cycle in range(done.last) if done.changed(speed, cycle) and cycle)
    assert (done.value(speed, cycle - 1), done.value(speed, cycle)) == (79, 10)
    assert word(done, "MT", 2, 5, cycle) - word(done, "MT", 2, 5, cycle - 1) == 10  # and obeyed in that cycle


@pytest.mark.slow
def test_a_run_that_went_back_or_was_kept_and_resumed_has_the_same_record(tmp_path: Path) -> None:
    whole = packed(example())
    runner = Runner(begin(EXAMPLE, HELD, NEAR, FELT))
    advance(runner, steps=9)
    runner.back_to(4)
    advance(runner, steps=3)
    write_checkpoint(tmp_path / "kept", runner.checkpoint())
    resumed = Runner(read_checkpoint(tmp_path / "kept"))
    advance(resumed)
    assert packed(tables(resumed)) == whole


def test_a_record_becomes_a_small_file_and_is_read_again() -> None:
    done = example()
    data = packed(done)
    assert len(data) < 2500
    again = unpacked(data, "tables.gz")
    assert (again.head, again.courses) == (done.head, done.courses)


@pytest.mark.parametrize("spoil", [
    lambda data: b"",
    lambda data: data[: len(data) // 2],
    lambda data: gzip.compress(gzip.decompress(data)[:-1]),
    lambda data: gzip.compress(gzip.decompress(data) + b"\xff\xff\x7f\x01\x00\x00"),  # a word beyond the last table
    lambda data: gzip.compress(gzip.decompress(data) + b"\x00\x01\x00\xff\xff\x7f"),  # a value of more than 16 bits
    lambda data: gzip.compress(gzip.decompress(data) + b"\x00\x01\xff\x7f\x02"),  # a cycle after the end
    lambda data: gzip.compress(b"\x05[[[[["),
])  # fmt: skip
def test_a_file_that_is_no_record_is_refused(spoil: Callable[[bytes], bytes]) -> None:
    data = packed(example())
    with pytest.raises(BadFile, match=r"^tables\.gz is not a recording of the machine's tables$"):
        unpacked(spoil(data), "tables.gz")


def test_a_saved_state_with_a_spoilt_record_is_refused_when_it_is_shown(tmp_path: Path) -> None:
    runner = Runner(begin(EXAMPLE, HELD, NEAR, FELT))
    advance(runner, steps=5)
    kept = runner.checkpoint()
    assert kept.snapshot is not None
    for blocks, rest in (((b"no",), b""), ((), b"12345")):
        kept.snapshot.state.tape.blocks, kept.snapshot.state.tape.open = blocks, rest  # type: ignore[attr-defined]
        write_checkpoint(tmp_path / "forged", replace(kept))
        resumed = Runner(read_checkpoint(tmp_path / "forged"))
        with pytest.raises(BadFile, match=r"^the recording of the tables cannot be read$"):
            _ = tables(resumed)


@pytest.mark.slow
def test_the_command_shows_tables_a_table_a_line_and_the_changes_of_a_word(command: Command) -> None:
    Path("example.ml").write_text(EXAMPLE, encoding="utf-8")
    code, out, _ = command("ml", "tables", "example.ml", *SENSES)
    assert (code, out.splitlines()[0]) == (0, "example.ml, after cycle 120, the last one")
    assert len(out.splitlines()) == 33
    _, out, _ = command("ml", "tables", "example.ml", "mt", "--at", "1.12s", *SENSES)
    (y,) = [row.split() for row in out.splitlines() if row.startswith("3   ")]
    assert y[:7] == ["3", "y", "2787*", "2709*", "2630*", "2787*", "2787"]
    _, out, _ = command("ml", "tables", "example.ml", "ST", "5", "11", *SENSES, "--json")
    assert json.loads(out)["changes"] == [[112, 1], [113, 0]]
    _, out, _ = command("ml", "tables", "example.ml", "ST", "5", "--at", "112", *SENSES)
    assert "ST 5 11       1* flag" in out.splitlines()


@pytest.mark.slow
def test_the_command_shows_a_recorded_run_and_one_that_was_interrupted(command: Command) -> None:
    Path("example.ml").write_text(EXAMPLE, encoding="utf-8")
    command("ml", "run", "example.ml", *SENSES, "--out", "kept")
    _, whole, _ = command("ml", "tables", "kept", "MT")
    Path("kept/tables.gz").unlink()
    code, out, _ = command("ml", "tables", "kept", "MT")  # from its last checkpoint
    assert (code, out) == (0, whole)
    _, report, _ = command("report", "kept")
    assert report == "kept/report.html\n"
    page = Path("kept/report.html").read_text(encoding="utf-8")
    assert 'id="tables-record"' in page
    assert "MT: motors, after cycle 120, the last one" in page


@pytest.mark.parametrize(("words", "sentence"), [
    (("gone",), "gone: there is no such file"),
    (("example.ml", "TT"), "there is no table `TT`; the tables are MT, ST"),
    (("example.ml", "MT", "13"), "there is no line 13: the lines are 1 to 12"),
    (("example.ml", "MT", "1", "17"), "there is no word 17: the words are 1 to 16"),
    (("example.ml", "MT", "1", "1", "--at", "0"), "with a word, the command shows the changes of this word"),
    (("example.ml", "--at", "9s"), "--at is after the end of the run, which has 1 cycle, numbered from 0"),
    (("example.ml", "--at", "soon"), "--at takes a cycle (275) or a time (2.75s), not `soon`"),
    (("example.ml", "MT", "--arm", "left"), "example.ml has no table MT of the left arm"),
    (("empty",), "empty holds no run"),
    (("empty", "--sense", "5=1"), "--sense applies only to a program (.ml)"),
])  # fmt: skip
def test_bad_input_is_refused_in_a_sentence(command: Command, words: tuple[str, ...], sentence: str) -> None:
    Path("example.ml").write_text("10 DELAY 1", encoding="utf-8")
    Path("empty").mkdir()
    code, out, err = command("ml", "tables", *words)
    assert (code, out) == (2, "")
    assert err.startswith(f"handeye: {sentence}"), err


# -- a running machine --------------------------------------------------------------------------------


class Typist(Observer):
    """Types lines while the arm moves."""

    def __init__(self, at: float, *texts: str) -> None:
        self.at, self.texts = at, [*texts]
        self.refused: list[str] = []
        self.runner: Runner | None = None

    def tick(self, period: ServoPeriod) -> None:
        assert self.runner is not None
        if self.texts and period.sensed.time >= self.at:
            try:
                self.runner.type_line(self.texts.pop(0), "right")
            except InvalidInput as error:
                self.refused.append(str(error))


def typed(typist: Typist, text: str) -> Runner:
    def watching(runner: Runner) -> list[Typist]:
        typist.runner = runner
        return [typist]

    runner = Runner(begin(text), observers=watching)
    advance(runner)
    return runner


SLOWER = "FILE MT 3 8 20"
THERE_AND_BACK = "10 MOTOR 3 2000\n20 MOTOR 3 0"


def test_a_word_written_while_the_arm_moves_takes_effect_in_the_next_cycle_and_is_repeated() -> None:
    runner = typed(Typist(0.05, SLOWER), THERE_AND_BACK)
    done = tables(runner)
    assert [word(done, "MT", 3, 5, cycle) for cycle in range(3, 7)] == [315, 394, 414, 434]
    again = Runner(begin(THERE_AND_BACK))
    again.repeat(runner.events)
    assert lines(again) == lines(runner)
    assert packed(tables(again)) == packed(done)
    runner.back_to(1)
    assert sum(isinstance(event, LineTyped) for event in runner.events) == 1
    assert runner.time == pytest.approx(0.87)  # and not .27, as without the written word


def test_while_the_arm_moves_other_lines_and_wrong_words_are_refused_and_change_nothing() -> None:
    typist = Typist(0.05, "MOTOR 3 0", "FILE MT 3 8 70000", "FILE SF 1 1 0", "FILE MT 3", "10 STOP")
    runner = typed(typist, THERE_AND_BACK)
    assert [each[:26] for each in typist.refused] == [
        "while a statement is being", "M04: `70000` does not fit ", "M11: word 1 of SF cannot b",
        "M03: FILE takes 4 to 15 pa", "while a statement is being",
    ]  # fmt: skip
    assert lines(runner) == lines(ran(THERE_AND_BACK))


def test_a_live_page_gets_all_changes_then_the_new_ones_and_after_going_back_all_again() -> None:
    runner = Runner(begin(EXAMPLE, HELD, NEAR, FELT))
    live = runner.system.live
    assert live is not None
    mark: object = None
    seen: dict[int, list[tuple[int, int]]] = {}
    for steps in (3, 5, 20):
        advance(runner, steps=steps)
        news = live.since(mark)
        assert news is not None
        mark, message = news[0], json.loads(news[1])
        assert message["restarted"] is (steps == 3)
        for cycle, number, value in zip(*(message["tables"][n::3] for n in range(3)), strict=True):
            seen.setdefault(number, []).append((cycle, value))
    done = tables(runner)
    assert {number: values[-1][1] for number, values in seen.items()} == {
        number: course.values[-1] for number, course in done.courses.items()
    }
    assert live.since(mark) is None
    runner.back_to(2)
    news = live.since(mark)
    assert news is not None
    assert json.loads(news[1])["restarted"] is True


def test_the_page_of_a_program_on_perfect_motors_has_its_statements_and_its_tables() -> None:
    runner = Runner(begin(EXAMPLE, HELD, NEAR, FELT))
    page = stepping_page(runner, Newest(runner)).decode()
    assert '<li id="line-0-288" value="288"><code>MOTOR 3 4000</code></li>' in page
    assert 'id="tables-facts"' in page
    assert 'id="view"' not in page
    facts = json.loads(page.split('id="facts" type="application/json">')[1].split("</script>")[0])
    assert {name: listed for name, _, listed in facts["channels"]}["position_3"] is False


@pytest.mark.parametrize(("words", "sentence"), [
    (("nothing",), "nothing: there is no such file, and no job of that name; jobs are follow"),
    (("follow", "--sense", "5=1"), "the job follow has an arm and sensors of its own"),
    (("example.ml", "--variant", "L"), "--variant applies only to a job"),
    (("example.ml", "--seed", "3"), "--seed applies only to `--arm rectilinear`"),
])  # fmt: skip
def test_a_page_that_cannot_be_shown_is_refused(
    command: Command, words: tuple[str, ...], sentence: str
) -> None:
    Path("example.ml").write_text("10 DELAY 1", encoding="utf-8")
    code, out, err = command("ml", "view", *words)
    assert (code, out) == (2, "")
    assert err.startswith(f"handeye: {sentence}"), err
