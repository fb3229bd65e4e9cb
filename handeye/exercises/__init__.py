"""Exercises of the course (docs/course.md), which the referee grades."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from handeye.exercises.exercise import Exercise


def exercises() -> "Mapping[str, Exercise]":
    """Return all exercises by name: those of the arm language, and those of the systems."""
    from handeye.core.entries import entries, loaded
    from handeye.exercises.pin_exercises import FIND, GENTLY, HONEST, TOUCH
    from handeye.exercises.vision_exercise import SEE

    own = {each.name: each for each in (TOUCH, FIND, GENTLY, SEE, HONEST)}
    others = [loaded(place) for entry in entries().values() for place in entry.exercises]
    return own | {each.name: each for each in others}
