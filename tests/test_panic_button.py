"""The panic button is pressed by every signal to end; only a person who presses twice interrupts."""

import signal

import pytest

from handeye.cli.panic_button import PanicButton
from handeye.core.signals import ENDING, ToldToEnd

OTHERS = [number for number in ENDING if number != signal.SIGINT]


@pytest.mark.parametrize("number", ENDING)
def test_a_signal_to_end_presses_it_once(number: signal.Signals) -> None:
    with PanicButton() as panic:
        signal.raise_signal(number)
        assert (panic(), panic()) == (True, False)


@pytest.mark.parametrize("number", OTHERS)
def test_a_system_that_repeats_itself_does_not_interrupt(number: signal.Signals) -> None:
    with PanicButton() as panic:
        signal.raise_signal(number)
        signal.raise_signal(number)
        assert panic()


def test_ctrl_c_without_an_effect_interrupts_the_second_time() -> None:
    with PanicButton():
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)


@pytest.mark.parametrize("number", OTHERS)
def test_while_a_person_is_asked_it_ends_the_asking(number: signal.Signals) -> None:
    with pytest.raises(ToldToEnd), PanicButton() as panic, panic.aside():
        signal.raise_signal(number)


def test_where_ctrl_c_is_ignored_it_stays_so() -> None:
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with PanicButton() as panic:
            signal.raise_signal(signal.SIGINT)
            assert not panic()
    finally:
        signal.signal(signal.SIGINT, before)


def test_told_to_end_while_the_arm_moves_it_asks_for_nothing_more() -> None:
    with PanicButton() as panic:
        signal.raise_signal(signal.SIGTERM)
        assert panic()
        with pytest.raises(ToldToEnd), panic.aside():
            raise AssertionError("a question was asked")
