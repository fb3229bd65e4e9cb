"""The link between a run and those who look on."""

from contextlib import nullcontext

from handeye.view.link import MAX_WAITING_LINES, Link


def test_lines_come_one_by_one_while_the_run_pauses_and_are_taken_while_it_goes() -> None:
    link = Link()
    assert [link.say("step"), link.say("show"), link.say("back")] == [True] * 3
    lines = link.lines(nullcontext)
    assert (next(lines), link.come(), link.come(), link.come()) == ("step", "show", "back", None)


def test_the_panic_button_works_while_something_goes_and_is_forgotten_when_it_pauses() -> None:
    link = Link()
    assert (link.press(), link.panic()) == (False, False)
    lines = link.lines(nullcontext)
    link.say("continue")
    next(lines)
    assert (link.press(), link.panic(), link.panic()) == (True, True, False)
    link.press()
    link.say("continue")
    next(lines)
    assert not link.panic()


def test_no_more_lines_wait_than_a_run_can_hear() -> None:
    link = Link()
    assert [link.say("step") for _ in range(MAX_WAITING_LINES + 2)] == [True] * MAX_WAITING_LINES + [
        False
    ] * 2
