"""The page of the sizes of errors is made from the pump's quantities, each with a source, a bound or a test."""

import importlib.util
import re
from pathlib import Path

from handeye.tasks.water_pump.world.variation import variation

ROOT = Path(__file__).parent.parent
PAGE = ROOT / "docs" / "error_sources.md"


def test_the_page_is_what_the_quantities_say() -> None:
    spec = importlib.util.spec_from_file_location(
        "make_error_sources", ROOT / "docs" / "make_error_sources.py"
    )
    assert spec is not None
    assert spec.loader is not None
    maker = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(maker)
    assert maker.page() == PAGE.read_text(encoding="utf-8"), "run: python docs/make_error_sources.py"


def test_a_size_without_a_source_has_a_reason_and_a_bound() -> None:
    for quantity in variation().quantities.values():
        assert "placeholder" not in f"{quantity.source}{quantity.unsourced}".lower(), quantity.name
        reason, bound, _ = quantity.unsourced.replace("Tested at ", "Bound: ").partition("Bound: ")
        assert bool(reason) == bool(bound) == bool(quantity.unsourced), quantity.name


def test_every_page_gives_the_number_of_sizes_without_a_source() -> None:
    told = re.search(
        r"has (\d+) uncertain quantities. For (\d+) of these quantities.*? For (\d+) more,",
        PAGE.read_text(encoding="utf-8"),
    )
    assert told is not None
    for page in ("README.md", "docs/figures.md"):
        text = " ".join((ROOT / page).read_text(encoding="utf-8").split())
        assert re.search(
            rf"\b{told[2]} of (the )?{told[1]}\b|\b{told[1]} quantities. For {told[2]} of these\b", text
        ), page
        assert re.search(rf"\b(and {told[3]} are from our studies|For {told[3]} (more|other))\b", text), page
