"""Draw hidden seeds for tasks of the agents' bench, and write their SHA-256 into the files of the tasks.

python docs/make_hidden_seeds.py FILE [TASK ...]

FILE is where the seeds are written; it must not be in the repository. Without a TASK, all tasks get new seeds.
"""

import re
import secrets
import sys
from pathlib import Path
from typing import Final

import msgspec

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

from handeye.agents.bench_task import bench_task, bench_tasks  # noqa: E402
from handeye.agents.hidden_seeds import commitment  # noqa: E402
from handeye.core.variation import LARGEST_SEED  # noqa: E402

WORLDS: Final = 20
_HIDDEN: Final = re.compile(r'^hidden = ".*"\n', re.MULTILINE)


def main(file: Path, names: list[str]) -> None:
    salt = secrets.token_hex(16)
    seeds = {name: [secrets.randbelow(LARGEST_SEED + 1) for _ in range(WORLDS)] for name in names}
    for name, drawn in seeds.items():
        place = bench_task(name).folder / "task.toml"
        text = _HIDDEN.sub("", place.read_text(encoding="utf-8"))
        line = f'hidden = "{commitment(salt, name, drawn)}"\n'
        head, public, rest = text.partition("public = ")
        place.write_text(f"{head}{line}{public}{rest}", encoding="utf-8")
    file.write_bytes(msgspec.json.format(msgspec.json.encode({"salt": salt, "seeds": seeds}), indent=1))


if __name__ == "__main__":
    main(
        Path(sys.argv[1]),
        sys.argv[2:] or [name for name, task in bench_tasks().items() if not task.file.orders],
    )
