"""Hidden seeds of the agents' bench: their file, and their published hash, which shows that the seeds have not been
changed.
"""

import hashlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Final

import msgspec

from handeye.core.errors import BadFile
from handeye.core.files import read_whole
from handeye.core.variation import Seed

_LARGEST: Final = 1 << 20  # bytes of a file of hidden seeds


class HiddenSeeds(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The file of hidden seeds, which is not in the repository."""

    salt: Annotated[str, msgspec.Meta(min_length=16)]
    seeds: Mapping[str, list[Seed]]  # by task


def read_hidden(path: Path) -> HiddenSeeds:
    """Read a file of hidden seeds. Raises BadFile if the file cannot be used."""
    try:
        return msgspec.json.decode(read_whole(path, _LARGEST), type=HiddenSeeds)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise BadFile(f"{path} is not a file of hidden seeds: {error}") from None


def commitment(salt: str, task: str, seeds: Sequence[int]) -> str:
    """Return the SHA-256 of the hidden seeds of a task. The salt keeps short lists from being guessed."""
    return hashlib.sha256(f"{salt}:{task}:{','.join(map(str, seeds))}".encode()).hexdigest()
