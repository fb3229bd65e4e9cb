"""What machines sensed on channels of their own: each component of a channel against time."""

import numpy as np

from handeye.core.markup import Markup, element, note, section
from handeye.report.page.plots import HIGH, WIDE, Scale, curve, drawing, rule, words
from handeye.trace.replay import ChannelCurve
from handeye.trace.trace import Trace

_TOP, _BOTTOM = 14.0, HIGH - 16.0


def channels_section(trace: Trace) -> Markup:
    """The section; nothing where no machine has a channel."""
    if not trace.channels:
        return Markup("")
    figures = (_figure(channel, trace.head.time) for channel in trace.channels)
    about = note("What machines sensed besides where their axes were, in the course of the run.")
    return section("channels", "Channels of the machines", about, element("div", *figures, class_="figures"))


def _figure(channel: ChannelCurve, begun: float) -> Markup:
    times, values = channel.times - begun, channel.values
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
