"""Write the tables of the pages about SUPERSIGMA, from simulations; the text around them is written by hand.

python docs/make_sigma_tables.py [NAME ...]

NAME is `safety_study` (collisions of the two arms) or `table1` (table 1 of the paper); without one, the command makes
all.
"""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Final

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

from handeye.systems.sigma import table1  # noqa: E402
from handeye.systems.sigma.gantries import crash  # noqa: E402

BEGIN, END = "<!-- Below: docs/make_sigma_tables.py -->\n", "<!-- Above: docs/make_sigma_tables.py -->\n"
TABLES: Final[dict[str, Callable[[], str]]] = {
    "safety_study": crash.page_tables,
    "table1": lambda: table1.page_tables(table1.table1()),
}
"""What makes the tables of each page."""


def place(name: str) -> Path:
    """The file of a page."""
    return ROOT / "docs" / f"{name}.md"


def page(name: str, tables: str) -> str:
    """The whole page with these tables."""
    above, _, rest = place(name).read_text(encoding="utf-8").partition(BEGIN)
    return f"{above}{BEGIN}\n{tables}\n{END}{rest.partition(END)[2]}"


if __name__ == "__main__":
    for name in sys.argv[1:] or TABLES:
        place(name).write_text(page(name, TABLES[name]()), encoding="utf-8")
