"""Builds the section with the camera's pictures and what vision found in them."""

import struct
import zlib
from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from handeye.core.markup import Markup, data_address, element, note, section, to_moment
from handeye.core.plain_text import counted
from handeye.core.units import MILLIMETRE
from handeye.ports.camera import Picture
from handeye.program.diagnosis.cause_text import error_sentence
from handeye.program.events import ErrorRaised
from handeye.report.facts.seen import Finding, SeenPicture
from handeye.report.page.figures import clock
from handeye.trace.sentences import sentence
from handeye.vision.marks import Colour, Disc, Line, Loop, Mark


def seen_section(pictures: Sequence[SeenPicture], *, lost: int) -> Markup:
    """Return the section with the camera's pictures. `lost` is the number of pictures that the trace does not
    contain."""
    return section("seen", "What the camera saw", *_content(pictures, lost))


def _content(pictures: Sequence[SeenPicture], lost: int) -> Iterator[Markup]:
    if lost:
        yield note(
            f"{counted(lost, 'picture')} {'was' if lost == 1 else 'were'} taken before this trace begins."
        )
    if not pictures:
        yield note("No other picture was taken." if lost else "This run took no picture.")
        return
    rows, columns = pictures[0].picture.shape
    yield note(
        f"Each picture is shown exactly as the program received it: {columns} x {rows} pixels in 16 grey levels. "
        "The features that the program detected are drawn over the picture."
    )
    box = element("input", type="checkbox", id="marks", checked=True, aria_keyshortcuts="m")
    yield element(
        "p", element("label", box, " show detected features ", element("kbd", "m")), class_="switch"
    )
    yield element("div", *map(_figure, pictures), class_="pictures")


def _figure(seen: SeenPicture) -> Markup:
    return figure(seen, to_moment(seen.time, f"{seen.name}, {clock(seen.time)}"))


def figure(seen: SeenPicture, name: str) -> Markup:
    """Return a picture with its name. What vision found is drawn over the picture, and described below it."""
    png = data_address("image/png", picture_png(seen.picture))
    rows, columns = seen.picture.shape
    told = [_told(finding) for finding in seen.findings]
    image = element("img", src=png, alt=f"picture {seen.name}", width=columns, height=rows)
    drawn = element(
        "svg",
        *(_mark(mark) for mark in seen.marks),
        viewBox=f"0 0 {columns} {rows}",
        preserveAspectRatio="none",
        class_="marks",
        aria_hidden="true",
    )
    caption = element(
        "figcaption",
        element("b", name),
        f" through the {seen.lens / MILLIMETRE:.0f} mm lens",
        *(element("span", line) for line in told),
    )
    return element(
        "figure", element("div", image, drawn, class_="picture"), caption, data_time=f"{seen.time:.2f}"
    )


def _told(finding: Finding) -> str:
    """Describe in a sentence what vision found, or why it found nothing."""
    if isinstance(finding, ErrorRaised):
        return f"error {finding.number}: {error_sentence(finding.number, finding.cause)}"
    return sentence(finding)


def _mark(mark: Mark) -> Markup:
    """Return a mark as SVG. In a picture, the origin of the coordinates is the centre of the first pixel. In SVG, it
    is the corner of that pixel, so the mark is shifted by half a pixel.
    """
    match mark:
        case Loop():
            points = " ".join(f"{u + 0.5:.2f},{v + 0.5:.2f}" for u, v in mark.points)
            return element("polygon", points=points, stroke=_colour(mark.colour))
        case Line():
            (u1, v1), (u2, v2) = ((f"{u + 0.5:.2f}", f"{v + 0.5:.2f}") for u, v in mark.ends)
            return element("line", x1=u1, y1=v1, x2=u2, y2=v2, stroke=_colour(mark.colour))
        case Disc():
            (u, v), radius = mark.centre, mark.diameter / 2
            return element(
                "circle",
                cx=f"{u + 0.5:.2f}",
                cy=f"{v + 0.5:.2f}",
                r=f"{radius:.2f}",
                fill=_colour(mark.colour),
            )


def _colour(colour: Colour) -> str:
    return "#" + "".join(f"{level:02x}" for level in colour)


_BEGIN: Final = b"\x89PNG\r\n\x1a\n"
_GREY: Final = 0
_BITS: Final = 4


def picture_png(picture: Picture) -> bytes:
    """Encode a picture as a grey PNG file with four bits per pixel and unchanged grey levels."""
    height, width = picture.shape
    head = struct.pack(">IIBBBBB", width, height, _BITS, _GREY, 0, 0, 0)
    return (
        _BEGIN
        + _chunk(b"IHDR", head)
        + _chunk(b"IDAT", zlib.compress(_lines(picture), 9))
        + _chunk(b"IEND", b"")
    )


def _lines(picture: Picture) -> bytes:
    """Return the lines of a picture as PNG stores them, with two pixels per byte. Before each line is a byte with the
    number of the line's filter, which is 0, for no filter.
    """
    even = np.pad(picture, ((0, 0), (0, picture.shape[1] % 2)))
    packed = (even[:, ::2] << 4 | even[:, 1::2]).astype(np.uint8)
    return np.pad(packed, ((0, 0), (1, 0))).tobytes()


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
