"""The recorded runs of the gallery: each can be shown, is listed, and is small."""

from pathlib import Path

import pytest
from conftest import Command

from docs.website.staging import links, recordings
from handeye.core import resources

ROOT = Path(__file__).parent.parent
GALLERY = "docs/gallery.md"
OWN = ROOT / "docs" / "recordings"
NAMES = ("dismantling", "doubled_gasket", "four_languages", "palletiser", "rail_support", "silent_failure")


def test_the_gallery_links_to_every_recorded_run() -> None:
    linked = set(links((ROOT / GALLERY).read_text(encoding="utf-8"), GALLERY))
    runs = {run.relative_to(ROOT).as_posix() for run in recordings(ROOT)}
    assert runs <= linked
    assert {Path(run).name for run in runs} == {"demo", *resources.recorded(), *NAMES}


def test_the_recordings_outside_the_package_are_small() -> None:
    sizes = {name: sum(file.stat().st_size for file in (OWN / name).iterdir()) for name in NAMES}
    assert max(sizes.values()) < 800_000
    assert sum(sizes.values()) < 3_500_000


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("four_languages", "The pump is assembled."),
        ("palletiser", "Palletise: right"),
        ("silent_failure", "The program reported success, but the pin is not right."),
    ],
)
def test_a_recorded_run_becomes_the_page_that_the_gallery_promises(
    command: Command, name: str, said: str
) -> None:
    assert command("report", str(OWN / name), "-o", "page.html")[0] == 0
    assert f"<h1>{said}</h1>" in Path("page.html").read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("doubled_gasket", "THE GASKET LIES TOO HIGH"),
        ("dismantling", "undone"),
        ("rail_support", "the program finished"),
    ],
)
def test_a_recorded_run_can_be_read_and_fits_the_scene_of_today(name: str, said: str) -> None:
    """Its page takes seconds to write. `python3 run.py docs` writes it."""
    from handeye.cli.reports import read_recorded
    from handeye.report.recorded import check_scene

    run = read_recorded(OWN / name)
    assert run.whole
    check_scene(run)
    assert run.result is not None
    assert said in run.result.message
