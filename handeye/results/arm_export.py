"""Writes the arm as a URDF file for other programs, and makes a record of the arm's joints."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final, Literal

from handeye.arm.door import STANFORD
from handeye.arm.model import ArmModel
from handeye.cell.urdf import urdf
from handeye.core.files import Kind, check_place, write_over
from handeye.core.record import Record
from handeye.core.resources import scenes
from handeye.core.units import DEGREE

URDF: Final = Kind("URDF file", rb"<\?xml [^>]*\?>\s*<robot ", ending=".urdf")


class ExportedJoint(Record, frozen=True, kw_only=True):
    """A joint of an exported arm."""

    name: str  # in the file
    called: str  # in handeye's own texts
    kind: Literal["revolute", "prismatic"]
    lower: float  # rad or m
    upper: float
    speed: float  # greatest rate, rad/s or m/s
    effort: float  # greatest torque (N m) or force (N) of its drive


class ExportedArm(Record, frozen=True, kw_only=True):
    """The record of an exported arm."""

    path: str
    arm: str
    joints: tuple[ExportedJoint, ...]

    @property
    def lines(self) -> Iterator[str]:
        """The joints as a table, with one line for each joint."""
        yield f"{self.path}: the arm {self.arm}, {len(self.joints)} joints and two fingers"
        for joint in self.joints:
            turns = joint.kind == "revolute"
            size, unit, effort = (DEGREE, "deg", "N m") if turns else (1.0, "m", "N")
            span = f"{joint.lower / size:.4g} to {joint.upper / size:.4g} {unit}"
            rate = f"{joint.speed / size:.4g} {unit}/s"
            yield f"{joint.name:4}{joint.called:14}{joint.kind:11}{span:18}{rate:12}{joint.effort:4g} {effort}"


def export_urdf(path: Path, *, overwrite: bool = False) -> ExportedArm:
    """Write the nominal Stanford arm (the arm of the drawing) to a URDF file. Raises InvalidInput if the file
    cannot be written.
    """
    check_place(path, URDF, overwrite=overwrite)
    write_over(path, urdf(STANFORD, scenes() / "stanford_arm" / "stanford.xml"), URDF)
    return ExportedArm(path=str(path), arm=STANFORD.name, joints=tuple(_joints(STANFORD)))


def _joints(arm: ArmModel) -> Iterator[ExportedJoint]:
    for number, joint in enumerate(arm.joints, 1):
        yield ExportedJoint(
            name=f"j{number}",
            called=joint.name,
            kind=joint.kind,
            lower=joint.lower,
            upper=joint.upper,
            speed=joint.speed,
            effort=joint.effort,
        )
