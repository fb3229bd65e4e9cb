"""Write the figures of docs/ten_milliseconds.md, and its picture, which shows the page of `handeye ml touch --page`.

python docs/make_ten_milliseconds.py [--figures]

The picture needs Chromium, as `python3 run.py test browser` does; with `--figures` it stays as it is.
"""

import re
import sys
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "support")]

from handeye.systems.ml.bench.touch import BANDWIDTH, PERIOD, Touch, worst  # noqa: E402
from handeye.systems.ml.bench.touches import (  # noqa: E402
    BANDWIDTHS,
    FORCE,
    PERIODS,
    SPEEDS,
    fastest,
    swept,
    touches_page,
)

PAGE = ROOT / "docs" / "ten_milliseconds.md"
PICTURE = ROOT / "docs" / "pictures" / "ten_milliseconds.webp"
WIDTH, HEIGHT = 1200, 1010


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


def figures() -> dict[str, str]:
    """The tables of the page, by their names in its comments."""
    by_period = {(p, v): worst(p, BANDWIDTH, v) for p in PERIODS for v in SPEEDS}
    by_servo = {(f, v): worst(PERIOD, f, v) for f in BANDWIDTHS for v in SPEEDS}
    return {
        "ways": table(
            ["period", *(f"{v:g} mm/s" for v in SPEEDS)],
            ([f"{p} ms", *(f"{by_period[p, v].way:.2f}" for v in SPEEDS)] for p in PERIODS),
        ),
        "forces": table(
            ["period", *(f"{v:g} mm/s" for v in SPEEDS), f"fastest for {FORCE:g} N"],
            (
                [
                    f"{p} ms",
                    *(f"{by_period[p, v].force:.1f}" for v in SPEEDS),
                    f"{fastest(p, BANDWIDTH):.0f} mm/s",
                ]
                for p in PERIODS
            ),
        ),
        "servos": table(
            ["servo", *(f"{v:g} mm/s" for v in SPEEDS)],
            ([f"{f:g} Hz", *(_both(by_servo[f, v]) for v in SPEEDS)] for f in BANDWIDTHS),
        ),
        "law": f"{max(each.way / each.bound - 1 for each in (*by_period.values(), *by_servo.values())):.0%}",
    }


def _both(touch: Touch) -> str:
    return f"{touch.way:.2f} mm, {touch.jolt:.1f} N{' (trips)' if touch.trips else ''}"


def written(text: str, found: dict[str, str]) -> str:
    """The text of the page with these figures between the comments with their names."""
    for name, figure in found.items():
        text, count = re.subn(
            rf"(<!-- {name} -->)(\n?).*?\n?(<!-- /{name} -->)",
            lambda match, figure=figure: f"{match[1]}{match[2]}{figure}{match[2]}{match[3]}",
            text,
            flags=re.DOTALL,
        )
        if count != 1:
            raise ValueError(f"the page has no place for {name}")
    return text


def photograph() -> None:
    """Save the page of touches as it opens."""
    import cv2
    import numpy as np
    from chromium import Browser

    with tempfile.TemporaryDirectory() as folder, Browser.started(Path(folder) / "profile") as browser:
        file = Path(folder) / "touches.html"
        file.write_bytes(touches_page(swept()))
        points = browser.page(file, width=WIDTH, height=HEIGHT).screenshot()
    cv2.imwrite(
        str(PICTURE),
        cv2.imdecode(np.frombuffer(points, np.uint8), cv2.IMREAD_COLOR),
        [cv2.IMWRITE_WEBP_QUALITY, 85],
    )


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8"), figures()), encoding="utf-8")
    if "--figures" not in sys.argv[1:]:
        photograph()
