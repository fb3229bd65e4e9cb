"""Arithmetic of 16-bit words in two's complement."""

from typing import Final

LOWEST: Final = -0x8000
HIGHEST: Final = 0x7FFF


def fits(value: int) -> bool:
    """Return True if a value fits into a word."""
    return LOWEST <= value <= HIGHEST


def wrap(value: int) -> int:
    """Return the word that has the lowest 16 bits of a value."""
    return ((value + 0x8000) & 0xFFFF) - 0x8000


def double(high: int, low: int) -> int:
    """Return the 32-bit value of a pair of words."""
    return (high << 16) | (low & 0xFFFF)


def halves(value: int) -> tuple[int, int]:
    """Split a value into its high and low word. Bits above the lowest 32 are lost."""
    return wrap(value >> 16), wrap(value)


def divided(value: int, divisor: int) -> tuple[int, int]:
    """Return quotient and remainder; the quotient is rounded toward zero. `divisor` is not 0."""
    quotient = abs(value) // abs(divisor)
    if (value < 0) != (divisor < 0):
        quotient = -quotient
    return quotient, value - quotient * divisor
