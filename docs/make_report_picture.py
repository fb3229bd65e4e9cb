"""Make the picture of docs/report.md: the page of `handeye report --demo` in a browser.

python docs/make_report_picture.py

It needs OpenGL, and Chromium, as `python3 run.py test browser` does.
"""

import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "support")]

from chromium import Browser  # noqa: E402

from handeye.cli.reports import write_report  # noqa: E402
from handeye.core.resources import demo  # noqa: E402

PICTURE = ROOT / "docs" / "pictures" / "report.webp"
WIDTH, HEIGHT = 1360, 1330
MOMENT = 150
"""s after the run began: the second pin goes into its hole."""
VIEW = "work"


def screenshot(page: Path, folder: Path) -> bytes:
    """Save the top of a report, at one moment of its replay, as a PNG file."""
    with Browser.started(folder / "profile") as browser:
        seen = browser.page(page, width=WIDTH, height=HEIGHT)
        seen.wait("document.querySelector('#run.drawn') !== null")
        seen.evaluate(f"document.querySelector('#views [value={VIEW}]').click()")
        seen.evaluate(f"time.value = {MOMENT}; time.dispatchEvent(new Event('input'))")
        seen.evaluate("view.player.settled()")
        return seen.screenshot()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.html"
        write_report(demo(), report, overwrite=False)
        points = cv2.imdecode(np.frombuffer(screenshot(report, Path(folder)), np.uint8), cv2.IMREAD_COLOR)
    cv2.imwrite(str(PICTURE), points, [cv2.IMWRITE_WEBP_QUALITY, 80])
