"""Builds the part of a page that shows the tables of a machine at any cycle."""

from pathlib import Path
from typing import Any, Final

from handeye.core.markup import Markup, PagePart, element, lines, note, section
from handeye.report.page.document import packed as embedded
from handeye.report.page.moments import json_markup
from handeye.systems.ml.dashboard.history import Head, History, packed
from handeye.systems.ml.dashboard.layout import line_labels, segments
from handeye.systems.ml.dashboard.text import table

_OPEN: Final = ("MT", "ST")
_SHOWN: Final = "tables.shown();\n"


def tables_part(done: History) -> PagePart:
    """Return the section of a report with the tables of a finished run. In a browser without scripts, the section shows
    the tables of motors and sensors after the last cycle.
    """
    plain = element(
        "div",
        *(lines(table(done, done.find(name), done.last)) for name in _OPEN),
        id="tables-plain",
    )
    content = section(
        "tables",
        "The tables, cycle by cycle",
        note(
            "Everything that MOS knew is in these tables. Words that changed in the cycle are highlighted, and a "
            "sensor whose flag is on is red. Click a word to plot its values over time; click the time line to go to a "
            "cycle."
        ),
        dashboard(),
        plain,
        facts(done.head, picked=_moving(done)),
        embedded("tables-record", packed(done)),
    )
    return PagePart(content, style=own_file("dashboard.css"), script=own_file("dashboard.js") + _SHOWN)


def dashboard(*more: Markup) -> Markup:
    """Return the elements that the script fills."""
    steps = [
        ("first", "|◀", "first cycle"),
        ("back", "◀", "one cycle back"),
        ("on", "▶", "one cycle forward"),
        ("last", "▶|", "end"),
    ]
    cycle = element(
        "input", id="tables-cycle", type="range", min="0", max="1", step="1", value="0", aria_label="cycle"
    )  # fmt: skip
    stand = element(
        "p",
        element("output", id="tables-now", for_="tables-cycle"),
        element("code", id="tables-statement", title="the statement that was being executed"),
        class_="stand",
    )
    word = element(
        "div",
        element("span", id="tables-picked"),
        element("output", id="tables-value"),
        element("button", "◀ change", id="tables-before", type="button"),
        element("button", "change ▶", id="tables-after", type="button"),
        *more,
        class_="of-word",
    )
    drawing = {"role": "img", "preserveAspectRatio": "none"}
    return element(
        "div",
        element("div", *(_button(*each) for each in steps), cycle, class_="controls"),
        stand,
        element(
            "svg",
            id="tables-strip",
            aria_label="when flags were on, and when motions were under way",
            **drawing,
        ),
        word,
        element("svg", id="tables-plot", aria_label="the values of a word over time", **drawing),
        element("div", id="tables-names", role="group", aria_label="tables", class_="names"),
        element("div", id="tables-panels", class_="panels"),
        id="tables-live",
        class_="tables",
        hidden=True,
    )


def _button(name: str, shown: str, label: str) -> Markup:
    return element("button", shown, id=f"tables-{name}", type="button", title=label, aria_label=label)


def facts(head: Head, *, picked: int | None) -> Markup:
    """Return what the script needs to know about the machine and its program. `picked` is the word whose values are
    plotted at first.
    """
    tables = segments(head.sides)
    data: dict[str, Any] = {
        "segments": [
            {
                "table": each.table, "side": each.side, "base": each.base, "title": each.shape.title,
                "lines": each.shape.lines, "words": each.shape.words, "names": each.names,
                "labels": {str(line): label for line, label in line_labels(each.side, each.table).items()},
            }
            for each in tables
        ],
        "open": [f"{each.table} {each.side}".strip() for each in tables if each.table in _OPEN],
        "statements": {str(number): text for number, text in head.statements.items()},
        "last": head.cycles - 1, "arms": len(head.sides), "picked": picked,
    }  # fmt: skip
    return element("script", json_markup(data), id="tables-facts", type="application/json")


def _moving(done: History) -> int:
    """Find the motor that has moved in the most cycles, and return the number of the word that has this motor's
    position.
    """
    motors = done.find("MT")
    positions = [motors.number(line, 1) for line in range(1, motors.shape.lines + 1)]
    return max(
        positions, key=lambda number: len(done.courses[number].cycles) if number in done.courses else 0
    )


def own_file(name: str) -> str:
    """Return the content of a file in this folder. Pages contain this content unchanged."""
    return Path(__file__).with_name(name).read_text(encoding="utf-8")
