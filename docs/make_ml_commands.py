"""Write docs/ml_commands.md from what handeye knows of ML's commands, tables and mistakes."""

from pathlib import Path
from typing import Final

from handeye.systems.ml.errors import MEANINGS
from handeye.systems.ml.language.codes import CODES, SYMBOLIC
from handeye.systems.ml.language.commands import COMMANDS
from handeye.systems.ml.tables.layout import SHAPES

PAGE: Final = Path(__file__).parent / "ml_commands.md"
TITLES: Final = {
    "control": "Control", "flow": "Flow", "motion": "Motion", "sense": "Sensors", "data": "Data",
    "arithmetic": "Arithmetic", "edit": "Editing", "test": "Tests of the hardware", "host": "Host",
}  # fmt: skip
HEAD: Final = """# The commands of ML

A line consists of an optional sequence number from 1 to 5000, a command, and 0 to 15 parameters. A line with a
sequence number is stored; a line without one is executed immediately. A parameter is a number from -32768 to 32767, or
a reference to a variable: `&17` is the value of variable 17, `-&17` is the negative of this value, and `&&17` is the
value of the variable whose number is in variable 17. There are 256 variables. A reference can have up to six `&`. A
line that begins with `*` is a remark.

In the forms below, you may leave out what is in `[ ]`, and `...` means that you may repeat the parameter before the
dots. `n` is the number of a statement, `v` and `w` are numbers of variables, `m` is the number of a motor, and `s` is
the number of a sensor. `t` is the name of a table, and `f` is the name of a file. `x` and `y` are values. The unit of
positions is .001 inch for motors 2, 3, 4 and 11, and .01 degree for motors 1, 8, 9, 10 and 12.

[ML](ml.md) is the tutorial; `handeye ml words MOVE` explains a command in a terminal. `docs/make_ml_commands.py`
writes this page from the tables that the parser and the interpreter use.
"""


def page() -> str:
    """The page."""
    out = [HEAD]
    for category, title in TITLES.items():
        rows = [each for each in COMMANDS.values() if each.category == category and each.code not in SHAPES]
        out += [f"## {title}\n", "| form | | example |", "|---|---|---|"]
        out += [f"| `{each.form}` | {each.help} | `{each.example}` |" for each in rows]
        out.append("")
    out += [
        "## Tables\n",
        "The name of a table is also a command, which shows the table. `MT` shows every line that has a word other "
        "than 0, `MT 3` shows line 3 with the names of its words, and `MT 3 1` shows word 1 of this line. GET and "
        "QUERY read words of a table; PUT and FILE write words of a table. Internal tables are in main memory, "
        "where the real-time level uses them. External tables are on the disk; a page of such a table is brought "
        "into main memory when the page is needed.\n",
        "| table | contents | lines | words | |",
        "|---|---|---|---|---|",
    ]
    for name, shape in SHAPES.items():
        words = ", ".join(shape.names) if len(shape.names) == shape.words else ""
        where = "internal" if shape.internal else "external"
        out.append(
            f"| `{name}` | {shape.title} | {shape.lines} | {shape.words} | {where}{': ' if words else ''}{words} |"
        )
    out += [
        "",
        "## Mistakes\n",
        "The checker finds these mistakes before a program runs. `handeye explain CODE` shows an example.\n",
        "| code | | cure |",
        "|---|---|---|",
    ]
    known = {**CODES, **SYMBOLIC}
    out += [f"| `{code}` | {each.severity}: {each.meaning} | {each.cure} |" for code, each in known.items()]
    out += [
        "",
        "The errors below stop a running program. Like every error in a running program, each of these errors is "
        "an emergency: all motors freeze, and the pump is switched off.\n",
        "| code | |",
        "|---|---|",
    ]
    out += [f"| `{code}` | {meaning} |" for code, meaning in MEANINGS.items() if code not in CODES]
    return "\n".join(out) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
