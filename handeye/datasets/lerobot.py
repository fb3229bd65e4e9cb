"""Writes runs as a data set of LeRobot, version 3 of its format, with the library of LeRobot.

https://github.com/huggingface/lerobot
"""

import os
import warnings
from collections.abc import Callable, Iterator, Sequence
from itertools import repeat
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import msgspec
import numpy as np
from numpy.typing import NDArray

from handeye.core.errors import MissingExtra, Refused
from handeye.core.folders import FolderKind, check_folder, fill_folder
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.datasets.card import CARD_BEGINS, card
from handeye.datasets.episodes import Episode, read_episode, runs_in
from handeye.datasets.frames import RATE, Frames, frames_of
from handeye.datasets.rendered_view import HEIGHT, rendered_view
from handeye.datasets.rendered_view import WIDTH as VIEW_WIDTH
from handeye.ports.camera import COLUMNS, ROWS, Picture
from handeye.tasks import any_task
from handeye.trace.trace import Trace

if TYPE_CHECKING:
    from handeye.datasets.encoded_image import EncodedImage

CARD: Final = "README.md"
EPISODES: Final = "meta/handeye.jsonl"
DATASET: Final = FolderKind(
    name="a data set",
    known_by=CARD,
    begins=CARD_BEGINS,
    holds=(
        CARD, "meta/*.json", "meta/*.jsonl", "meta/*.parquet", "meta/episodes/*/*.parquet", "data/*/*.parquet",
        "videos/*/*/*.mp4",
    ),
)  # fmt: skip
PICTURE: Final = "observation.images.television"
VIEW: Final = "privileged.images.view"  # not `observation`: no port of the robot gives it
WIDTH: Final = COLUMNS + 1  # even, so that LeRobot can make a video of the images: the last one is black
LEVEL: Final = 17  # of 255, for each of the 15 levels above black
_WRITERS: Final = 2  # threads that write the images of the frames
_BACKEND: Final = "pyav"  # LeRobot would look for others, and warn if they lack the libraries of FFmpeg
_WRENCH: Final = ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")


class WrittenDataset(Record, frozen=True, kw_only=True):
    """A record of a data set that was written."""

    path: str
    episodes: int
    frames: int
    outcomes: dict[str, int]  # number of episodes by outcome


def write_dataset(
    path: Path,
    places: Sequence[Path],
    *,
    pictures: bool = True,
    view: str | None = None,
    overwrite: bool = False,
    progress: Callable[[int, int], None] = lambda *_: None,
) -> WrittenDataset:
    """Write the runs in the folders `places` as a data set. The folder `path` of the data set is written completely or
    not at all.

    Args:
        places: folders of runs, or folders that contain such folders.
        pictures: include the television pictures, as images without loss.
        view: camera of the scene; its view is rendered for each frame, and included as a video. The video is compressed
            with loss.
        progress: called before each run, with its number (from 1) and the number of runs.

    Raises:
        InvalidInput: the library is missing, a run cannot be used, or the folder cannot be written.
    """
    check_folder(path, DATASET, overwrite=overwrite)
    runs, library = runs_in(places), _library()
    written: list[WrittenDataset] = []

    def fill(new: Path) -> None:
        written.append(_fill(new, runs, library, path, pictures, view, progress))

    fill_folder(path, fill)
    return written[0]


def _library() -> Any:
    """Return the data set class of LeRobot. Raises MissingExtra if the library is missing."""
    os.environ.setdefault("HF_HUB_OFFLINE", "1")  # nothing is looked up or sent
    os.environ.setdefault("SVT_LOG", "1")  # the video encoder then reports only errors
    os.environ.setdefault("HF_DATASETS_DISABLE_PROGRESS_BARS", "1")
    try:
        import av.logging
        from lerobot.datasets.lerobot_dataset import LeRobotDataset
    except ImportError:
        raise MissingExtra("export lerobot", "'lerobot[dataset]'", "lerobot") from None
    av.logging.set_libav_level(
        av.logging.WARNING
    )  # at its usual level, it reports each file that it completes
    return LeRobotDataset


def _fill(
    new: Path,
    runs: Sequence[Path],
    library: Any,
    path: Path,
    pictures: bool,
    view: str | None,
    progress: Callable[[int, int], None],
) -> WrittenDataset:
    """Make the data set in the folder `new`, which does not exist yet."""
    dataset: Any = None
    episodes: list[Episode] = []
    joints: tuple[str, ...] = ()
    for number, run in enumerate(runs):
        progress(number + 1, len(runs))
        trace, episode = read_episode(run, number)
        frames = frames_of(trace)
        if dataset is None:
            pictures = pictures and getattr(any_task(episode.task), "eye", None) is not None
            joints, robot = trace.motion.names, trace.head.arm
            dataset = library.create(
                repo_id=f"handeye/{path.name}",
                fps=RATE,
                features=features(joints, pictures=pictures, view=view is not None),
                root=new,
                robot_type=robot,
                use_videos=view is not None,
                image_writer_threads=_WRITERS,
                video_backend=_BACKEND,
            )
        elif trace.motion.names != joints:
            raise Refused(f"the run in {run} uses a different arm from the runs before it")
        goal = any_task(trace.head.task).words.done
        for frame in lerobot_frames(frames, trace, episode, pictures=pictures, view=view):
            dataset.add_frame({**frame, "task": goal})
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Converting input from bool", RuntimeWarning)
            dataset.save_episode()
        episodes.append(episode)
    assert dataset is not None
    dataset.finalize()
    return _finish(new, episodes, dataset.num_frames, path, pictures=pictures, view=view)


def _finish(
    new: Path, episodes: Sequence[Episode], frames: int, path: Path, *, pictures: bool, view: str | None
) -> WrittenDataset:
    (new / EPISODES).write_bytes(b"".join(msgspec.json.encode(each) + b"\n" for each in episodes))
    (new / CARD).write_bytes(card(episodes, frames, pictures=pictures, view=view))
    images = new / "images"  # LeRobot leaves the folder of the frames that it has encoded
    if images.is_dir() and not any(each.is_file() for each in images.rglob("*")):
        for folder in sorted(images.rglob("*"), reverse=True):
            folder.rmdir()
        images.rmdir()
    outcomes: dict[str, int] = {}
    for each in episodes:
        outcomes[each.outcome] = outcomes.get(each.outcome, 0) + 1
    return WrittenDataset(path=str(path), episodes=len(episodes), frames=frames, outcomes=outcomes)


def features(joints: Sequence[str], *, pictures: bool, view: bool) -> dict[str, dict[str, Any]]:
    """Return the features of a data set, as LeRobot describes them."""
    names = [name.replace(" ", "_") for name in joints]
    positions = [*names, "gap"]
    found: dict[str, dict[str, Any]] = {
        "observation.state": _numbers(positions),
        "observation.state_mean": _numbers(positions),
        "observation.rate": _numbers(names),
        "observation.torque": _numbers(names),
        "observation.force": _numbers(_WRENCH),
        "observation.force_mean": _numbers(_WRENCH),
        "observation.force_share": _numbers(["share"]),
        "observation.picture_age": _numbers(["seconds"]),
        "action": _numbers(positions),
        "annotation.stage": _text(),
        "annotation.instruction": _text(),
        "annotation.outcome": _text(),
        "next.done": {"dtype": "bool", "shape": (1,), "names": None},
        "next.success": {"dtype": "bool", "shape": (1,), "names": None},
    }
    if pictures:
        found[PICTURE] = _images("image", ROWS, WIDTH)
    if view:
        found[VIEW] = _images("video", HEIGHT, VIEW_WIDTH)
    return found


def _numbers(names: Sequence[str]) -> dict[str, Any]:
    return {"dtype": "float32", "shape": (len(names),), "names": [*names]}


def _text() -> dict[str, Any]:
    return {"dtype": "string", "shape": (1,), "names": None}


def _images(stored: str, height: int, width: int) -> dict[str, Any]:
    return {"dtype": stored, "shape": (height, width, 3), "names": ["height", "width", "channels"]}


def lerobot_frames(
    frames: Frames, trace: Trace, episode: Episode, *, pictures: bool, view: str | None
) -> Iterator[dict[str, Any]]:
    """Yield the frames of a run. Each frame is a dictionary whose keys are the names of the features."""
    shots = _shots(trace) if pictures else []
    views = repeat(None, len(frames)) if view is None else rendered_view(trace, view, frames.times)
    for k, rendered in zip(range(len(frames)), views, strict=True):
        last = k == len(frames) - 1
        frame: dict[str, Any] = {
            "observation.state": _single(frames.state[k]),
            "observation.state_mean": _single(frames.state_mean[k]),
            "observation.rate": _single(frames.rate[k]),
            "observation.torque": _single(frames.torque[k]),
            "observation.force": _single(frames.force[k]),
            "observation.force_mean": _single(frames.force_mean[k]),
            "observation.force_share": _single(frames.force_share[k]),
            "observation.picture_age": _single(frames.picture_age[k]),
            "action": _single(frames.action[k]),
            "annotation.stage": frames.stage[k],
            "annotation.instruction": frames.instruction[k],
            "annotation.outcome": episode.outcome,
            "next.done": np.array([last]),
            "next.success": np.array([last and episode.outcome == "right"]),
        }
        if pictures:
            frame[PICTURE] = shots[frames.picture[k]]
        if rendered is not None:
            frame[VIEW] = rendered
        yield frame


def _shots(trace: Trace) -> "list[EncodedImage]":
    """Return the television pictures of a run as images. The last image is black: it is the image of a frame without a
    picture, whose index is NO_PICTURE (-1).
    """
    from handeye.datasets.encoded_image import EncodedImage

    black = np.zeros((ROWS, WIDTH, 3), np.uint8)
    return [EncodedImage(each) for each in (*(shown(shot.picture) for shot in trace.pictures), black)]


def _single(values: Array | float) -> NDArray[np.float32]:
    return np.atleast_1d(np.asarray(values, dtype=np.float32))


def shown(picture: Picture) -> NDArray[np.uint8]:
    """Return a television picture as an image, shape (256, 334, 3): level 15 becomes 255, and the last column is
    black.
    """
    wide = np.zeros((ROWS, WIDTH), np.uint8)
    wide[:, :COLUMNS] = picture * LEVEL
    return np.repeat(wide[:, :, None], 3, axis=2)
