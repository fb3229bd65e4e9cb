"""Conditions under which an arm measures itself and calibrates the camera: equal ones come to the same, to the byte."""

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
    """Everything that decides how a preparation comes out."""

    task: str
    world: WorldSpec
    camera: Renderer
    driver: str
    """What draws, by its own words."""
    feels: bool
    """The arm has measured itself first."""
    versions: dict[str, str]
    code: str
    """Digest of the program and its scenes."""
    machine: tuple[str, ...]
    """Kind of processor: another rounds otherwise."""

    @property
    def line(self) -> bytes:
        """All of it as a line of JSON; equal conditions have equal lines."""
        return msgspec.json.encode(self, order="deterministic")


def conditions_of(setup: Setup, camera: Renderer) -> Conditions | None:
    """Conditions of a run whose pictures are made so; None if code of its caller is among them."""
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
    """Sets of instructions that NumPy has found here."""
    return tuple(np.show_config(mode="dicts")["SIMD Extensions"]["found"])
