"""Inverse kinematics: joint positions for a hand pose, or why there are none.

One solver for each structure; `solve` and `branches` choose the arm's.
"""

from handeye.arm.ik.result import IKResult
from handeye.arm.ik.solvers import branches, solve

__all__ = ["IKResult", "branches", "solve"]
