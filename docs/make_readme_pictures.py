"""Make the README's pictures: the film, a mistake that the checker finds, a replayed run, the worth of each sense.

python docs/make_readme_pictures.py [NAME ...]

NAME is `film`, `program`, `replay` or `senses`; without one, the command makes all. Film and replay show the run of
`handeye demo` and need OpenGL. The replay also needs Chromium, as docs/make_report_picture.py does.
"""

import re
import sys
import tempfile
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Final

import cv2
import numpy as np

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "docs"), str(ROOT / "tests" / "support")]

import make_film  # noqa: E402
from make_trials import FOLDER, read  # noqa: E402
from pygments.token import Comment, Keyword, Name, Token  # noqa: E402

import handeye  # noqa: E402
from handeye.al.highlight import ArmLexer  # noqa: E402
from handeye.core.resources import demo  # noqa: E402

PICTURES = ROOT / "docs" / "pictures"
WIDTH, HEIGHT = 420, 300
HEAD: Final = f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" role="img">
<title>{{title}}</title>
<style>
text{{{{font:14px system-ui,'DejaVu Sans',Helvetica,Arial,sans-serif;fill:#1f2328}}}}
.c{{{{font:13.5px ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace;white-space:pre}}}}
.s{{{{fill:#59636e}}}}.k{{{{fill:#0550ae}}}}.b{{{{font-weight:600}}}}.bar{{{{fill:#1f5d8c}}}}.back{{{{fill:#e7ecf0}}}}
.card{{{{fill:#fff;stroke:#d1d9e0}}}}.red{{{{fill:#cf222e}}}}.wave{{{{fill:none;stroke:#cf222e;stroke-width:1.6}}}}
.says{{{{fill:#fff5f5;stroke:#cf222e}}}}
@media(prefers-color-scheme:dark){{{{text{{{{fill:#f0f6fc}}}}.s{{{{fill:#9da7b3}}}}.k{{{{fill:#79c0ff}}}}.card{{{{fill:#0d1117;stroke:#3d444d}}}}
.bar{{{{fill:#4a90c4}}}}.back{{{{fill:#21262d}}}}.red{{{{fill:#ff7b72}}}}.wave{{{{stroke:#ff7b72}}}}.says{{{{fill:#1c1214;stroke:#ff7b72}}}}}}}}
</style>
<rect class="card" x="1" y="1" width="{WIDTH - 2}" height="{HEIGHT - 2}" rx="10"/>
"""  # noqa: E501 - a rule of style a line
SCRIPT: Final = """\
        OPEN    1
        MOVE    SHELF
        CLOSE   .1      ;hold a pin
        MOVE    HOLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 0.6
        SKIPE   23      ;it went in
        WAIT    "no hole here"
"""
TAUGHT: Final = """\
[positions]
SHELF = { at = [25, 60, 22, 90, 90, 0] }
HOLE = { at = [25, 38, 3, 90, 90, 0] }
"""
LETTER, LINE, LEFT, TOP = 8.13, 22, 44, 34
"""Width of a letter of the program, height of a line, and where the lines begin: from the left and from the top."""
SENSES: Final = (
    ("all senses", "nominal-890000"), ("without touch", "without-touch"), ("without search", "without-search"),
    ("without vision", "without-vision"), ("without force", "without-force"),
)  # fmt: skip
REPLAY: Final = (72, 555, 1094, 1285)
"""The part of the report that becomes the picture: left, top, right, bottom."""


def program() -> str:
    """A program in an editor, with the diagnostic of its check."""
    try:
        handeye.plan(SCRIPT, taught=TAUGHT)
    except handeye.ScriptError as error:
        (found,) = error.diagnostics
    rows = [HEAD.format(title="A position that the arm cannot reach is found before anything moves")]
    for number, line in enumerate(SCRIPT.splitlines(), 1):
        y = TOP + LINE * (number - 1)
        rows.append(f'<text class="c s" x="16" y="{y}">{number}</text>')
        words = "".join(_coloured(line.removeprefix(" " * 8)))
        rows.append(f'<text class="c" x="{LEFT}" y="{y}">{words}</text>')
    begin, end = (LEFT + LETTER * (column - 9) for column in (found.column, found.end))
    y = TOP + LINE * (found.line - 1) + 5
    waves = " ".join("q2 -4 4 0 t4 0" for _ in range(int((end - begin) / 8)))
    rows.append(f'<path class="wave" d="M{begin:.1f} {y} {waves}"/>')
    rows.append(f'<rect class="says" x="16" y="212" width="{WIDTH - 32}" height="72" rx="6"/>')
    lines = [found.message, *re.findall(r"= (?:note: )?(.*)", found.shown)]
    for at, text in enumerate(lines):
        style = "" if at else "red b"
        rows.append(
            f'<text style="font-size:12px" class="{style}" x="26" y="{232 + 20 * at}">{escape(text)}</text>'
        )
    return "\n".join([*rows, "</svg>\n"])


def _coloured(line: str) -> Iterator[str]:
    for kind, text in ArmLexer().get_tokens(line):
        word = escape(text.rstrip("\n"))
        style = "s" if kind in Comment else "k" if kind in Keyword or kind in Name.Builtin else ""
        yield f'<tspan class="{style}">{word}</tspan>' if style and kind is not Token.Text else word


def senses() -> str:
    """How many of the first 60 worlds are assembled without a sense."""
    rows = [HEAD.format(title="Pumps assembled in 60 worlds, with all senses and without one of them")]
    rows.append('<text class="b" x="20" y="34">pumps assembled in the same 60 worlds</text>')
    for number, (label, name) in enumerate(SENSES):
        trials = read(FOLDER / f"{name}.csv").trials[:60]
        done = sum(trial["verdict"] == "assembled" for trial in trials)
        y = 60 + 46 * number
        rows.append(f'<text class="s" x="20" y="{y + 17}">{label}</text>')
        rows.append(f'<rect class="back" x="140" y="{y}" width="210" height="24" rx="3"/>')
        rows.append(
            f'<rect class="bar" x="140" y="{y}" width="{210 * done / len(trials):.1f}" height="24" rx="3"/>'
        )
        rows.append(f'<text class="b" x="362" y="{y + 17}">{done}</text>')
    return "\n".join([*rows, "</svg>\n"])


def replay() -> np.ndarray:
    """The player of a report, next to the program."""
    from make_report_picture import screenshot

    from handeye.cli.reports import write_report

    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.html"
        write_report(demo(), report, overwrite=False)
        points = cv2.imdecode(np.frombuffer(screenshot(report, Path(folder)), np.uint8), cv2.IMREAD_COLOR)
    left, top, right, bottom = REPLAY
    return cv2.resize(points[top:bottom, left:right], (420, 300), interpolation=cv2.INTER_AREA)


if __name__ == "__main__":
    for name in sys.argv[1:] or ("film", "program", "senses", "replay"):
        if name == "film":
            make_film.make(handeye.open(demo() / "trace.mcap"))
        elif name == "replay":
            cv2.imwrite(str(PICTURES / "replay.webp"), replay(), [cv2.IMWRITE_WEBP_QUALITY, 85])
        else:
            drawn = {"program": program, "senses": senses}[name]()
            (PICTURES / f"{name}.svg").write_text(drawn, encoding="utf-8")
