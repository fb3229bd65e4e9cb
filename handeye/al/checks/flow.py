"""Checks of control flow, made on the graph of steps.

A statement of a macro becomes several steps, one for each call of the macro. Calls that give the statement the same
operands are checked together: the statement is reported only if it is wrong in all of these calls.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from handeye.al.checks.always_fails import always_failing
from handeye.al.syntax import Name, Statement
from handeye.core.diagnostics import Diagnostic, Label, problem
from handeye.core.errors import ERRORS, NO_FORCE, NO_TORQUE, NO_TOUCH, WRONG_THICKNESS
from handeye.core.source import Span
from handeye.program.flow_operations import Advance, Assign, Countdown, Jump, Save, Search, Test, Wait
from handeye.program.graph import Graph
from handeye.program.motion_operations import Change, Height, Move, Travel
from handeye.program.operation import Operation
from handeye.program.vision_operations import General, Specific

_CURES = {
    NO_FORCE: "a motion after a `STOP` raises error 23 if the hand never presses with the force of the `STOP`",
    NO_TORQUE: "a motion after a `TORQUE` raises error 24 if the screwdriver never reaches the torque",
    NO_TOUCH: "a motion after a `TOUCH` raises error 25 if no finger touches anything",
    WRONG_THICKNESS: "only a `CLOSE` with a maximum raises error 7",
}


def check_flow(graph: Graph, origins: Sequence[Statement]) -> list[Diagnostic]:
    """Check the control flow of a program that has no errors. `origins` gives the statement from which each step
    was made.
    """
    flow = _Flow(graph, origins)
    found = [*flow.unreachable(), *flow.loops()]
    for check in (flow.tests, flow.rounds, flow.vain, *(_order(flow, order) for order in _ORDERS)):
        found += flow.everywhere(check)
    return found


@dataclass(frozen=True, slots=True, kw_only=True)
class _Order:
    """A rule for the order of operations: an operation of the kind `of` makes sense only after an operation of the
    kind `needs`. If `later` is True, the operation of the kind `of` makes sense only before an operation of the kind
    `needs`.
    """

    code: str
    of: type[Operation]
    needs: type[Operation]
    message: str
    help: str
    later: bool = False


_ORDERS = (
    _Order(
        code="aoj-without-search",
        of=Advance,
        needs=Search,
        message="there is no `SEARCH` before this `AOJ`, so there is no next place to go to",
        help="put a `SEARCH` before the label",
    ),
    _Order(
        code="search-without-aoj",
        of=Search,
        needs=Advance,
        message="there is no `AOJ` after this `SEARCH`, so only the first place is tried",
        help="`AOJ` selects the next place of the search and jumps back to a label",
        later=True,
    ),
    _Order(
        code="save-without-move",
        of=Save,
        needs=Move,
        message="there is no `MOVE` before this `SAVE`, so there is no goal to compare with",
        help="`SAVE` saves the offset of the hand from the goal of the last `MOVE`",
    ),
    _Order(
        code="travel-without-change",
        of=Travel,
        needs=Change,
        message="there is no `CHANGE` before this `TRAVEL`, so there is no motion to measure",
        help="`TRAVEL` checks how far the hand moved in the last `CHANGE`",
    ),
    _Order(
        code="never-saved",
        of=Height,
        needs=Save,
        message="there is no `SAVE` before this `HEIGHT`, so the `HEIGHT` would raise error 9",
        help="`HEIGHT` compares the height of the hand with the height that `SAVE` recorded",
    ),
    _Order(
        code="specific-without-general",
        of=Specific,
        needs=General,
        message="there is no `GENERAL` before this `SPECIFIC`, so the `SPECIFIC` would raise error 31",
        help="`GENERAL` locates the part, and `SPECIFIC` then searches for its holes there",
    ),
)

Finding = tuple[int, Diagnostic]


def _order(flow: "_Flow", order: _Order) -> Callable[[], Iterator[Finding]]:
    def check() -> Iterator[Finding]:
        graph = flow.graph
        numbers = graph.which(order.of)
        if not numbers:
            return
        reach = graph.before if order.later else graph.after
        enough = reach(graph.which(order.needs))
        for number in numbers:
            if number not in enough:
                yield number, flow.problem(order.code, number, order.message, help=order.help)

    return check


class _Flow:
    def __init__(self, graph: Graph, origins: Sequence[Statement]) -> None:
        self.graph = graph
        self.origins = origins
        self.reached = graph.reached
        self.trapped = graph.trapped(graph.which(Wait, Advance))

    def everywhere(self, check: Callable[[], Iterator[Finding]]) -> Iterator[Diagnostic]:
        """Yield the diagnostics of a check. A statement can have several steps; a statement of a macro, for example,
        has one step for each call of the macro. The diagnostics of a statement count only if the check finds a fault
        in all reachable steps of the statement.
        """
        found = {number: diagnostic for number, diagnostic in check() if number in self.reached}
        if not found:
            return
        right = {self.origins[number] for number in self.reached if number not in found}
        for number, diagnostic in found.items():
            if self.origins[number] not in right:
                yield diagnostic

    def unreachable(self) -> Iterator[Diagnostic]:
        """Report the first statement of each unreachable part. A part directly after an endless loop is left out,
        because the loop is reported instead.
        """
        if len(self.reached) == len(self.graph.steps):
            return
        reached = {self.span(number) for number in self.reached}
        trapped = self.trapped & self.reached
        before = False
        for number in range(len(self.graph.steps)):
            lost = self.span(number) not in reached
            if lost and not before and number - 1 not in trapped:
                help = "the line above always jumps elsewhere, and no jump leads to this line"
                message = "this line is never executed"
                yield self.problem("unreachable-code", number, message, help=help)
            before = lost

    def loops(self) -> Iterator[Diagnostic]:
        """Report the loops without an exit, each once."""
        known: set[int] = set()
        for number in sorted(self.trapped & self.reached, reverse=True):
            loop = set() if number in known else self.graph.loop(number, known)
            if loop:
                yield self.loop(loop)

    def loop(self, loop: set[int]) -> Diagnostic:
        number, target = max(
            (number, target)
            for number in loop
            for target in self.graph.onward[number]
            if target is not None and target <= number
        )
        code, message, note = (
            "endless-loop",
            "this loop has no exit",
            "only an error for which the program has no test can end this loop",
        )
        if not any(self.graph.steps[n].operation.takes_time for n in loop):
            code, message = "idle-loop", "this loop has no exit, and nothing moves in it"
            note = "the run would stop here and call the operator"
        head = () if number == target else (Label(span=self.word(target).span, text="the loop begins here"),)
        return problem(code, message, self.word(number).span, *head, notes=(note,))

    def tests(self) -> Iterator[Finding]:
        """Report the tests without effect, and the tests for errors that cannot be pending where the test is made."""
        raised, actions = self.incoming()
        for number, operation in self.graph.each(Test):
            if not actions[number]:
                yield number, self.no_action(number)
            elif operation.number not in raised[number] and operation.number in ERRORS:
                yield number, self.never_raised(number, operation.number, actions[number], raised[number])
            elif operation.number in raised[number] and self.skips_test(operation, number, raised):
                message = f"the program continues in the same way whether or not error {operation.number} was raised"
                skips = f"`{self.word(number).text}` skips only the test below"
                help = f"{skips}: write a test and a `JUMP` for each error"
                yield number, self.problem("test-of-no-effect", number, message, help=help)

    def rounds(self) -> Iterator[Finding]:
        """Report the searches and counts that repeat the same round forever."""
        reported: dict[int, Span] = {}
        for jump, cause in stale_rounds(self.graph):
            word = self.word(jump).text
            if cause is None:
                message = (
                    "there is no `MOVE` between the label and this `AOJ`, so every round tries the same place"
                )
                help = "put the `MOVE` after the label, so that every round moves to the next place"
                yield jump, self.problem("search-stands-still", jump, message, help=help)
                continue
            if reported.setdefault(cause, self.span(jump)) != self.span(jump):
                continue  # one search may have several jumps back
            begin = self.word(cause)
            message = (
                f"`{word}` jumps back to a label before the `{begin.text}`, so every round executes the "
                f"`{begin.text}` again"
            )
            help = f"put the label after the `{begin.text}`"
            is_search = self.graph.at(cause, Search) is not None
            code = "search-begun-anew" if is_search else "count-begun-anew"
            there = Label(span=begin.span, text="executed again in every round")
            yield jump, self.problem(code, jump, message, there, help=help)

    def vain(self) -> Iterator[Finding]:
        """Report the steps that can never have their effect, or that always raise an error."""
        for found in always_failing(self.graph):
            cause = () if found.cause is None else (Label(span=self.span(found.cause), text="the cause"),)
            yield found.step, self.problem(found.code, found.step, found.message, *cause, help=found.help)

    def incoming(self) -> tuple[dict[int, set[int]], dict[int, set[int]]]:
        """Return, for each test, the errors that can be pending there, and the actions that can raise these errors."""
        steps, onward = self.graph.steps, self.graph.onward
        tests = self.graph.which(Test)
        raised: dict[int, set[int]] = {number: set() for number in tests}
        actions: dict[int, set[int]] = {number: set() for number in tests}
        waiting = []
        for number in self.graph.actions():
            target = onward[number][0]
            if target in raised:
                raised[target] |= steps[number].operation.raises
                actions[target].add(number)
                waiting.append(target)
        while waiting:
            number = waiting.pop()
            test, target = self.graph.at(number, Test), steps[number].next
            if test is None or target not in raised:
                continue
            passed = raised[number] - {test.number}
            if not (passed <= raised[target] and actions[number] <= actions[target]):
                raised[target] |= passed
                actions[target] |= actions[number]
                waiting.append(target)
        return raised, actions

    def no_action(self, number: int) -> Diagnostic:
        word = self.word(number).text
        before = [n for n in self.graph.back[number] if n < number]
        cause = [Label(span=self.word(n).span, text="this raises no error") for n in before[-1:]]
        if before and self.graph.at(before[-1], Test):
            cause = [Label(span=self.word(before[-1]).span, text="this clears the error")]
        message = f"`{word}` follows no action: there is no error to test"
        help = "put the test directly after the action that raises the error"
        return self.problem("test-without-action", number, message, *cause, help=help)

    def skips_test(self, first: Test, number: int, raised: Mapping[int, set[int]]) -> bool:
        """Return True if the test `first` skips exactly one statement, and this statement is a second test whose error
        can be pending. Both tests must lead to the same step.
        """
        steps, behind = self.graph.steps, self.graph.steps[number].next
        second = self.graph.at(behind, Test)
        if behind is None or second is None or second.number not in raised[behind]:
            return False
        case = first.raised
        if case is None or case != steps[behind].next:
            return False
        return any(self.graph.at(case, kind) for kind in (Jump, Wait))

    def never_raised(self, number: int, error: int, actions: set[int], raised: set[int]) -> Diagnostic:
        words = {self.word(n).text for n in actions}
        one = f"`{words.pop()}` does not raise" if len(words) == 1 else "no earlier action raises"
        cause = Label(span=self.word(max(actions)).span, text="the last action")
        can = ", ".join(map(str, sorted(raised)))
        help = _CURES.get(error, f"errors that can occur here: {can}")
        message = f"{one} error {error} here"
        if any(error in self.graph.steps[n].operation.raises for n in actions):
            message = f"an earlier test has already cleared error {error}"
            help = "a test clears the error that it tests"
            asked = [n for n in self.graph.which(Test) if n in self.graph.back[number]]
            cause = Label(span=self.word((asked or [max(actions)])[-1]).span, text="the earlier test")
        return self.problem("error-never-raised", number, message, cause, help=help)

    def span(self, number: int) -> Span:
        return self.origins[number].span

    def word(self, number: int) -> Name:
        word = self.origins[number].word
        assert word is not None
        return word

    def problem(
        self, code: str, number: int, message: str, *secondary: Label, help: str | None = None
    ) -> Diagnostic:
        return problem(code, message, self.word(number).span, *secondary, help=help)


StaleRound = tuple[int, int | None]  # the step that jumps back, and what restarts its search or count
Circles = Callable[[], list[set[int]]]


def stale_rounds(graph: Graph) -> Iterator[StaleRound]:
    """Yield the jumps that repeat the same round of a search or count. Each jump comes with the step that restarts the
    search or count, or with None if the round contains no MOVE.
    """
    circles = cache(graph.circles)  # asked for only where something looks wrong
    searches, moves = set(graph.which(Search)), set(graph.which(Move))
    places = searches | moves
    for jump in graph.which(Advance):
        target = graph.steps[jump].next
        yield from _anew(graph, circles, jump, target, searches)
        if graph.leads(target, jump, without=places) and circles()[jump].isdisjoint(moves):
            yield (jump, None)
    assigns: dict[str, set[int]] = {}
    for number, assign in graph.each(Assign):
        assigns.setdefault(assign.counter, set()).add(number)
    for jump, count in graph.each(Countdown):
        yield from _anew(graph, circles, jump, count.positive, assigns.get(count.counter, set()))


def _anew(
    graph: Graph, circles: Circles, jump: int, target: int | None, begins: set[int]
) -> Iterator[StaleRound]:
    """Yield the jump of a loop in which every round restarts the search or the count. Yield nothing if a path
    without a restart leads from `target` to the end of the program, or back to the jump.
    """
    if graph.leads(target, None, without=begins) or graph.leads(target, jump, without=begins):
        return
    if target in circles()[jump]:
        yield jump, min(circles()[jump] & begins)
