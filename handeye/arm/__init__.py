"""The arm: kinematics and dynamics as a public interface, and the functions on which the servo and the planner are
built.

Each name is imported when it is first used, because `import handeye` must not import NumPy.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from handeye.arm.door import STANFORD, forward, gravity, inverse, jacobian, mass_matrix

__all__ = ["STANFORD", "forward", "gravity", "inverse", "jacobian", "mass_matrix"]

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        if name in __all__:
            from handeye.arm import door

            return vars(door)[name]
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
