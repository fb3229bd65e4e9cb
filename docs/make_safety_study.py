"""Writes the table of docs/safety_study.md, from collisions of the two arms of SUPERSIGMA; the text is written by hand.

python docs/make_safety_study.py
"""

import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

from handeye.systems.sigma.gantries.crash import page_table  # noqa: E402

PAGE = ROOT / "docs" / "safety_study.md"
BEGIN, END = "<!-- Below: docs/make_safety_study.py -->\n", "<!-- Above: docs/make_safety_study.py -->\n"


def page(table: str) -> str:
    """The whole page with this table."""
    above, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    return f"{above}{BEGIN}\n{table}\n{END}{rest.partition(END)[2]}"


if __name__ == "__main__":
    PAGE.write_text(page(page_table()), encoding="utf-8")
