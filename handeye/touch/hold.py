"""Is something held? Simple models of the gap between the fingers after they have closed."""

from typing import Final

NEARLY_ZERO: Final = 0.0005
"""Gap that counts as closed, m. Placeholder: a fifth of the thinnest thing handled."""


def at_least(gap: float, thickness: float) -> bool:
    """Something of at least this thickness is held (m)."""
    return gap >= thickness


def at_most(gap: float, thickness: float) -> bool:
    """Nothing thicker than this is held (m)."""
    return gap <= thickness
