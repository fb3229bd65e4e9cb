"""Teaching in a browser: what `handeye teach` does, said from a page, and shown there."""

import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Command
from repl_sessions import workplace

from handeye.debugger.live import Pace
from handeye.program.taught import Taught, load_taught
from handeye.teaching.teach_commands import TeachSession
from handeye.teaching.teacher import Teacher
from handeye.trace.frames import Frames
from handeye.view.link import Link
from handeye.view.moment import Moment
from handeye.view.teaching import Watch, taught_markup, teach, teaching_page

pytestmark = pytest.mark.slow
LINES = ("table x -2", "open 1", "here FIRST", "hand turn z 10", "here SECOND", "undo", "save", "quit")


@dataclass
class Lesson:
    """Somebody teaches in a cell, and what the pages were told."""

    session: TeachSession
    watch: Watch
    link: Link
    told: list[dict[str, Any]] = field(default_factory=list)
    moments: list[Moment] = field(default_factory=list)
    """The newest whenever a line was waited for."""

    @classmethod
    def begun(cls, folder: Path) -> "Lesson":
        """In a cell of its own, with a file that is not there yet."""
        link = Link()
        watch = Watch(link, Pace())
        place = workplace(Taught(), halt=link.panic, observers=watch)
        lesson = cls(TeachSession(Teacher(workplace=place, file=folder / "job.toml", saved="")), watch, link)
        link.tell = lambda message: lesson.told.append(json.loads(message))
        return lesson

    def go(self, lines: Sequence[str], first: Callable[[], object] = lambda: None) -> None:
        """Say lines, each when the arm is held."""
        rest = iter(lines)

        @contextmanager
        def asked() -> Iterator[None]:
            assert self.watch.newest is not None
            self.moments.append(self.watch.newest.moment)
            self.link.say(next(rest))
            yield

        first()
        teach(self.session, self.link, asked)

    def all(self, name: str) -> list[Any]:
        """What was told under a name."""
        return [message[name] for message in self.told if name in message]


@pytest.fixture(scope="module")
def lesson(tmp_path_factory: pytest.TempPathFactory) -> Lesson:
    lesson = Lesson.begun(tmp_path_factory.mktemp("lesson"))
    lesson.go(LINES)
    return lesson


def test_what_is_recorded_stands_in_the_file_as_teach_writes_it(lesson: Lesson, tmp_path: Path) -> None:
    terminal = TeachSession(Teacher(workplace=workplace(Taught()), file=tmp_path / "job.toml", saved=""))
    for line in LINES:
        terminal.hear(line)
    file = lesson.session.teacher.file
    assert file.read_bytes() == (tmp_path / "job.toml").read_bytes()
    assert [*load_taught(file).positions] == ["FIRST"]


def test_pages_are_told_each_line_its_answer_and_the_file(lesson: Lesson) -> None:
    assert lesson.all("begun") == [*LINES]
    answers = lesson.all("answer")
    assert len(answers) == len(LINES) + 1
    assert answers[1].startswith("hand ")
    assert lesson.all("unsaved")[-4:] == [["FIRST", "SECOND"], ["FIRST"], [], []]
    assert [taught.count("FIRST") for taught in lesson.all("taught")[2:5]] == [0, 1, 1]


def test_the_cell_is_shown_from_plan_to_plan_and_its_time_goes_on(lesson: Lesson) -> None:
    newest, place = lesson.watch.newest, lesson.session.teacher.workplace
    assert newest is not None
    times = [moment.time for moment in lesson.moments]
    assert times == sorted(times)
    assert times[-1] > times[2] > 0
    frames = Frames(place.runner.cell.truth, place.runner.task.arm)
    np.testing.assert_array_equal(newest.moment.poses[frames.there()], frames.poses()[frames.there()])
    gaps = [moment.gap for moment in lesson.moments]
    assert gaps[2] == pytest.approx(0.0254, abs=0.002)


def test_the_panic_button_stops_the_arm_and_lines_that_come_meanwhile_are_refused(tmp_path: Path) -> None:
    lesson = Lesson.begun(tmp_path)
    assert lesson.watch.newest is not None
    tick = lesson.watch.newest.tick

    def meanwhile(period: Any) -> None:
        tick(period)
        if not lesson.all("refused"):
            lesson.link.say("open 3")
        else:
            lesson.link.press()

    lesson.watch.newest.tick = meanwhile  # type: ignore[method-assign]  # somebody at a page, while the arm moves
    lesson.go(("table x -5", "quit"))
    assert lesson.all("refused") == ["`open 3` was refused: while the arm moves, only the panic button works"]
    assert "stopped by the panic button; the brakes are set" in lesson.all("answer")


def test_nobody_leaves_unsaved_names_unasked(tmp_path: Path) -> None:
    lesson = Lesson.begun(tmp_path)
    lesson.go(("here FIRST", "quit", "quit"))
    assert lesson.all("answer")[-2:] == [
        "not saved: FIRST; `save` saves them, and a second `quit` leaves without saving",
        "",
    ]
    assert not (tmp_path / "job.toml").exists()


def test_the_page_has_a_button_for_each_way(lesson: Lesson) -> None:
    assert lesson.watch.newest is not None
    page = teaching_page(lesson.session.teacher, lesson.watch.newest).decode()
    for line in ("FRAME x +", "FRAME turn z -", "j3 +", "j6 -", "close", "float"):
        assert f'value="{line}"' in page


def test_text_of_the_file_is_data(lesson: Lesson, tmp_path: Path) -> None:
    text = "# <script>alert(1)</script>\n[positions]\n"
    teacher = Teacher(workplace=lesson.session.teacher.workplace, file=tmp_path / "x.toml", saved=text)
    assert "<script" not in taught_markup(teacher)


@pytest.mark.parametrize("words", [("--demo",), ("kept",), ("--out", "x")])
def test_teaching_carries_out_no_plan(command: Command, words: tuple[str, ...]) -> None:
    code, _, err = command("view", "--teach", "job.al", *words)
    assert (code, "--teach runs no plan" in err) == (2, True)
