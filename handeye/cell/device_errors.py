"""Errors of the devices of a cell: how the true devices differ from the models of the controller."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from handeye.cell.raster import Raster
from handeye.core.pose import Array


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmErrors:
    """Errors of the sensors and drives of an arm with n joints. Unless a comment says something else, arrays have
    shape (n,) and are in rad, or in m for prismatic joints.
    """

    offset: Array
    scale: Array  # relative error of the reading, about `centre`
    wave: Array  # amplitude of the waviness of a potentiometer
    period: Array  # wavelength of the waviness
    phase: Array  # phase of the waviness, in rad
    centre: Array  # posture at which `scale` makes no error
    pot_noise: Array  # sigma, before the converter
    pot_step: Array  # step of the potentiometer's converter; 0 if it has none
    tachometer_noise: Array  # sigma before the converter, in rad/s or m/s
    tachometer_step: Array  # step of the tachometer's converter, in rad/s or m/s; 0 if it has none
    torque_step: Array  # step of the drive's torque converter, in N m or N; 0 if it has none
    drive_gain: Array  # true torque, divided by the commanded torque

    @classmethod
    def none(cls, joints: int) -> Self:
        """Make errors that are all zero."""
        none, ones = np.zeros(joints), np.ones(joints)
        return cls(
            offset=none, scale=none, wave=none, period=ones, phase=none, centre=none, pot_noise=none,
            pot_step=none, tachometer_noise=none, tachometer_step=none, torque_step=none, drive_gain=ones,
        )  # fmt: skip

    def readings(self, q: Array) -> Array:
        """Return the potentiometer readings without noise at true positions `q`, shape (..., n)."""
        wave = self.wave * np.sin(2 * np.pi * q / self.period + self.phase)
        return np.asarray(q + self.offset + self.scale * (q - self.centre) + wave)

    def positions(self, readings: Array) -> Array:
        """Return the true positions at given readings without noise, shape (..., n)."""
        q = readings
        for _ in range(6):  # the errors are small and smooth: a few fixed-point steps reach 1e-12
            q = q - (self.readings(q) - readings)
        return q


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmBuild:
    """True properties of an arm with n joints. Unless a comment says something else, arrays have shape (n,) and hold
    the ratio of the true value to the value in the model.
    """

    link_mass: Array
    mass_centre: Array  # distance of each link's mass centre from the joint that moves the link
    armature: Array  # inertia of each drive
    damping: Array  # viscous friction
    friction: Array  # Coulomb friction, in N m or N
    hand_length: float  # true minus modelled, in m


@dataclass(frozen=True, slots=True, kw_only=True)
class HandErrors:
    """Errors of the sensors of the hand and the screwdriver."""

    gap_offset: float  # m
    gap_scale: float
    gap_noise: float  # sigma before the converter, in m
    gap_step: float  # step of the converter, in m; 0 if it has none
    switch_force: tuple[float, float]  # force at which the +y and the -y finger's switch fires, in N
    torque_noise: float  # sigma, in N m


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraErrors:
    """The errors of a TV camera, relative to its design."""

    place: tuple[float, float, float]  # error of the mount in W, in m
    turn: tuple[float, float, float]  # error of pan, tilt and roll, in rad
    focal_scale: tuple[float, float]  # true over nominal focal length of the 25 mm and the 50 mm lens
    lens_place: tuple[tuple[float, float, float], tuple[float, float, float]]
    """Error of the position of each lens, in m: forwards, to the right and upwards, as seen in the pictures taken with
    this lens.
    """
    pot_noise: float  # sigma of the pan and tilt readings, in rad
    raster: Raster
    drift: float  # sigma of the shift of a picture, along its lines (in half widths) and across them (in half heights)
