"""Errors of the devices of a cell: by how much each differs from what the controller believes of it."""

from dataclasses import dataclass

import numpy as np

from handeye.pose import Array


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmErrors:
    """Errors of an arm of n joints; arrays have shape (n,), rad (a prismatic joint: m) unless said."""

    offset: Array
    scale: Array
    """Relative error of the reading, about `centre`."""
    wave: Array
    """Amplitude of the waviness of a potentiometer."""
    period: Array
    """Of the waviness."""
    phase: Array
    """Of the waviness, rad."""
    centre: Array
    """Posture at which `scale` makes no error."""
    pot_noise: Array
    tachometer_noise: Array
    """Sigma, rad/s, m/s."""
    link_mass: Array
    """True mass over the mass the controller believes."""
    friction: Array
    """Coulomb friction, N m, N."""

    def readings(self, q: Array) -> Array:
        """Potentiometer readings without noise for true positions `q`, shape (..., n)."""
        wave = self.wave * np.sin(2 * np.pi * q / self.period + self.phase)
        return np.asarray(q + self.offset + self.scale * (q - self.centre) + wave)

    def positions(self, readings: Array) -> Array:
        """True positions that give these `readings`, shape (..., n)."""
        q = readings
        for _ in range(6):  # the errors are small and smooth: a few fixed-point steps reach 1e-12
            q = q - (self.readings(q) - readings)
        return q


@dataclass(frozen=True, slots=True, kw_only=True)
class HandErrors:
    """Errors of the sensors of the hand and the screwdriver."""

    gap_offset: float
    """m"""
    gap_scale: float
    gap_noise: float
    """Sigma, m."""
    switch_force: tuple[float, float]
    """Force at which the +y and the -y finger's switch fires, N."""
    torque_noise: float
    """Sigma, N m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraErrors:
    """Differences between a TV camera and its drawing."""

    place: tuple[float, float, float]
    """Error of the mount in W, m."""
    turn: tuple[float, float, float]
    """Error of pan, tilt and roll, rad."""
    focal_scale: tuple[float, float]
    """True over nominal focal length of the 25 mm and the 50 mm lens."""
    pot_noise: float
    """Sigma of the pan and tilt readings, rad."""
