"""Write docs/mal_words.md from the table of MAL's words."""

from pathlib import Path
from typing import Final

from handeye.systems.sigma.mal.codes import CODES
from handeye.systems.sigma.mal.words import MAL_DEVICES, WORDS
from handeye.systems.sigma.protocol import AXES

PAGE: Final = Path(__file__).parent / "mal_words.md"
TITLES: Final = {
    "statement": "Statements",
    "part": "Parts of statements",
    "function": "Functions",
    "operator": "Operators",
}
HEAD: Final = """# The words of MAL

A line consists of a number from 1 to 99999 and a statement. In the forms below, you may leave out what is in `[ ]`
and repeat what is in `{ }`; `(A|B)` means one of the two. A name consists of letters, digits and `_`, and begins with
a letter. All characters of a name are significant, but capitals and small letters are the same in MAL. A variable
holds a number, which is 0 until you set it. There are no arrays. [MAL](mal.md) is the tutorial;
`handeye sigma words MOVE` explains a word in a terminal.

`docs/make_mal_words.py` writes this page from the table that the parser reads.
"""


def page() -> str:
    """The page."""
    out = [HEAD]
    for kind, title in TITLES.items():
        rows = [word for word in WORDS.values() if word.kind == kind]
        out += [f"## {title}\n", "| form | |", "|---|---|"]
        out += [f"| `{word.usage}` | {word.help} |".replace("(TO|BY)", "(TO\\|BY)") for word in rows]
        out.append("")
    out += ["## Axes and devices\n", f"Axes: {', '.join(f'`{axis}`' for axis in AXES)}.", ""]
    out += [f"Devices: {', '.join(f'`{name}`' for name in MAL_DEVICES)}.", ""]
    out += [
        "## Mistakes\n",
        "`handeye explain CODE` shows an example.\n",
        "| code | | cure |",
        "|---|---|---|",
    ]
    out += [f"| `{code}` | {each.severity}: {each.meaning} | {each.cure} |" for code, each in CODES.items()]
    return (
        "\n".join(out)
        .replace("expression|", "expression\\|")
        .replace("(,|;)", "(,\\|;)")
        .replace("(line|", "(line\\|")
        + "\n"
    )


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
