"""A beam along a line or column of the picture, point by point: faster than arrays for a single beam."""

from handeye.vision.edge import SPAN, Edge, Polarity
from handeye.vision.scan import Scan


def walk(
    scan: Scan,
    start: tuple[float, float],
    direction: tuple[int, int],
    polarity: Polarity,
    step: float,
    reach: float,
    *,
    wide: bool = False,
    beyond: float = 0.0,
) -> Edge | None:
    """The first discontinuity, or None; arguments as for `beams`, `direction` along a line or column."""
    scan.beams += 1
    u, v, (du, dv) = round(start[0]), round(start[1]), direction
    back, ahead = scan.run(u, v, du, dv)
    low, high = max(1 - SPAN, -back), min(int(reach) + SPAN - 1, ahead)
    if high - low + 1 < 2 * SPAN:
        return None
    stride, first = dv * scan.columns + du, v * scan.columns + u + low * (dv * scan.columns + du)
    beside = (-1, 0, 1) if wide else (0,)
    starts = [first + k * (1 if dv else scan.columns) for k in beside]
    line = scan.summed(starts, high - low + 1, stride)
    scale = SPAN * len(starts)
    met, best = _first(line, polarity, step * scale, beyond * scale)
    scan.account_lines(starts, min(met + 3 * SPAN, len(line)), stride)
    if best is None:
        return None
    length = low + best + SPAN - 0.5 + _vertex(line, polarity, best)
    before = sum(line[best : best + SPAN]) / scale
    after = sum(line[best + SPAN : best + 2 * SPAN]) / scale
    return Edge(u + length * du, v + length * dv, before, after, length)


def _first(line: list[float], polarity: Polarity, step: float, beyond: float) -> tuple[int, int | None]:
    """Where a line first rises by `step`, and where near there it rises most; its end and None if nowhere.

    Rises that lead to less than `beyond` are skipped.
    """
    rise, places = _rise(line, 0), len(line) - 2 * SPAN + 1
    entering = [*line[2 * SPAN :], 0.0]  # none enters behind the last place
    for i, (left, passed, entered) in enumerate(zip(line, line[SPAN:], entering, strict=False)):
        if polarity * rise >= step:
            near = [polarity * _rise(line, k) for k in range(i, min(i + SPAN + 1, places))]
            best = i + near.index(max(near))
            if sum(line[best + SPAN : best + 2 * SPAN]) >= beyond:
                return i, best
        rise += left - 2 * passed + entered
    return len(line), None


def _rise(line: list[float], i: int) -> float:
    """The sum of SPAN points minus that of the SPAN points before, from `i`."""
    return sum(line[i + SPAN : i + 2 * SPAN]) - sum(line[i : i + SPAN])


def _vertex(line: list[float], polarity: Polarity, i: int) -> float:
    """Vertex of the parabola through the rises about `i`, from -.5 to .5."""
    if not 0 < i < len(line) - 2 * SPAN:
        return 0.0
    left, top, right = (polarity * _rise(line, k) for k in (i - 1, i, i + 1))
    bend = left - 2 * top + right
    return min(max((left - right) / (2 * bend), -0.5), 0.5) if bend < 0 else 0.0
