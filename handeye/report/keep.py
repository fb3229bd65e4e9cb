"""What a run leaves in a folder: plan, events, pictures, result."""

from collections.abc import Iterable, Mapping
from pathlib import Path

import cv2

from handeye.errors import InvalidInput
from handeye.files import write_whole
from handeye.plan.plan import Plan, encode
from handeye.report.result import Result, to_json
from handeye.work.events import Event, to_line
from handeye.work.run import Shot


def keep(
    folder: Path, plan: Plan, events: Iterable[Event], shots: Mapping[str, Shot], result: Result
) -> None:  # fmt: skip
    """Write `plan.json`, `events.jsonl`, `pictures/*.png` and `result.json`, each whole or not at all.

    Raises:
        InvalidInput: the folder cannot be made or written to.
    """
    try:
        (folder / "pictures").mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidInput(f"{folder} cannot be made: {error.strerror}") from None
    write_whole(folder / "plan.json", encode(plan).encode())
    write_whole(folder / "events.jsonl", b"".join(to_line(event) for event in events))
    for name, shot in shots.items():
        enlarged = cv2.resize(shot.picture * 17, None, fx=3, fy=3, interpolation=cv2.INTER_NEAREST)
        done, data = cv2.imencode(".png", enlarged)
        assert done
        write_whole(folder / "pictures" / f"{name.lower()}.png", data.tobytes())
    write_whole(folder / "result.json", to_json(result))
