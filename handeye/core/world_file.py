"""Files that hold one world: the values of its quantities, and the seed of its noise."""

from pathlib import Path
from typing import Final, Literal

import msgspec

from handeye.core.errors import BadFile, Refused
from handeye.core.files import Kind, read_whole, write_over
from handeye.core.record import Record
from handeye.core.variation import WorldSpec

WORLD_FILE: Final = Kind("world", rb'\{\s*"format":\s*"handeye world"')
_LARGEST: Final = 1 << 20  # bytes: fifty times the size of a world in which every quantity is set


class WorldFile(Record, frozen=True, kw_only=True):
    """The content of a file with a world."""

    format: Literal["handeye world"] = "handeye world"
    version: Literal[1] = 1
    task: str
    about: str = ""  # what was found in this world
    world: WorldSpec


def write_world(path: Path, file: WorldFile) -> None:
    """Write a world to a file, completely or not at all. Raises InvalidInput if the file cannot be written, or if it
    exists and does not hold a world.
    """
    write_over(path, msgspec.json.format(msgspec.json.encode(file), indent=1) + b"\n", WORLD_FILE)


def read_world(path: Path) -> WorldFile:
    """Read a world from a file. Raises InvalidInput if the file holds no world. `Variation.check`, not this function,
    checks that the task has the quantities that the file names.
    """
    try:
        file = msgspec.json.decode(read_whole(path, _LARGEST), type=WorldFile)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{path} does not hold a world: {error}") from None
    if file.world.faults:
        raise Refused(f"{path} holds faults, which a file of a world cannot have; use --fault")
    return file
