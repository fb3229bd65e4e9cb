"""Plots quantities over time: forces at the hand in guarded motions, and the machines' own channels."""

from collections.abc import Iterable, Iterator, Sequence
from enum import StrEnum
from itertools import groupby

import numpy as np

from handeye.core.markup import Markup, element, joined, note, section, to_moment
from handeye.core.plain_text import counted, one_line
from handeye.program.guards import GuardKind
from handeye.report.facts.felt import GuardedMotion
from handeye.report.page.figures import exact_clock, felt
from handeye.report.page.plots import HIGH, WIDE, Scale, curve, dot, drawing, rule, words
from handeye.trace.replay import ChannelCurve
from handeye.trace.thinning import FELT
from handeye.trace.trace import Trace

_TOP, _BOTTOM = 14.0, HIGH - 16.0


class How(StrEnum):
    """Sentences that explain how a trace records forces."""

    RECORDED = ""
    THINNED = (
        f" This trace is thinned: the curves differ from the original curves by at most {FELT[GuardKind.FORCE]:g} N "
        f"and {FELT[GuardKind.MOMENT]:g} N m, and have the same maximum."
    )


def felt_section(motions: Sequence[GuardedMotion], *, how: How, lost: int, failed: bool = False) -> Markup:
    """Return the section on forces, with a collapsible part for each stage.

    Args:
        lost: number of guards that tripped before the trace begins.
        failed: True if the run failed. The part for the last stage is then expanded.
    """
    return section("felt", "What the hand felt", *_content(motions, how=how, lost=lost, failed=failed))


def _content(motions: Sequence[GuardedMotion], *, how: How, lost: int, failed: bool) -> Iterator[Markup]:
    if lost:
        yield note(
            f"{counted(lost, 'guard')} tripped before this trace begins. Forces before that time were not recorded."
        )
    if not motions:
        if not lost:
            yield note(
                "No motion of this run had a guard (a limit of force or torque that stops the motion)."
            )
        return
    met = sum(motion.trip is not None for motion in motions)
    yield note(
        f"{counted(len(motions), 'guarded motion')}; a guard stopped {met} of them. Each curve is the guarded "
        "quantity: the force of the hand along an axis, a moment, or the torque of the screwdriver. The dashed line "
        f"is the limit; the dot is where the guard tripped and ended the motion.{how} Click a figure to go to "
        "that motion in the run."
    )
    stages = [(stage, list(those)) for stage, those in groupby(motions, lambda motion: motion.stage)]
    for number, (stage, those) in enumerate(stages):
        yield _stage(stage, those, shown=len(stages) == 1 or (failed and number == len(stages) - 1))


def _stage(stage: str, motions: Sequence[GuardedMotion], *, shown: bool) -> Markup:
    """Return the plots of a stage. The plots are collapsed if `shown` is False."""
    met = sum(motion.trip is not None for motion in motions)
    said = f"{counted(len(motions), 'guarded motion')}, {met} stopped by a guard"
    summary = element("summary", element("h3", stage), " ", element("span", said))
    figures = element("div", *map(_figure, motions), class_="figures")
    return element("details", summary, figures, open=shown, class_="stage")


def _figure(motion: GuardedMotion) -> Markup:
    """Return the plot of a guarded motion, with a link to this motion in the 3D view."""
    moment = motion.times[-1] if motion.trip is None else motion.trip.time
    when, place = exact_clock(float(moment)), motion.step.place
    statement, said = one_line(motion.step.text), _said(motion)
    told = [
        element("span", when, class_="time"),
        element("b", place),
        element("code", statement),
        element("span", said),
    ]
    caption = to_moment(float(moment), joined(told, " "), class_="moment")
    return element("figure", _drawn(motion), element("figcaption", caption))


def _said(motion: GuardedMotion) -> str:
    """Return words that say whether the guard stopped the motion."""
    limit = felt(motion.guard, motion.limit)
    if motion.trip is not None:
        return f"{_short(motion.guard, motion.trip.value)}; limit {limit}"
    known = motion.values[np.isfinite(motion.values)]
    most = _short(motion.guard, float(known.max())) if len(known) else "no estimate"
    return f"not stopped: maximum {most}; limit {limit}"


def _drawn(motion: GuardedMotion) -> Markup:
    known = np.isfinite(motion.values)
    times, values = motion.times[known], motion.values[known]
    if not len(times):
        return drawing(label="no estimate")
    highs = [float(values.max()), motion.limit, *([] if motion.trip is None else [motion.trip.value])]
    x = Scale(float(times[0]), max(float(times[-1]), float(times[0]) + 1e-9), 2.0, WIDE - 2.0)
    y = Scale(min(0.0, float(values.min())), max(highs), _BOTTOM, _TOP)
    return drawing(*_strokes(motion, times, values, x, y), label=f"line {motion.step.place}: {_said(motion)}")


def _strokes(
    motion: GuardedMotion, times: Iterable[float], values: Iterable[float], x: Scale, y: Scale
) -> Iterator[Markup]:
    yield rule(0, y(0), WIDE, y(0), class_="axis")
    yield rule(0, y(motion.limit), WIDE, y(motion.limit), class_="limit")
    yield words(2, y(motion.limit) - 3, _short(motion.guard, motion.limit), class_="limit")
    yield curve(np.array([x(t) for t in times]), np.array([y(v) for v in values]), class_="curve")
    yield words(WIDE - 2, HIGH - 4, f"{float(motion.times[-1] - motion.times[0]):.1f} s", anchor="end")
    if motion.trip is not None:
        yield dot(x(motion.trip.time), y(motion.trip.value), 3.2, class_="trip")


def _short(kind: GuardKind, limit: float) -> str:
    if kind is GuardKind.TOUCH:
        return felt(kind, limit)
    turning = kind in (GuardKind.MOMENT, GuardKind.TORQUE)
    return f"{limit:.2f} N m" if turning else f"{limit:.1f} N"


def channels_section(trace: Trace) -> Markup:
    """Return the section on machine channels. The section is empty if no machine has channels."""
    if not trace.channels:
        return Markup("")
    moving = [channel for channel in trace.channels if np.ptp(channel.values)]
    still = len(trace.channels) - len(moving)
    left_out = (
        f" {counted(still, 'channel')} that did not change {'is' if still == 1 else 'are'} left out."
        if still
        else ""
    )
    about = note(
        f"Sensor values of the machines during the run, except the positions of their axes.{left_out}"
    )
    figures = element("div", *map(_channel_figure, moving), class_="figures")
    return section("channels", "Channels of the machines", about, figures)


def _channel_figure(channel: ChannelCurve) -> Markup:
    times, values = channel.times, channel.values
    low, high = float(values.min()), float(values.max())
    x = Scale(float(times[0]), max(float(times[-1]), float(times[0]) + 1e-9), 2.0, WIDE - 2.0)
    y = Scale(min(low, 0.0), max(high, 0.0) or min(low, 0.0) + 1.0, _BOTTOM, _TOP)
    drawn = curve(np.array([x(t) for t in times]), np.array([y(v) for v in values]), class_="curve")
    lasts = words(WIDE - 2, HIGH - 4, f"{times[-1] - times[0]:.1f} s", anchor="end")
    said = f"{low:.3g} to {high:.3g} {channel.unit}".rstrip()
    figure = drawing(rule(0, y(0), WIDE, y(0), class_="axis"), drawn, lasts, label=f"{channel.name}: {said}")
    return element(
        "figure", figure, element("figcaption", element("b", channel.name), " ", element("span", said))
    )
