"""Is a picture a live camera's? Its noise makes every picture of one another, even of a scene that stands still."""

import numpy as np

from handeye.ports.camera import Picture


def blank(picture: Picture) -> bool:
    """Every point has the same intensity."""
    return bool(picture.min() == picture.max())


def repeated(picture: Picture, earlier: Picture) -> bool:
    """Two pictures are the same, point by point."""
    return np.array_equal(picture, earlier)
