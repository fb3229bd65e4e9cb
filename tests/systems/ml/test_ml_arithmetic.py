"""The arithmetic of 16-bit words against that of Python's integers."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from ml_bench import WORDS

from handeye.systems.ml.ml_api import Ml

TERMINAL = Ml()


def wrapped(value: int, bits: int = 16) -> int:
    return int.from_bytes((value % (1 << bits)).to_bytes(bits // 8, "big"), "big", signed=True)


def after(*lines: str) -> tuple[int, int, bool]:
    """The first two variables and the overflow indicator after some lines."""
    for line in ("OVFLOFF", *lines):
        TERMINAL.do(line)
    return TERMINAL.variable(1), TERMINAL.variable(2), bool(TERMINAL.read("RG", 3, 2))


@pytest.mark.ml_row(28)
@settings(max_examples=50)
@given(WORDS, WORDS)
def test_sums_and_products_wrap_and_set_the_overflow_indicator(a: int, b: int) -> None:
    for code, exact in (("ADD", a + b), ("MULT", a * b)):
        result, _, overflow = after(f"LOAD 1 {a}", f"{code} 1 {b}")
        assert result == wrapped(exact)
        assert overflow == (exact != wrapped(exact))


@settings(max_examples=50)
@given(WORDS, WORDS)
def test_a_product_of_two_words_has_all_32_bits_and_no_overflow(a: int, b: int) -> None:
    low, high, overflow = after(f"LOAD 1 {a}", f"MULT 1 {b} 2")
    assert (high << 16) + (low % 65536) == a * b
    assert not overflow


@settings(max_examples=50)
@given(WORDS, WORDS)
def test_a_quotient_is_rounded_toward_zero_and_leaves_a_rest(a: int, b: int) -> None:
    quotient, rest, overflow = after(f"LOAD 1 {a}", "LOAD 2 99", f"DIVD 1 {b} 2")
    if b == 0:
        assert (quotient, rest, overflow) == (a, 99, True)
    else:
        exact = int(a / b)  # exact for words
        assert quotient == wrapped(exact)
        assert rest == a - exact * b
        assert overflow == (exact != wrapped(exact))


@settings(max_examples=50)
@given(st.integers(-(1 << 31), (1 << 31) - 1), st.integers(-(1 << 31), (1 << 31) - 1))
def test_pairs_of_words_are_added_with_32_bits(a: int, b: int) -> None:
    pairs = [f"{wrapped(value >> 16)} {wrapped(value)}" for value in (a, b)]
    high, low, overflow = after(f"DLOAD 1 {pairs[0]}", f"DADD 1 {pairs[1]}")
    assert (high << 16) + (low % 65536) == wrapped(a + b, 32)
    assert overflow == (a + b != wrapped(a + b, 32))


@settings(max_examples=50)
@given(WORDS)
def test_a_single_value_is_extended_by_its_sign(a: int) -> None:
    high, low, _ = after(f"DLOAD 1 {a}")
    assert (high, low) == (-1 if a < 0 else 0, a)


@pytest.mark.ml_row(29)
@settings(max_examples=50)
@given(WORDS, WORDS)
def test_comparisons_agree_with_those_of_integers(a: int, b: int) -> None:
    expected = {"LT?": a < b, "LE?": a <= b, "GT?": a > b, "GE?": a >= b, "EQ?": a == b, "NE?": a != b}
    for code, holds in expected.items():
        TERMINAL.do(f"{code} {a} {b}")
        assert bool(TERMINAL.read("RG", 3, 1)) == holds
