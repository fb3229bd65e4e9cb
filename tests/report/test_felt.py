"""What the hand felt is shown as the program felt it: every trip where it was, within half a newton."""

import pytest
from report_pages import no_photographs, page_of, tree
from short_runs import FEEL, plan_of, traced

from handeye.core.variation import WorldSpec
from handeye.program.events import GuardTripped
from handeye.program.guards import GuardKind
from handeye.report import player
from handeye.report.animation import animation
from handeye.report.facts.felt import GuardedMotion, guarded_motions
from handeye.report.page.document import report_page
from handeye.report.recorded import RecordedRun
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint

pytestmark = pytest.mark.slow

HALF_A_NEWTON = 0.5


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    """A run that feels for the table, and then for nothing."""
    start = Checkpoint(setup=Setup(plan=plan_of(FEEL), world=WorldSpec(seed=0), camera="ray"))
    return RecordedRun(trace=traced(start, tmp_path_factory.mktemp("felt") / "run"))


@pytest.fixture(scope="module")
def motions(run: RecordedRun) -> tuple[GuardedMotion, ...]:
    return guarded_motions(run)


def test_each_guarded_motion_is_told_with_its_line_and_guard(motions: tuple[GuardedMotion, ...]) -> None:
    assert [(motion.step.line, motion.guard, motion.stage) for motion in motions] == [
        (6, GuardKind.FORCE, "feel"),
        (8, GuardKind.FORCE, "feel"),
    ]


def test_the_curve_ends_where_the_guard_tripped(run: RecordedRun, motions: tuple[GuardedMotion, ...]) -> None:
    (met,) = (event for event in run.trace.events if isinstance(event, GuardTripped))
    table = motions[0]
    assert table.trip is not None
    assert (table.trip.value, table.trip.limit) == (met.value, met.limit)
    assert table.times[-1] == pytest.approx(table.trip.time, abs=1 / 60)
    assert table.values[-1] == pytest.approx(met.value, abs=HALF_A_NEWTON)
    assert (table.values[:-1] <= table.limit).all()


def test_a_guard_that_was_not_met_has_no_trip(motions: tuple[GuardedMotion, ...]) -> None:
    free = motions[1]
    assert free.trip is None
    assert free.values.max() < free.limit


def test_the_page_says_of_each_what_came_of_it(run: RecordedRun) -> None:
    said = [figure.all("span")[-1].text for figure in tree(page_of(run)).one("felt").all("figure")]
    assert said[0].endswith("limit 11.1 N (40 oz)")
    assert said[1].startswith("not stopped: ")


def test_what_the_player_needs_is_in_the_page_and_let_in(run: RecordedRun) -> None:
    page = tree(report_page(run, no_photographs(run), animation(run)).decode())
    packed = [
        node.attributes["id"]
        for node in page.all("script")
        if "octet-stream" in (node.attributes.get("type") or "")
    ]
    scripts = [node for node in page.all("script") if "type" not in node.attributes]
    (policy,) = (
        meta.attributes["content"] or "" for meta in page.all("meta") if "http-equiv" in meta.attributes
    )
    assert packed == ["scene", "tracks"]
    assert scripts[0].text == player.script()
    assert policy.count("'sha256-") == len(scripts) + 1


def test_a_plan_of_few_steps_without_pictures_gives_a_page(run: RecordedRun) -> None:
    page = tree(page_of(run))
    assert page.all("h1")[0].text == "The program finished."
    assert "took no picture" in page.one("seen").text
