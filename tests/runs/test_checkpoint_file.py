"""Checkpoints on disk: whole, sound and of this arm, or refused with one sentence."""

import zlib
from pathlib import Path

import msgspec
import numpy as np
import pytest
from forged_checkpoints import changed, sealed
from short_runs import GRASP, begin, history, through

from handeye.core.errors import InvalidInput
from handeye.runs import checkpoint_file
from handeye.runs.checkpoint_file import (
    decode,
    encode,
    read_checkpoint,
    read_head,
    write_checkpoint,
)
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def runner() -> Runner:
    """A run in the middle of its second stage, with a saved difference."""
    run = Runner(begin())
    while run.position < 4:
        run.step()
    return run


@pytest.fixture(scope="module")
def data(runner: Runner) -> bytes:
    return encode(runner.checkpoint())


def test_what_is_read_leads_to_the_same_end_as_what_was_written(runner: Runner, data: bytes) -> None:
    mine, read = Runner(runner.checkpoint()), Runner(decode(data, "it"))
    assert history(through(read).events) == history(through(mine).events)


def test_the_same_state_gives_the_same_bytes(runner: Runner, data: bytes) -> None:
    assert encode(decode(data, "it")) == data == encode(runner.checkpoint())


def test_the_second_line_tells_people_what_it_is(data: bytes, tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(data)
    head = read_head(tmp_path / "a")
    assert (head.program, head.world.seed, head.position, head.stage) == ("short", 0, 4, "take the pin")
    assert (head.between_stages, head.touched) == (False, False)


@pytest.mark.parametrize("share", [0.0, 0.001, 0.01, 0.3, 0.9, 0.9999])
def test_a_file_cut_short_is_refused(data: bytes, share: float) -> None:
    with pytest.raises(InvalidInput, match=r"^it is (not a checkpoint of handeye|damaged or cut short)"):
        decode(data[: int(len(data) * share)], "it")


def test_a_flipped_bit_anywhere_is_refused(data: bytes) -> None:
    for place in [*range(0, 400, 7), *range(400, len(data), len(data) // 60)]:
        for bit in (0, 5):
            flipped = bytearray(data)
            flipped[place] ^= 1 << bit
            with pytest.raises(InvalidInput, match=r"^it (is|has) "):
                decode(bytes(flipped), "it")


def test_a_newer_version_is_refused(data: bytes) -> None:
    rest = data.partition(b"\n")[2]
    with pytest.raises(
        InvalidInput, match="checkpoint format version 6; this version of handeye reads version 5"
    ):
        decode(sealed(rest, version=6), "it")


def test_a_version_of_thousands_of_digits_is_no_version(data: bytes) -> None:
    rest = data.partition(b"\n")[2]
    with pytest.raises(InvalidInput, match="it is not a checkpoint of handeye"):
        decode(sealed(rest, version=10**4000), "it")


def test_another_arm_is_refused(runner: Runner) -> None:
    plan = msgspec.structs.replace(runner.setup.plan, arm="puma", arm_digest="0" * 12)
    setup = msgspec.structs.replace(runner.setup, plan=plan)
    foreign = encode(msgspec.structs.replace(runner.checkpoint(), setup=setup))
    with pytest.raises(InvalidInput, match="another arm"):
        decode(foreign, "it")


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"plan": "{}"}, "the plan in it is not a plan"),
        ({"events": []}, "events are incomplete"),
        ({"calibration": 3}, "not a valid checkpoint"),
        ({"more": 1}, "unknown field"),
        ({"snapshot": {"position": -1}}, "not a valid checkpoint"),
        ({"events": [{"event": "ErrorRaised", "time": 1.0, "number": 2, "detail": ""}]}, "unknown field"),
    ],
)
def test_a_sealed_file_with_nonsense_in_it_is_refused(
    data: bytes, fields: dict[str, object], sentence: str
) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        decode(changed(data, **fields), "it")


def test_a_checkpoint_that_lacks_its_last_event_is_refused(data: bytes, runner: Runner) -> None:
    events = msgspec.to_builtins(runner.checkpoint().events[:-1])
    with pytest.raises(InvalidInput, match=r"its events are incomplete$"):
        decode(changed(data, events=events), "it")


@pytest.mark.parametrize(
    ("was", "forged"),
    [
        (b'"program":"short"', b'"program":"other"'),
        (b'"position":4', b'"position":5'),
        (b'"touched":false', b'"touched":true'),
    ],
)
def test_a_head_that_does_not_match_what_is_below_it_is_refused(
    data: bytes, was: bytes, forged: bytes
) -> None:
    head, _, packed = data.partition(b"\n")[2].partition(b"\n")
    assert head.count(was) == 1
    with pytest.raises(InvalidInput, match=r"its header does not match its content$"):
        decode(sealed(head.replace(was, forged) + b"\n" + packed), "it")


def test_what_would_fill_the_memory_is_refused(data: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoint_file, "LARGEST", 1000)
    with pytest.raises(InvalidInput, match="the saved state is incomplete or too large"):
        decode(data, "it")


@pytest.mark.parametrize("dtype", ["|O", "<c16", "|S3"])
def test_only_figures_and_pictures_are_taken_for_arrays(data: bytes, dtype: str) -> None:
    _, _, packed = data.split(b"\n", 2)
    body = msgspec.msgpack.decode(zlib.decompress(packed))
    body["snapshot"]["state"]["goal"] = [dtype, [3], b"\0" * 48]
    with pytest.raises(InvalidInput, match="a checkpoint cannot contain"):
        decode(changed(data, snapshot=body["snapshot"]), "it")


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [
        (("state", "at"), 999, "does not fit this plan"),
        (("state", "stage"), 99, "does not fit this plan"),
        (("state", "goal"), ["<f8", [2], b"\0" * 16], "does not fit this plan"),
        (("state", "world", "measured"), {"moon": ["<f8", [4, 4], b"\0" * 128]}, "does not fit this plan"),
        (("state", "found"), {"../../x": {}}, "does not fit this plan"),
        (("state", "drive", "q"), ["<f8", [5], b"\0" * 40], "does not fit this plan"),
        (("state", "drive", "tare"), ["<f8", [7], b"\0" * 56], "does not fit this plan"),
        (("state", "goal"), ["<f8", [3], np.full(3, np.nan).tobytes()], "not a finite number"),
        (("state", "saved"), {"C1": ["<f8", [3], np.full(3, np.inf).tobytes()]}, "not a finite number"),
        (("state", "drive", "load"), float("inf"), "not a finite number"),
        (("state", "world", "moved"), {"P1": {"at": [float("nan")] * 6, "of": None}}, "not a finite number"),
        (("cell", "mechanisms", "stanford", "q"), [0.0] * 5, "a different number of joints"),
        (("cell", "mechanisms", "stanford", "q"), [float("nan")] * 6, "not a finite number"),
        (("cell", "mechanisms", "threads", "driven"), 9, "another scene"),
        (("cell", "mechanisms", "clamping"), {"clamped": "yes"}, "not a state of this work cell"),
        (("cell", "mechanisms"), {}, "other devices or mechanisms"),
        (("cell", "physics"), ["<f8", [2], b"\0" * 16], "another scene"),
        (("cell", "figures"), {}, "are not those that change in this scene"),
        (("cell", "noise"), "{}", "not a state of this work cell"),
        (("cell", "noise"), "[" * 5000, "not a state of this work cell"),
        (("cell", "mechanisms", "camera", "lens"), 0.5, "the turret has no"),
    ],
)
def test_a_state_that_does_not_fit_is_refused_before_it_is_used(
    data: bytes, path: tuple[str, ...], value: object, sentence: str
) -> None:
    _, _, packed = data.split(b"\n", 2)
    body = msgspec.msgpack.decode(zlib.decompress(packed))
    place = body["snapshot"]
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    checkpoint = decode(changed(data, snapshot=body["snapshot"]), "it")
    with pytest.raises(InvalidInput, match=sentence):
        Runner(checkpoint)


def test_a_run_that_has_not_begun_can_be_kept(tmp_path: Path) -> None:
    write_checkpoint(tmp_path / "start.checkpoint", begin(GRASP, seed=7))
    read = read_checkpoint(tmp_path / "start.checkpoint")
    assert (read, read.position, read.stage) == (begin(GRASP, seed=7), -1, None)


def test_a_checkpoint_that_cannot_be_written_leaves_the_one_before(
    runner: Runner, data: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.checkpoint"
    path.write_bytes(data)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(InvalidInput, match="No space left on device"):
        write_checkpoint(path, Checkpoint(setup=runner.setup))
    assert [p.name for p in tmp_path.iterdir()] == ["a.checkpoint"]
    assert path.read_bytes() == data


@pytest.mark.parametrize("path", ["/dev/zero", "/", "/nowhere"])
def test_what_is_no_file_is_refused(path: str) -> None:
    with pytest.raises(InvalidInput, match=r"is a device or a pipe|is a directory|there is no such file"):
        read_checkpoint(Path(path))
