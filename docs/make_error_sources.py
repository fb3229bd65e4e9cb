"""Write the tables in docs/error_sources.md from the pump's quantities; the text above them is written by hand.

python docs/make_error_sources.py
"""

import re
import sys
from collections.abc import Iterator
from itertools import groupby, takewhile
from pathlib import Path
from typing import Final

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

from handeye.core.variation import Quantity, WorldSpec  # noqa: E402
from handeye.results.world_page import how, report  # noqa: E402
from handeye.tasks.water_pump.world.variation import variation  # noqa: E402

PAGE: Final = ROOT / "docs" / "error_sources.md"
OURS: Final = re.compile(r"\bstudy\b|\bour notes\b|\binferred from\b", re.IGNORECASE)
"""How the source of a size says that the size comes from the project itself."""
MARK: Final = "<!-- Below: docs/make_error_sources.py -->\n"


def page() -> str:
    """The page with new tables."""
    return PAGE.read_text(encoding="utf-8").partition(MARK)[0] + MARK + "".join(_tables())


def _tables() -> Iterator[str]:
    table = variation()
    world = table.draw(WorldSpec(seed=0))
    told = {quantity.name: how(quantity) for quantity in report(table, world).quantities}
    there = list(table.present({}).values())
    without = [quantity for quantity in there if quantity.unsourced]
    ours = [quantity for quantity in there if not quantity.unsourced and OURS.search(quantity.source)]
    rest = [quantity for quantity in there if not quantity.unsourced and quantity not in ours]
    yield (
        f"\nThe world of a pump has {len(there)} uncertain quantities. For {len(without)} of these quantities, no "
        f"source gives the size of the error. For {len(ours)} more, the size comes from a study of ours, from our "
        f"notes, or from an inference of ours. For the other {len(rest)}, the size comes from a document, or needs "
        "no source.\n"
    )
    yield "\n## Without a source\n\n| quantities | size | what | why there is none, and a bound |\n|---|---|---|---|\n"
    for those in _rows(without):
        yield f"| {_names(those)} | {_sizes(those, told)} | {those[0].source} | {_sentence(those[0].unsourced)} |\n"
    yield "\n## From a study or an inference of ours\n\nNo document gives these sizes. The [studies](studies.md) mark "
    yield "each of their sizes as chosen, as fitted to a figure of 1973, or as a placeholder.\n"
    yield from _sourced(ours, told)
    yield "\n## From a document, or with a size that needs no source\n"
    yield from _sourced(rest, told)


def _sourced(quantities: list[Quantity], told: dict[str, str]) -> Iterator[str]:
    yield "\n| quantities | size | what, and where from |\n|---|---|---|\n"
    for those in _rows(quantities):
        yield f"| {_names(those)} | {_sizes(those, told)} | {those[0].source} |\n"


def _rows(quantities: list[Quantity]) -> Iterator[list[Quantity]]:
    for _, those in groupby(quantities, lambda quantity: (quantity.source, quantity.unsourced)):
        yield list(those)


def _names(those: list[Quantity]) -> str:
    """The group of some quantities and how many they are, or the name of a single one."""
    if len(those) == 1:
        return f"`{those[0].name}`"
    words = zip(*(quantity.name.split(".") for quantity in those), strict=False)
    common = [each[0] for each in takewhile(lambda each: len({*each}) == 1, words)]
    return f"`{'.'.join(common)}`, {len(those)}"


def _sizes(those: list[Quantity], told: dict[str, str]) -> str:
    return "; ".join(dict.fromkeys(told[quantity.name] for quantity in those))


def _sentence(text: str) -> str:
    return text[0].upper() + text[1:]


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
