"""Conditions of a preparation: equal conditions give equal results, to the byte."""

import platform

import msgspec
import numpy as np

from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.core.versions import code_digest, versions
from handeye.ports.camera import Renderer
from handeye.runs.setup import Setup, plan_of
from handeye.tasks import task


class Conditions(Record, frozen=True, kw_only=True):
    """Everything on which the result of a preparation depends."""

    task: str
    world: WorldSpec
    camera: Renderer
    driver: str  # description that OpenGL gives of itself, or ""
    feels: bool  # the arm measures its joints first
    versions: dict[str, str]
    code: str  # digest of Handeye's code and scenes
    machine: tuple[str, ...]  # kind of processor, since rounding depends on it

    @property
    def line(self) -> bytes:
        """The conditions as one line of JSON, equal for equal conditions."""
        return msgspec.json.encode(self, order="deterministic")


def conditions_of(setup: Setup, camera: Renderer) -> Conditions | None:
    """The conditions of a run with this renderer; None if it uses code that is not Handeye's."""
    ours = type(task(setup.task)).__module__.startswith("handeye.")
    if camera.method == "replaced" or not ours:
        return None
    return Conditions(
        task=setup.task,
        world=setup.world,
        camera=camera,
        driver=_driver(camera),
        feels=plan_of(setup).program.feels,
        versions=versions(),
        code=code_digest(),
        machine=(platform.system(), platform.machine(), *_instructions()),
    )


def _driver(camera: Renderer) -> str:
    if camera.method != "opengl":
        return ""
    from handeye.cell.opengl import driver

    return driver()


def _instructions() -> tuple[str, ...]:
    """Instruction sets that NumPy found on this computer."""
    return tuple(np.show_config(mode="dicts")["SIMD Extensions"]["found"])
