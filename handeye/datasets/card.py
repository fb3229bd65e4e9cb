"""The card of a data set: what the data set contains, where it comes from, and what it does not show."""
# ruff: noqa: E501 - a row of a table is a line

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Final

from handeye.core.plain_text import counted
from handeye.core.versions import HANDEYE
from handeye.datasets.episodes import OUTCOMES, Episode
from handeye.datasets.frames import RATE

CARD_BEGINS: Final = b"---\ntags:\n- LeRobot\n- handeye\n"
_HEAD: Final = """configs:
- config_name: default
  data_files: data/*/*.parquet
---

# Runs of the Stanford hand-eye assembly of 1973

"""
_BODY: Final = """
## What a frame contains

There are {rate} frames a second. Each frame belongs to one moment. `observation.*` is what the sensors read in the tenth of a second before
this moment, and `action` is what the arm did in the tenth of a second after it.

| feature | content | unit |
|---|---|---|
| `observation.state` | positions of the joints, then the opening of the fingers, as last read by the potentiometers | rad; m for the boom and the fingers |
| `observation.state_mean` | mean of the same readings over the tenth of a second before the moment | as before |
| `observation.rate` | rates of the joints, as last read by the tachometers | rad/s, m/s |
| `observation.torque` | mean torque that the servo commanded; 0 under the brakes | N m, N |
| `observation.force` | last estimate of the force and moment of the hand on its surroundings, about the tool centre point, in the axes of the table | N, N m |
| `observation.force_mean` | mean of these estimates over the tenth of a second before the moment | N, N m |
| `observation.force_share` | fraction of the servo periods in which force was estimated. The program estimates force only in guarded and compliant motions; elsewhere, the force is 0 and means nothing | |
| `observation.picture_age` | time since the last television picture was taken; -1 before the first one | s |
| `action` | positions at the end of the next frame, as the sensors will read them | rad, m |
| `annotation.stage`, `annotation.instruction` | stage and instruction of the arm program that make the action; empty between two instructions | |
| `annotation.outcome` | outcome of the whole episode | |
| `next.done`, `next.success` | true in the last frame; success only if the outcome is `right` | |
{pictures}{view}
`meta/handeye.jsonl` has a line for each episode: its world, so that the run can be repeated, its outcome, the stage in which it stopped,
what the referee found wrong, and the versions of the programs.

## What it does not show

- The runs are simulated. No measurement compares them with a real arm.
- The demonstrator is a program that uses sensors only; it is not optimal. The state of the parts is not in the data{seen}.
- While the brakes hold the arm, the sensors are read at most four times a second; the frames then repeat the last reading.
- The finger switches and the torque of the screwdriver are recorded only while a guard watches them, so they are not in the data.
- The outcome of an episode is known only at its end. A policy must not be given `annotation.outcome` as an observation.
- Runs with an intervention list it in `meta/handeye.jsonl`.
"""
_VIEW: Final = """| `privileged.images.view` | view of the camera `{view}` of the scene, rendered from the recorded poses at the moment of the frame, 240 by 320 points. **The robot has no such sensor.** The view shows the true places of the parts, so a policy that uses it is privileged. The view is a video that is compressed with loss | |
"""
_PICTURES: Final = """| `observation.images.television` | the last picture of the television camera, 256 by 333 points, and a black column. Each of the 16 levels is 17 times its number, so the highest is 255. The pictures are stored without loss | |
"""


def card(episodes: Sequence[Episode], frames: int, *, pictures: bool, view: str | None) -> bytes:
    """Return the card as a Markdown file. `view` is the camera of the rendered view, if there is one."""
    body = _BODY.format(
        rate=RATE,
        pictures=_PICTURES if pictures else "",
        view=_VIEW.format(view=view) if view else "",
        seen=", except in the rendered view" if view else "",
    )
    return CARD_BEGINS + (_HEAD + "\n".join(_contents(episodes, frames)) + "\n" + body).encode()


def _contents(episodes: Sequence[Episode], frames: int) -> Iterator[str]:
    yield f"{counted(len(episodes), 'episode')}, {counted(frames, 'frame')} ({frames / RATE / 3600:.2f} h), made by handeye {HANDEYE}."
    yield "Failures are included and marked:"
    yield ""
    yield "| outcome | episodes | meaning |"
    yield "|---|---|---|"
    numbers = Counter(each.outcome for each in episodes)
    yield from (f"| `{name}` | {numbers[name]} | {meaning} |" for name, meaning in OUTCOMES.items())
    yield ""
    programs = Counter((each.task, each.program) for each in episodes)
    for (task, program), number in sorted(programs.items()):
        yield f"- {counted(number, 'episode')} of the task `{task}` with the program `{program}`"
    faults = sum(bool(each.world.faults) for each in episodes)
    yield f"- {counted(faults, 'episode')} in a world with an injected fault"
    levels = sorted({each.world.level for each in episodes})
    yield f"- error levels of the worlds: {', '.join(levels)}"
