"""A run whose calibration is kept of an earlier one is the same, to the byte, as one that calibrates."""

from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest
from block_task import BLOCK
from short_runs import plan_of

from handeye.cell.camera import SimulatedCamera
from handeye.core.errors import CalibrationFailed
from handeye.core.variation import WorldSpec
from handeye.ports.camera import WIDE, Renderer
from handeye.ports.workcell import Workcell
from handeye.program.events import RunStarted
from handeye.results.cautions import cautions
from handeye.runs.advance import advance
from handeye.runs.folder import TRACE, open_new
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.stanford import executor_run as programs
from handeye.systems.stanford.kept_calibrations import KeptCalibrations
from handeye.systems.stanford.preparation import conditions_of
from handeye.tasks.water_pump.task import WaterPump
from handeye.tasks.water_pump.world.nominal import DRAWING, LOOKS
from handeye.vision.calibration import Calibration

pytestmark = pytest.mark.slow

LOOKING = """
        STAGE   "look"
        LOOK    SETUP
        STAGE   "feel"
        MOVE    P1
        STOP    [0 0 -60]
        CHANGE  Z -.1
        SKIPE   23
        OPEN    1
"""
ASKED = "the camera was asked anew"
RAYS = Renderer(method="rays")


def start(seed: int = 0, camera: str = "ray") -> Checkpoint:
    return Checkpoint(setup=Setup(plan=plan_of(LOOKING), world=WorldSpec(seed=seed), camera=camera))


def kept_run(folder: Path) -> Runner:
    """The program carried out, and kept in a folder."""
    begun = start(camera="auto")
    keeping = open_new(folder, begun)
    runner = Runner(begun, observers=lambda runner: [keeping.watch(runner, begun, again=False)])
    advance(runner)
    runner.finish()
    keeping.close()
    return runner


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Runner, Runner, Path]]:
    """A run that calibrates, with the wide lens only, and the same behind it; `cold` and `warm` in a folder."""
    folder = tmp_path_factory.mktemp("runs")
    wide = tuple(look for look in LOOKS if look.lens == WIDE)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HANDEYE_CACHE", str(folder / "cache"))
        patch.setattr(WaterPump, "eye", msgspec.structs.replace(WaterPump.eye, looks=wide))
        yield kept_run(folder / "cold"), kept_run(folder / "warm"), folder


def test_the_second_run_lets_no_time_pass_before_its_program(both: tuple[Runner, Runner, Path]) -> None:
    cold, warm, _ = both
    begun, again = cold.events[0], warm.events[0]
    assert isinstance(begun, RunStarted)
    assert (cold.started, warm.started) == (-begun.prepared, 0.0)
    assert (begun.time, begun.prepared > 60.0) == (0.0, True)
    assert begun == again


def test_events_trace_and_checkpoints_are_equal_to_the_byte(both: tuple[Runner, Runner, Path]) -> None:
    *_, folder = both
    cold, warm = (folder / name for name in ("cold", "warm"))
    files = [
        path.relative_to(cold) for path in cold.rglob("*") if path.is_file() and path.name != "host.json"
    ]
    assert {TRACE, "events.jsonl"} < {path.name for path in files}
    assert sum(path.suffix == ".checkpoint" for path in files) >= 2
    assert [path for path in files if (cold / path).read_bytes() != (warm / path).read_bytes()] == []


class Camera:
    """Calibrates at once, or fails; remembers that it was asked, and in what light."""

    fails = False
    asked = 0
    shadows: bool | None = None

    def __call__(self, cell: Workcell, *_: object) -> Calibration:
        assert isinstance(cell.camera, SimulatedCamera)
        self.asked, self.shadows = self.asked + 1, cell.camera._renderer.shadows
        if self.fails:
            raise CalibrationFailed(ASKED)
        return Calibration(model=DRAWING, residual_px={}, residual_m=0.0)


@pytest.fixture
def camera(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Camera:
    """What calibrates in these runs; what they keep is in a folder of their own."""
    camera = Camera()
    monkeypatch.setattr(programs, "calibrate_camera", camera)
    monkeypatch.setenv("HANDEYE_CACHE", str(tmp_path / "cache"))
    return camera


@pytest.mark.parametrize("fails", [False, True])
def test_shadows_are_only_missing_while_the_camera_is_calibrated(camera: Camera, *, fails: bool) -> None:
    camera.fails = fails
    eye = Runner(start()).arm_cell.camera
    assert eye is not None
    assert (camera.shadows, eye._renderer.shadows) == (False, True)


def test_a_calibration_is_for_any_program_in_its_world(camera: Camera) -> None:
    Runner(start())
    another = Setup(
        plan=plan_of("STOP [0 0 -60]\nCHANGE Z -1\nLOOK SETUP\n"), world=WorldSpec(seed=0), camera="ray"
    )
    assert Runner(Checkpoint(setup=another)).started == 0.0
    assert Runner(start(seed=1)).started < -3.0
    assert camera.asked == 2


def test_a_calibration_that_is_wanted_anew_is_made_anew_and_kept(camera: Camera) -> None:
    Runner(start())
    Runner(start(), calibrate=True)
    Runner(start())
    assert camera.asked == 2


def test_a_calibration_that_failed_is_not_kept(camera: Camera) -> None:
    camera.fails = True
    assert [Runner(start()).trouble for _ in range(2)] == [ASKED] * 2
    assert KeptCalibrations.of_user().files() == []


def test_a_damaged_calibration_is_made_again_and_replaced(camera: Camera) -> None:
    Runner(start())
    (file,) = KeptCalibrations.of_user().files()
    whole = file.read_bytes()
    file.write_bytes(whole[:-1])
    Runner(start())
    assert (camera.asked, file.read_bytes()) == (2, whole)


def test_a_calibration_of_another_cell_is_made_again(camera: Camera) -> None:
    runner, kept = Runner(start()), KeptCalibrations.of_user()
    conditions = conditions_of(start().setup, RAYS)
    assert conditions is not None
    found = kept.find(conditions)
    assert found is not None
    foreign = msgspec.structs.replace(found.cell, physics=found.cell.physics[:-1])
    kept.keep(conditions, msgspec.structs.replace(found, cell=foreign))
    again = Runner(start())
    assert (again.started, camera.asked, again.time) == (runner.started, 2, runner.time)


def test_a_run_that_cannot_keep_its_calibration_goes_on_and_says_so(camera: Camera, tmp_path: Path) -> None:
    (tmp_path / "cache").write_text("in the way")
    runner = Runner(start())
    (said,) = cautions(runner, judged=False)
    assert runner.trouble is None
    assert said.startswith("the camera calibration was not kept for other runs: ")


def test_code_of_the_caller_is_a_condition_that_nobody_knows() -> None:
    setup = start().setup
    assert conditions_of(setup, RAYS) is not None
    assert conditions_of(setup, Renderer(method="replaced", platform="mine")) is None
    plan = msgspec.structs.replace(setup.plan, task=BLOCK.name)
    assert conditions_of(Setup(plan=plan, world=setup.world, camera="ray"), RAYS) is None
