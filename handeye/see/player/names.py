"""Names of bodies and of parts of the world as people read them."""

import re
from typing import Any


def body_name(name: str) -> str:
    """The name of a body in words: `pin 0`, `stanford link 3`."""
    group, _, own = name.rpartition("/")
    words = re.sub(r"(?<=[a-z])(?=\d)", " ", own).replace("_", " ")
    return f"{group} {words}" if group else words


def part_name(model: Any, shape: int) -> str:
    """The name of a shape of the world in words, without its number; of one without a name, what it is made of."""
    material = model.geom_matid[shape]
    called = model.geom(shape).name or (model.material(material).name if material >= 0 else "something")
    return body_name(called.rstrip("0123456789"))
