"""Texts to try the language on: programs that are there, programs from random words, and programs spoiled."""

import re
from pathlib import Path

from hypothesis import strategies as st

from handeye.al.instructions import INSTRUCTIONS
from handeye.core.codes import CODES

ROOT = Path(__file__).parents[2]
PUMP = (ROOT / "plans" / "water_pump.al").read_text(encoding="utf-8")
BLOCK = re.compile(r"^```al\n(.*?)^```$", re.MULTILINE | re.DOTALL)
WRITTEN = [
    text
    for folder in (ROOT / "docs", ROOT / "tests" / "al")
    for file in sorted(folder.rglob("*.md"))
    for text in BLOCK.findall(file.read_text(encoding="utf-8"))
]
"""Every program of the manuals."""
CORPUS = [
    *(file.read_text(encoding="utf-8") for file in sorted((ROOT / "plans").glob("*.al"))),
    *WRITTEN,
    *(code.example for code in CODES.values()),
]

WORDS = [
    *INSTRUCTIONS,
    "DEFINE M",
    "DEFINE M S",
    "M",
    "S",
    "{S}",
    "T",
    "L:",
    "L",
    "BASE",
    "LEVEL",
    "NIL",
    "X",
    "Z,-1",
    "2,X,Y",
    "OF",
    "[0 0 -1]",
    "[0 0 0 0 0 0]",
    "1",
    "-.5",
]
ODD = [
    "[",
    "]",
    '"',
    '"a b"',
    ";",
    ";note",
    ":",
    "1e999",
    "nan",
    "1.2.3",
    ",",
    "\t",
    "\r",
    "\x0c",
    "é",
    "\x00",
    "open",
]
lines = st.lists(st.sampled_from([*WORDS, *ODD]), max_size=6).map(" ".join)
programs = st.lists(lines, max_size=12).map("\n".join)


@st.composite
def spoiled(draw: st.DrawFn, texts: list[str]) -> str:
    """One of the texts, in which up to three pieces are taken out, put in, or replaced."""
    text = draw(st.sampled_from(texts))
    for _ in range(draw(st.integers(1, 3))):
        start = draw(st.integers(0, len(text)))
        length = draw(st.sampled_from([0, 0, 1, 2, 8, 80]))
        piece = draw(st.sampled_from([*WORDS, *ODD, "", " ", "\n", "\n\n"]))
        text = text[:start] + piece + text[start + length :]
    return text


texts = st.one_of(st.text(max_size=200), programs, spoiled(WRITTEN))
