"""Materials of a scene as a page shows them: colour, gloss, and grain."""

from dataclasses import dataclass, field
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array

GRAIN: Final = 512
"""Points along a side of a grain."""
QUALITY: Final = 45
"""Quality of the WebP picture, 0 to 100."""
_MOST: Final = 128
_RGB: Final = 1
"""Where a material has its texture: MuJoCo's `mjTEXROLE_RGB`."""
_SLENDER: Final = 3.0
"""Ratio of length to width above which the grain goes along a piece."""

Row = tuple[float, ...]
"""Red, green, blue as light, 0 to 1; light of its own; how metallic; roughness; number of its grain or -1; axis of the
body (0 to 2) along which the grain goes; how often it repeats in a metre along that and across."""


@dataclass(slots=True)
class Palette:
    """Materials that the shapes of a scene have, each once."""

    model: Any
    rows: list[Row] = field(default_factory=list)
    _numbers: dict[Row, int] = field(default_factory=dict)
    _grains: list[int] = field(default_factory=list)

    def number(self, shape: int, sides: Array) -> int:
        """Number of the row of a shape that is so long along the axes of its body (m)."""
        row = (*self._colour(shape), *self._gloss(shape), *self._grain(shape, sides))
        if row not in self._numbers:
            assert len(self.rows) < _MOST, "a number of a material has seven bits"
            self._numbers[row] = len(self.rows)
            self.rows.append(row)
        return self._numbers[row]

    @property
    def grains(self) -> int:
        """How many there are."""
        return len(self._grains)

    def picture(self) -> bytes:
        """The grains as one grey WebP picture, one below the other; nothing if there is none."""
        if not self._grains:
            return b""
        grey = np.vstack([cv2.cvtColor(_texture(self.model, n), cv2.COLOR_RGB2GRAY) for n in self._grains])
        done, data = cv2.imencode(
            ".webp", cv2.cvtColor(grey, cv2.COLOR_GRAY2BGR), [cv2.IMWRITE_WEBP_QUALITY, QUALITY]
        )
        assert done
        return data.tobytes()

    def _colour(self, shape: int) -> Row:
        """Colour and light of its own; the tint of a grain goes into the colour."""
        material, texture = self.model.geom_matid[shape], self._texture_of(shape)
        screen = self.model.mat_rgba[material] if material >= 0 else self.model.geom_rgba[shape]
        colour = np.asarray(screen[:3], dtype=float)
        if texture >= 0:
            mean = _texture(self.model, texture).reshape(-1, 3).mean(axis=0)
            colour = colour * mean / mean.mean()
        own = float(self.model.mat_emission[material]) if material >= 0 else 0.0
        return (*(round(float(c) ** 2.2, 4) for c in colour), round(own, 3))

    def _gloss(self, shape: int) -> Row:
        """How metallic it is, and its roughness."""
        material = self.model.geom_matid[shape]
        if material < 0:
            return 0.0, 1.0
        told = f"gloss/{self.model.material(material).name}"
        for number in range(self.model.nnumeric):
            if self.model.numeric(number).name == told:
                metallic, roughness = self.model.numeric(number).data.tolist()
                return metallic, roughness
        specular, shininess = (
            float(self.model.mat_specular[material]),
            float(self.model.mat_shininess[material]),
        )
        return round(min(max(4 * (specular - 0.3), 0.0), 1.0), 3), round(
            1 - min(specular, 1.0) * shininess, 3
        )

    def _grain(self, shape: int, sides: Array) -> Row:
        """Number, axis, and repeats along it and across."""
        texture = self._texture_of(shape)
        if texture < 0:
            return -1.0, 0.0, 0.0, 0.0
        if texture not in self._grains:
            self._grains.append(texture)
        number, material = float(self._grains.index(texture)), self.model.geom_matid[shape]
        if self.model.mat_texuniform[material]:
            along, across = self.model.mat_texrepeat[material].tolist()
            return number, 0.0, round(along, 4), round(across, 4)
        _, middle, long = np.sort(sides)
        if long > _SLENDER * middle:
            return number, float(sides.argmax()), round(1 / long, 4), round(1 / long, 4)
        return number, 0.0, round(1 / sides[0], 4), round(1 / sides[1], 4)

    def _texture_of(self, shape: int) -> int:
        material = self.model.geom_matid[shape]
        return int(self.model.mat_texid[material, _RGB]) if material >= 0 else -1


def _texture(model: Any, number: int) -> NDArray[np.uint8]:
    """Red, green, blue, shape (GRAIN, GRAIN, 3)."""
    first, height, width = model.tex_adr[number], model.tex_height[number], model.tex_width[number]
    pixels = model.tex_data[first : first + 3 * height * width].reshape(height, width, 3)
    return np.asarray(cv2.resize(pixels, (GRAIN, GRAIN), interpolation=cv2.INTER_AREA), dtype=np.uint8)
