"""Builds the report page of a taught job (findings, block poses and program), and writes the job's files to the
folder of its run.
"""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import msgspec

from handeye.core.errors import BadFile
from handeye.core.files import read_whole
from handeye.core.markup import Markup, element, joined, note, section
from handeye.core.plain_text import counted
from handeye.report.page.document import MARK, head, resource
from handeye.report.page.plots import Scale, dot, drawing, rule, words
from handeye.report.page.referee import findings_table
from handeye.results.result import restore_figures
from handeye.runs.folder import REPORT
from handeye.systems.trig import ENTRY
from handeye.systems.trig.jobs.benches import BlockPose
from handeye.systems.trig.language.display import full_display, partial_display
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.language.storage import decoded, encoded, read_program
from handeye.systems.trig.language.styled import plain
from handeye.systems.trig.run.job import JobReport, Outcome

Point = tuple[float, float]

VERDICTS: Final[dict[Outcome, str]] = {
    "right": "right",
    "stopped": "the arm has stopped",
    "silent": "done, but the referee disagrees",
    "halted": "interrupted",
}
_SIDE: Final = 30.0  # mm, side of a block
_COLUMNS: Final = 110  # characters of a program line
_WIDE, _HIGH, _BOTTOM = 960.0, 330.0, 325.0
_PLATTER: Final = (0.0, 300.0)
_PANELS: Final = ((350.0, 635.0), (675.0, 960.0))  # left and right ends of the drawings
_RINGS: Final = (5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05)  # mm
_MIN_REACH: Final = 0.1  # mm


def job_page(done: JobReport, program: TrigProgram) -> bytes:
    title = f"{done.job.capitalize()}: {VERDICTS[done.outcome]}"
    ends = (element("p", f"{told[:1].upper()}{told[1:]}.") for told in done.told)
    body = element(
        "body",
        element("header", element("h1", title), class_=None if done.outcome == "right" else "failed"),
        element("main", note(_facts(done)), *ends, *_sections(done, program)),
    )
    page = element("html", head(title, resource("page.css"), []), body, lang="en")
    return f"{MARK}{page}\n".encode()


def _facts(done: JobReport) -> str:
    blocks = "" if done.blocks is None else f", with {counted(done.blocks, 'block')}"
    world = f"TRIG, on the Purbrick arm in the world of {done.world or f'seed {done.seed}'}{blocks}"
    return f"{world}; {done.arm_s:,.0f} s of simulated time, including teaching."


def _sections(done: JobReport, program: TrigProgram) -> Iterator[Markup]:
    yield section("blocks", "Positions of the blocks", *_blocks(done))
    for name, after, checks in (
        ("ended", "after the program", done.checks),
        ("undone", "after the undo", done.checks_back),
    ):
        if checks:
            findings = findings_table(checks.values(), f"findings {after}")
            yield section(name, f"Measurements of the referee {after}", findings)
    rows = max(1, len(program.graph.nodes))
    displays = [show(program, _COLUMNS, rows) for show in (full_display, partial_display)]
    texts = (joined((plain([line]) for line in lines), Markup("\n")) for lines in displays)
    yield section("program", "The program", *(element("pre", text, tabindex="0") for text in texts))


# -- where the blocks lay --------------------------------------------------------------------------------


def _blocks(done: JobReport) -> Iterator[Markup]:
    above = (
        "The true scene, seen from above. Neither the arm nor the program sees it. Outlines show the wanted and "
        "the actual places of the blocks, numbered in the order of grasping. A cross marks the centre of the "
        "platter."
    )
    off = " The chart on the right shows the centre of each block, relative to its wanted place."
    yield note(above + (off if _placed(done) or done.checks_back else ""))
    yield element("figure", _drawn(done), class_="chart")


def _placed(done: JobReport) -> list[Point]:
    """Return the placement errors of the blocks (mm). The list is empty if the referee did not judge the placed
    blocks.
    """
    return _off(done.lying.get("run", ()), done.goals) if "placed" in done.checks else []


def _drawn(done: JobReport) -> Markup:
    taught = done.lying.get("taught", ())
    back = _off(done.lying.get("undone", ()), [lying.at[:2] for lying in taught]) if done.checks_back else []
    limit = done.checks["placed"].limit if "placed" in done.checks else None
    return drawing(
        *_platter(done),
        *_scatter("placed", _placed(done), limit, _PANELS[0]),
        *_scatter("taken back, seen from above", back, None, _PANELS[1]),
        wide=_WIDE,
        high=_HIGH,
        label="The blocks seen from above, and their position errors after they were placed and after they were put "
        "back",
    )


def _off(lying: Sequence[BlockPose], wanted: Sequence[Point]) -> list[Point]:
    """Return the position errors of blocks relative to their goals (mm)."""
    return [(one.at[0] - x, one.at[1] - y) for one, (x, y) in zip(lying, wanted, strict=False)]


def _platter(done: JobReport) -> Iterator[Markup]:
    """Draw the platter seen from above, with X to the right and Y up."""
    shown = done.lying.get("run", ())
    points = [*done.goals, *(each.at[:2] for each in (*shown, *done.lying.get("taught", ()))), (0.0, 0.0)]
    (west, east), (south, north) = ((min(along), max(along)) for along in zip(*points, strict=True))
    half = max(east - west, north - south) / 2 + _SIDE
    x, y = (west + east) / 2, (south + north) / 2
    xs = Scale(x - half, x + half, *_PLATTER)
    ys = Scale(y - half, y + half, _BOTTOM, _BOTTOM - (_PLATTER[1] - _PLATTER[0]))
    yield words(_PLATTER[0], 12, "after the program" if done.checks else "when the program was interrupted")
    yield rule(xs(-4), ys(0), xs(4), ys(0), class_="axis")
    yield rule(xs(0), ys(-4), xs(0), ys(4), class_="axis")
    for x, y in done.goals:
        yield _square(xs, ys, (x, y), 0.0, "outline")
    for lying in done.lying.get("taught", ()):
        yield _square(xs, ys, lying.at[:2], lying.turned, "outline")
    for number, lying in sorted(enumerate(shown, 1), key=lambda numbered: numbered[1].at[2]):
        x, y, _ = lying.at
        yield _square(xs, ys, (x, y), lying.turned, "block")
        yield words(xs(x), ys(y) + 3.5, str(number), anchor="middle")


def _square(xs: Scale, ys: Scale, at: Point, turned: float, class_: str) -> Markup:
    turns = (math.radians(turned + 45 + 90 * corner) for corner in range(4))
    out = _SIDE / math.sqrt(2)
    corners = ((at[0] + out * math.cos(turn), at[1] + out * math.sin(turn)) for turn in turns)
    points = " ".join(f"{xs(x):.1f},{ys(y):.1f}" for x, y in corners)
    return element("polygon", points=points, class_=class_)


def _scatter(title: str, off: Sequence[Point], limit: float | None, panel: Point) -> Iterator[Markup]:
    """Draw the position errors of the blocks seen from above (mm)."""
    if not off:
        return
    most = max(math.hypot(*each) for each in off)
    reach = max(1.5 * most, _MIN_REACH)
    xs = Scale(-reach, reach, *panel)
    ys = Scale(-reach, reach, _BOTTOM, _BOTTOM - (panel[1] - panel[0]))
    told = "" if limit is None else f"; the limit is {limit:g} mm"
    yield words(panel[0], 12, f"{title}: at most {most:.2f} mm off{told}")
    yield rule(xs(-reach), ys(0), xs(reach), ys(0), class_="axis")
    yield rule(xs(0), ys(-reach), xs(0), ys(reach), class_="axis")
    for radius, class_ in ((next(ring for ring in _RINGS if ring < reach), "ring-of"), (limit, "boundary")):
        if radius is not None and radius < reach:
            size = f"{xs(radius) - xs(0):.1f}"
            yield element("circle", cx=f"{xs(0):.1f}", cy=f"{ys(0):.1f}", r=size, class_=class_)
            yield words(xs(0) + 4, ys(-radius) - 4, f"{radius:g} mm")
    for number, (x, y) in enumerate(off, 1):
        yield dot(xs(x), ys(y), 2.5, class_="moved")
        yield words(xs(x) + 4, ys(y) - 3, str(number))


JOB, TAUGHT = ENTRY.files  # the job's account, and its program
_LARGEST: Final = 1_000_000  # bytes; the account of a job with twenty blocks takes ten thousand
_MAX_MEASURE: Final = 1e6  # mm and degrees


def job_files(done: JobReport, program: TrigProgram) -> dict[str, bytes]:
    taught = encoded(program)
    return {
        JOB: msgspec.json.format(msgspec.json.encode(done), indent=1) + b"\n",
        TAUGHT: taught,
        REPORT: job_page(done, decoded(taught, TAUGHT)),  # as `kept_job_page` makes it
    }


def kept_job_page(path: Path) -> bytes | None:
    """Rebuild the report of a job from the folder of its run. Returns None if the folder has no finished job."""
    if not (path / JOB).is_file():
        return None
    return job_page(_read_account(path / JOB), read_program(path / TAUGHT))


def _read_account(path: Path) -> JobReport:
    try:
        written = msgspec.json.decode(read_whole(path, _LARGEST))
        for name in ("checks", "checks_back") if isinstance(written, dict) else ():
            restore_figures(written.get(name))
        done = msgspec.convert(written, JobReport)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{path} is not a record of a job: {error}") from None
    lying = [
        figure for blocks in done.lying.values() for each in blocks for figure in (*each.at, each.turned)
    ]
    if any(abs(figure) > _MAX_MEASURE for figure in (*lying, *(x for goal in done.goals for x in goal))):
        raise BadFile(f"{path} is not a record of a job: a block is impossibly far away")
    return done
