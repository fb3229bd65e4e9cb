"""An account of processor time, by a clock that goes on by one at every look."""

from itertools import count

import pytest

from benchmarks.cpu_account import OTHER, CpuAccount


class Machine:
    """Something whose time is taken."""

    def outer(self) -> int:
        return self.inner() + 1

    def inner(self) -> int:
        return 1

    def broken(self) -> None:
        raise ZeroDivisionError


COMPONENTS = [(Machine, "outer", "servo"), (Machine, "inner", "physics"), (Machine, "broken", "physics")]


@pytest.fixture
def account() -> CpuAccount:
    ticks = count()
    return CpuAccount(clock=lambda: float(next(ticks)))


def test_every_second_goes_to_the_innermost_component(account: CpuAccount) -> None:
    with account.charging(COMPONENTS):
        assert Machine().outer() == 2
    account.close()
    assert account.spent == {((), OTHER): 2.0, ((), "servo"): 2.0, ((), "physics"): 1.0}


def test_what_follows_goes_to_another_place(account: CpuAccount) -> None:
    account.at(("stage", "one"))
    account.at(("stage", "two"))
    account.close()
    assert account.spent == {((), OTHER): 1.0, (("stage", "one"), OTHER): 1.0, (("stage", "two"), OTHER): 1.0}


def test_what_raises_is_charged_and_left(account: CpuAccount) -> None:
    with account.charging(COMPONENTS), pytest.raises(ZeroDivisionError):
        Machine().broken()
    account.close()
    assert account.spent == {((), OTHER): 2.0, ((), "physics"): 1.0}


def test_functions_are_their_own_again_when_the_account_is_done(account: CpuAccount) -> None:
    own = Machine.outer
    with pytest.raises(ZeroDivisionError), account.charging(COMPONENTS):
        raise ZeroDivisionError
    assert Machine.outer is own


def test_the_account_tells_what_it_has_taken_itself(account: CpuAccount) -> None:
    account.at(("stage", "one"))
    assert account.own_s() == pytest.approx(1.0, rel=0.01)
