"""Finds the base with the usual methods of OpenCV: a threshold and connected components, or the blob detector."""

import math
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array
from handeye.ports.camera import Picture
from handeye.program.program import Part
from handeye.vision.blob import BoundingBox
from handeye.vision.camera_model import View
from handeye.vision.characteriser import Blob
from handeye.vision.hole_search import Candidate, classify

LEVEL: Final = 17
"""Grey value that stands for one of the picture's 16 levels."""
LEAST: Final = 20
"""Least number of points of a connected component that may be a hole. Noise makes many smaller ones."""


def largest_component(picture: Picture, window: Array) -> BoundingBox | None:
    """Return the box around the largest connected part of the window that is brighter than Otsu's threshold."""
    mask = np.zeros(picture.shape, np.uint8)
    cv2.fillConvexPoly(mask, np.rint(window).astype(np.int32), 255)
    threshold, _ = cv2.threshold(_grey(picture)[mask > 0], 0, 255, cv2.THRESH_OTSU)
    bright = ((_grey(picture) > threshold) & (mask > 0)).astype(np.uint8)
    count, _, found, _ = cv2.connectedComponentsWithStats(bright)
    if count < 2:
        return None
    left, top, width, height, _ = map(int, found[1 + found[1:, cv2.CC_STAT_AREA].argmax()])
    return BoundingBox(left, top, left + width - 1, top + height - 1)


def holes_by_components(picture: Picture, view: View, part: Part, box: BoundingBox) -> Array | None:
    """Return the centres (u, v) of the two large holes, shape (2, 2), from the connected parts darker than Otsu's
    threshold.
    """
    grey = _grey(picture)[box.top : box.bottom, box.left : box.right]
    _, dark = cv2.threshold(grey, 0, 1, cv2.THRESH_BINARY_INV | cv2.THRESH_OTSU)
    _, _, found, centres = cv2.connectedComponentsWithStats(dark)
    large = found[:, cv2.CC_STAT_AREA] > LEAST
    sizes = np.sqrt(found[large, cv2.CC_STAT_AREA] * (4 / math.pi))
    return _pair(centres[large] + (box.left, box.top), sizes, view, part)


def holes_by_blob_detector(picture: Picture, view: View, part: Part, box: BoundingBox) -> Array | None:
    """Return the same centres, found by SimpleBlobDetector, whose parameters give the size and roundness of the
    holes.
    """
    across, down = view.resolution(view.back_project(box.corners().mean(axis=0), part.at[2] + part.face)[0])
    areas = [math.pi / 4 * hole.diameter**2 * across * down for hole in part.holes[:2]]
    how = cv2.SimpleBlobDetector.Params()
    how.filterByColor, how.blobColor = True, 0
    how.filterByArea, how.minArea, how.maxArea = True, 0.5 * min(areas), 1.7 * max(areas)
    how.filterByCircularity, how.filterByInertia, how.filterByConvexity = False, True, False
    how.minInertiaRatio = 0.3
    grey = _grey(picture)[box.top : box.bottom, box.left : box.right]
    found = cv2.SimpleBlobDetector.create(how).detect(grey)
    centres = np.array([point.pt for point in found]).reshape(-1, 2)
    return _pair(
        centres + np.array([box.left, box.top]), np.array([point.size for point in found]), view, part
    )


def _grey(picture: Picture) -> NDArray[np.uint8]:
    return picture * np.uint8(LEVEL)


def _pair(centres: NDArray[Any], sizes: NDArray[Any], view: View, part: Part) -> Array | None:
    """Return the two candidates that handeye's own classifier accepts as the part's holes. `sizes` are in points."""
    z = part.at[2] + part.face
    found = []
    for (u, v), size in zip(centres.tolist(), sizes.tolist(), strict=True):
        place = view.back_project(np.array([u, v]), z)[0]
        metres = size / math.sqrt(math.prod(view.resolution(place)))
        blob = Blob(u=u, v=v, width=size, height=size, bounces=0)
        found.append(Candidate(blob, float(place[0]), float(place[1]), metres))
    pair = classify(found, part)
    return np.array([[candidate.blob.u, candidate.blob.v] for candidate in pair]) if pair else None
