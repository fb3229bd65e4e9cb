"""Writes the tables of docs/table1.md; the text is written by hand.

python docs/make_table1.py
"""

import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

from handeye.systems.sigma.table1 import page_tables, table1  # noqa: E402

PAGE = ROOT / "docs" / "table1.md"
BEGIN, END = "<!-- Below: docs/make_table1.py -->\n", "<!-- Above: docs/make_table1.py -->\n"


def page(tables: str) -> str:
    """The whole page with these tables."""
    above, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    return f"{above}{BEGIN}\n{tables}\n{END}{rest.partition(END)[2]}"


if __name__ == "__main__":
    PAGE.write_text(page(page_tables(table1())), encoding="utf-8")
