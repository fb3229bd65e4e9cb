"""Inverse kinematics: how the joints must stand for the hand to be somewhere, or why they cannot.

One solver a structure; `solve` and `branches` find the one that an arm names.
"""

from handeye.arm.ik.result import IKResult
from handeye.arm.ik.solvers import branches, solve

__all__ = ["IKResult", "branches", "solve"]
