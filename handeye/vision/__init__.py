"""Vision: the three primitives of 1973 as a public interface, and what is built on them."""

from handeye.vision.beam import beams
from handeye.vision.blob import BoundingBox, localise
from handeye.vision.characteriser import Blob, characterise
from handeye.vision.edge import BRIGHTER, DARKER, Edges
from handeye.vision.scan import Scan

__all__ = ["BRIGHTER", "DARKER", "Blob", "BoundingBox", "Edges", "Scan", "beams", "characterise", "localise"]
