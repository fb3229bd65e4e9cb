"""Search pattern, camera and referee are replaced by code; what they decide is recorded, and never passed over."""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest
from msgspec import UNSET

import handeye
from handeye.api.parts import parts_of
from handeye.cell.truth import Truth
from handeye.cli import app
from handeye.core.errors import InvalidInput
from handeye.core.variation import WorldSpec
from handeye.ports.camera import Renderer
from handeye.program.events import RunStarted, SearchAdvanced
from handeye.results.kept_run import kept_run
from handeye.results.result import Check
from handeye.runs.checkpoint_file import read_head
from handeye.runs.verify import difference
from handeye.tasks import task
from handeye.vision.camera_model import View

pytestmark = pytest.mark.slow

SEARCH = "OPEN 1\nSEARCH .1\nL: OPEN 1.1\nAOJ L\nJUMP L\n"


def row(place: int) -> tuple[float, float]:
    """Places in a row along x."""
    return place, 0


def column(place: int) -> tuple[float, float]:
    """Places in a row along y."""
    return 0, place


class HalfDark:
    """A camera that sees nothing on its left."""

    def __init__(self, model: mujoco.MjModel) -> None:
        """Of a scene."""

    def render(self, data: mujoco.MjData, view: View) -> np.ndarray:
        """Light on the target."""
        return np.tile(np.arange(333) > 166, (256, 1))


def easy(truth: Truth) -> Mapping[str, handeye.Finding]:
    """Finds that nothing is too high."""
    return {"height": handeye.at_most(0.1, 1.0, "mm", "height of nothing")}


@pytest.fixture(scope="module")
def searched(tmp_path_factory: pytest.TempPathFactory) -> handeye.Run:
    """A run with a search pattern of its own, left in the midst of its search."""
    folder = tmp_path_factory.mktemp("parts") / "run"
    with handeye.begin(SEARCH, camera="ray", search=row, out=folder) as run:
        run.step(6)
    return run


def offsets(run: handeye.Run) -> list[tuple[float, float]]:
    """The places that a run searched, in steps of a tenth of an inch."""
    found = [event.offset for event in run.events if isinstance(event, SearchAdvanced)]
    return [(round(x / 0.00254, 6), round(y / 0.00254, 6)) for x, y in found]


def test_a_search_tries_the_places_it_is_given(searched: handeye.Run) -> None:
    assert offsets(searched) == [(1, 0), (2, 0)]


def test_a_run_names_the_code_that_took_the_place_of_a_part(searched: handeye.Run) -> None:
    begun, (head, *_) = searched.events[0], [*map(read_head, sorted(searched.out.rglob("*.checkpoint")))]
    assert isinstance(begun, RunStarted)
    assert searched.trace.head.replaced == begun.replaced == head.replaced == {"search": f"{__name__}.row"}
    assert searched.result.replaced == {"search": f"{__name__}.row"}
    assert f"search replaced by the calling program: {__name__}.row" in searched._repr_html_()


def test_an_ordinary_run_names_no_code(tmp_path: Path) -> None:
    with handeye.begin("OPEN 1\n", camera="ray", out=tmp_path / "run") as run:
        run.until()
    kept = [*tmp_path.rglob("events.jsonl"), *tmp_path.rglob("result.json"), *tmp_path.rglob("*.checkpoint")]
    assert len(kept) > 3
    assert [file for file in kept if re.search(rb"replaced|limits", file.read_bytes())] == []


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        (
            None,
            r"^the run uses a search of the calling program, `.*\.row`, whose code is not saved in the run; ",
        ),
        (column, r"^the run began with `.*\.row` as its search, but `.*\.column` was given$"),
    ],
)
def test_a_run_is_taken_up_with_the_code_it_was_begun_with(
    searched: handeye.Run, given: object, sentence: str
) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        handeye.begin(searched.out, search=given)
    run = handeye.begin(searched.out, search=row)
    run.step(4)
    assert offsets(run) == [(1, 0), (2, 0), (3, 0), (4, 0)]


def test_a_run_with_code_of_its_own_is_shown_with_how_python_goes_on_with_it(
    searched: handeye.Run, capsys: pytest.CaptureFixture[str]
) -> None:
    app(["show", str(searched.out)], result_action="return_value")
    told = capsys.readouterr().err
    way = f"resume the run from Python with handeye.begin('{searched.out}', search=...)"
    said = f"code of the calling program (search `{__name__}.row`); {way}"
    assert (said in " ".join(told.split()), "handeye resume" in told) == (True, False)


def test_a_run_that_is_not_taken_up_leaves_no_folder(searched: handeye.Run, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"^the run uses a search of the calling program, "):
        handeye.begin(searched.out, out=tmp_path / "again")
    assert [*tmp_path.iterdir()] == []


def test_a_run_with_code_of_its_own_is_not_verified(searched: handeye.Run, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"^the run uses a search of the calling program, "):
        difference(searched.trace, tmp_path / "again")


def test_a_part_may_be_replaced_from_a_checkpoint_on_and_the_run_says_so(tmp_path: Path) -> None:
    file = handeye.begin(SEARCH, camera="ray").checkpoint(tmp_path / "a.checkpoint")
    run = handeye.begin(file, search=column)
    run.step(4)
    assert offsets(run) == [(0, 1)]
    assert run.result.replaced == run.events[0].replaced == {"search": f"{__name__}.column"}


@pytest.mark.parametrize("wrong", [3, (1, 2, 3), ("a", "b"), (float("nan"), 0)])
def test_a_search_that_gives_no_place_is_told_and_its_step_is_not_done(wrong: object) -> None:
    run = handeye.begin(SEARCH, camera="ray", search=lambda place: wrong)
    with pytest.raises(
        InvalidInput, match=r"^the search `.*<lambda>` must return two numbers for place 1, not "
    ):
        run.until()
    assert run.state.text == "AOJ L"


def test_a_search_without_a_first_place_is_told() -> None:
    script, taught = "SEARCH .1\nL: MOVE P\nAOJ L\n", "[positions]\nP = { at = [25, 38, 6, 90, 90, 0] }\n"
    run = handeye.begin(script, taught=taught, camera="ray", search=lambda place: None)
    with pytest.raises(
        InvalidInput, match=r"^the search `.*<lambda>` must return two numbers for place 0, not None$"
    ):
        run.until()


@pytest.mark.parametrize("search", [{1: (1, 0)}.get, lambda number: next(iter([(1, 0)][number - 1 :]))])
def test_a_search_ends_where_there_are_no_more_places(
    search: Callable[[int], tuple[float, float] | None],
) -> None:
    run = handeye.begin(SEARCH, camera="ray", search=search)
    assert run.until().why.endswith("(2 places tried)")
    assert (offsets(run), run.result.error) == ([(1, 0)], 6)


def test_a_search_is_asked_once_for_each_place() -> None:
    asked: list[int] = []
    run = handeye.begin(SEARCH, camera="ray", search=lambda number: asked.append(number) or (number, 0))
    run.step(6)
    run.say("show search")
    assert asked == [1, 2]


def test_a_search_that_fails_fails_where_people_see_it() -> None:
    run = handeye.begin(SEARCH, camera="ray", search=lambda place: (1 / 0, 0))
    with pytest.raises(ZeroDivisionError):
        run.until()
    assert run.state.text == "AOJ L"


@pytest.mark.render
def test_pictures_are_those_of_the_camera_that_is_given() -> None:
    cell = task().cell(WorldSpec(seed=0), parts_of(None, HalfDark).camera)
    picture = cell.devices.camera.digitise()
    assert (picture[:, :150].mean() < 2, picture[:, 183:].mean() > 8) == (True, True)
    assert cell.renderer == Renderer(method="replaced", platform=f"{__name__}.HalfDark")


@pytest.mark.render
@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (np.zeros((333, 256)), r"of shape \(333, 256\)"),
        (np.full((256, 333), np.nan), "with some values that are not finite"),
        ("abc", "'abc'"),
        ([[1], [1, 2]], r"\[\[1\], \[1, 2\]\]"),
    ],
)
def test_what_is_no_picture_is_told_in_one_sentence(wrong: object, said: str) -> None:
    maker = parts_of(None, lambda model: SimpleNamespace(render=lambda data, view: wrong)).camera
    cell = task().cell(WorldSpec(seed=0), maker)
    sentence = rf"^the camera `.*<lambda>` must give a picture of 256 by 333 finite numbers, not {said}$"
    with pytest.raises(InvalidInput, match=sentence):
        cell.devices.camera.digitise()


def test_a_camera_that_makes_no_pictures_is_told_before_the_run() -> None:
    with pytest.raises(
        InvalidInput, match=r"^the camera `.*<lambda>` must return an object with a method `render`, not 3$"
    ):
        handeye.begin("OPEN 1\n", camera=lambda model: 3)


class Careless(HalfDark):
    """A camera that writes in everything it is given."""

    def __init__(self, model: mujoco.MjModel) -> None:
        model.opt.gravity[:] = 0
        model.body_mass[:] = 7

    def render(self, data: mujoco.MjData, view: View) -> np.ndarray:
        data.qpos[:], data.qvel[:], data.time = 1, 1, 9
        data.model.opt.timestep = 1
        return super().render(data, view)


@pytest.mark.render
def test_a_camera_cannot_change_the_run() -> None:
    cells = [task().cell(WorldSpec(seed=0), parts_of(None, made).camera) for made in (HalfDark, Careless)]
    for cell in cells:
        cell.devices.camera.digitise()
        cell.advance(1 / 60)
    assert np.array_equal(*(cell.capture().physics for cell in cells))


def test_the_result_says_whose_pictures_they_were() -> None:
    run = handeye.begin("OPEN 1\n", camera=HalfDark)
    assert run.picture is None
    assert run.result.camera.renderer == f"the caller's code ({__name__}.HalfDark)"
    assert run.result.replaced == {"camera": f"{__name__}.HalfDark"}


@pytest.fixture(scope="module")
def strict(tmp_path_factory: pytest.TempPathFactory) -> handeye.Run:
    """A run that was judged against limits of its own, and kept."""
    limits = {"base_tilt": -1, "floor": -9}
    folder = tmp_path_factory.mktemp("strict") / "run"
    return handeye.assemble(script="OPEN 1\n", camera="ray", referee=limits, out=folder)


def test_limits_of_the_referee_are_values(strict: handeye.Run) -> None:
    found = strict.result.referee
    assert (found["base_tilt"].ok, found["base_tilt"].limit, found["floor"].limit) == (False, -1, -9)
    assert (strict.result.limits, strict.result.replaced) == ({"base_tilt": -1, "floor": -9}, UNSET)


def test_a_run_that_is_taken_up_keeps_its_limits(strict: handeye.Run) -> None:
    again = handeye.begin(strict.out).result
    assert (again.limits, again.referee) == (strict.result.limits, strict.result.referee)
    assert kept_run(strict.out).result.limits == strict.result.limits


def test_the_command_line_judges_by_the_limits_of_a_run(
    strict: handeye.Run, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = handeye.begin(strict.out).checkpoint(tmp_path / "a.checkpoint")
    assert app(["resume", str(file)], result_action="return_value") == 3
    shown = " ".join(capsys.readouterr().out.split())
    assert (
        "set by the calling program: height of the lowest part above the table top: at least -9 mm" in shown
    )


@pytest.mark.parametrize(("limits", "kept"), [({"floor": 99}, {"floor": 99}), ({}, UNSET)])
def test_a_run_that_was_kept_is_judged_again(strict: handeye.Run, limits: object, kept: object) -> None:
    result = handeye.begin(strict.out, referee=limits).result
    assert (result.limits, result.referee["base_tilt"].limit) == (kept, 0.3)


def test_a_referee_of_ones_own_takes_the_place_of_limits(strict: handeye.Run, tmp_path: Path) -> None:
    run = handeye.begin(strict.out, referee=easy)
    assert (run.result.limits, run.assembled) == (UNSET, True)
    assert read_head(run.checkpoint(tmp_path / "a.checkpoint")).limits is UNSET


def test_what_a_result_keeps_of_a_finding_stands_against_another_limit() -> None:
    check = Check.of(handeye.at_most(0.3, 0.2, "mm", "gap under the head")).limited(0.5)
    assert (check.ok, check.limit, check.sentence) == (True, 0.5, "gap under the head (at most 0.5 mm)")


def test_a_referee_of_ones_own_has_the_word() -> None:
    run = handeye.begin("OPEN 1\n", camera="ray", referee=easy)
    assert run.assembled is None
    run.until()
    assert (run.assembled, [*run.result.referee]) == (True, ["height"])


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (
            {"search": 3},
            r"^a search must be a function that takes a whole number and returns the place with this number; 3 is "
            r"not a function$",
        ),
        (
            {"camera": 3},
            r"^a camera must be `auto`, `gl`, `ray` or a function that takes a scene; 3 is none of these$",
        ),
        (
            {"referee": 3},
            r"^a referee must be either a table of limits or a function that takes the true state of a cell, not 3$",
        ),
        (
            {"referee": {"screws_clmp": 3}},
            r"^the referee has no finding `screws_clmp`; did you mean `screws_clamp`\?$",
        ),
        ({"referee": {3: 3}}, r"^a limit must have the name of a finding as its key, not 3$"),
        ({"referee": {"screws_clamp": "x"}}, r"^the limit of screws_clamp must be a number, not 'x'$"),
    ],
)
def test_what_is_no_part_is_told_in_one_sentence(words: dict[str, object], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        handeye.begin("OPEN 1\n", **{"camera": "ray", **words})


@pytest.mark.parametrize("wrong", [{"height": 3}, {3: handeye.at_most(1, 2, "mm", "height")}, 3])
def test_a_referee_that_finds_nothing_that_is_a_finding_is_told(wrong: object) -> None:
    run = handeye.begin("OPEN 1\n", camera="ray", referee=lambda truth: wrong)
    run.until()
    with pytest.raises(
        InvalidInput, match=r"^the referee `.*<lambda>` must return a dictionary from names to findings, not "
    ):
        run.result  # noqa: B018
