"""Pictures drawn without a scene, so that their content is known exactly."""

import math

import cv2
import numpy as np

from handeye.core.units import DEGREE, INCH
from handeye.ports.camera import COLUMNS, ROWS, Picture
from handeye.program.program import Hole, Part
from handeye.tasks.water_pump.world.nominal import DRAWING
from handeye.vision.camera_model import View
from handeye.vision.hole_search import hole_places

DARK, BRIGHT, BELT, PLATE, FACE, HOLE, GASKET = 3, 11, 3, 6, 12, 4, 4
"""Intensity levels of the drawn surfaces."""
FINE = 4
"""Samples for a picture point, along and across."""


def part(yaw: float = 90 * DEGREE) -> Part:
    """The pump base on the belt."""
    angles = [a * DEGREE for a in (50, 130, 230, 310)]
    screws = [
        Hole(x=1.6 * INCH * math.cos(a), y=1.6 * INCH * math.sin(a), diameter=0.25 * INCH) for a in angles
    ]
    return Part(
        at=(44.5 * INCH, 28 * INCH, 1 * INCH, yaw),
        face=1.75 * INCH,
        holes=(
            Hole(x=0.0, y=0.0, diameter=2.25 * INCH),
            Hole(x=2.75 * INCH, y=0.0, diameter=1.25 * INCH),
        ),
        screw_holes=tuple(screws),
        region=(3 * INCH, 5 * INCH),
        outline=(-2.275 * INCH, -2.5 * INCH, 4.225 * INCH, 2.5 * INCH),
    )


def view(lens: float, point: tuple[float, float, float]) -> View:
    """The camera as drawn, aimed at a point."""
    return DRAWING.view(lens, *DRAWING.aim(point, lens))


class Canvas:
    """A picture under construction; colours are levels."""

    def __init__(self, level: float = BELT) -> None:
        self.fine = np.full((ROWS * FINE, COLUMNS * FINE), level, dtype=np.float32)

    def polygon(self, uv: np.ndarray, level: float) -> None:
        points = np.rint(((uv + 0.5) * FINE - 0.5) * 16).astype(np.int32)
        cv2.fillPoly(self.fine, [points], level, shift=4)

    def disc(self, where: View, centre: np.ndarray, diameter: float, level: float) -> None:
        angle = np.linspace(0, 2 * np.pi, 90, endpoint=False)
        ring = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(90)]) * diameter / 2
        self.polygon(where.project(centre + ring), level)

    def picture(
        self, rng: np.random.Generator | None = None, noise: float = 0.5, blur: float = 0.0
    ) -> Picture:
        """Return the digitised picture, with noise if a generator is given."""
        image = self.fine.reshape(ROWS, FINE, COLUMNS, FINE).mean(axis=(1, 3))
        image = cv2.GaussianBlur(image, (0, 0), blur) if blur else image
        if rng:
            image = image + rng.normal(0, noise, image.shape)
        return np.clip(np.rint(image), 0, 15).astype(np.uint8)


def draw_base(
    canvas: Canvas,
    where: View,
    base: Part,
    pose: tuple[float, float, float],
    *,
    holes: int = 2,
    screws: bool = True,
) -> None:
    """The pump base: plate on the belt, face, `holes` of the large holes, and screw holes if there are any."""
    x, y, yaw = pose
    z, top = base.at[2], base.at[2] + base.face
    c, s = math.cos(yaw), math.sin(yaw)
    x0, y0, x1, y1 = base.outline
    plate = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]) @ np.array([[c, s], [-s, c]]) + (x, y)
    canvas.polygon(where.project(np.column_stack([plate, np.full(4, z)])), PLATE)
    large = hole_places(base, pose)
    angle = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    hull = np.vstack([large[0, :2] + ring * 2.0 * INCH, large[1, :2] + ring * 1.2 * INCH]).astype(np.float32)
    outline = cv2.convexHull(hull).reshape(-1, 2)
    canvas.polygon(where.project(np.column_stack([outline, np.full(len(outline), top)])), FACE)
    shown = list(zip(large, base.holes, strict=True))[2 - holes :]
    tapped = list(zip(hole_places(base, pose, screws=True), base.screw_holes, strict=True)) if screws else []
    for place, hole in [*shown, *tapped]:
        canvas.disc(where, place, hole.diameter, HOLE)
