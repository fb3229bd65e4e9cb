"""Vision: the three primitives of 1973 as a public interface, and the functions built on them.

Each name is imported when it is first used, because a plan needs only the camera model and none of the primitives.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from handeye.vision.beam import BRIGHTER, DARKER, Edges
    from handeye.vision.blob import BoundingBox
    from handeye.vision.characteriser import Blob
    from handeye.vision.door import beams, characterise, localise
    from handeye.vision.scan import Scan

__all__ = ["BRIGHTER", "DARKER", "Blob", "BoundingBox", "Edges", "Scan", "beams", "characterise", "localise"]

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        if name in __all__:
            from handeye.vision import door

            return vars(door)[name]
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
