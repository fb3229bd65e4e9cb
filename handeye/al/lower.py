"""Converts statements to steps: attaches modifiers and RESTOREs to their motions, and resolves jumps and skips."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import accumulate

import msgspec
from msgspec.structs import replace

from handeye.al.definition import DECLARATION, JUMP, MODIFIER, MOTION, SHIFT, SKIP, STEP, Role
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.lower_statement import operation, restore
from handeye.al.macros import ExpandedStatement
from handeye.al.parameters import Call, FilledLine, uses
from handeye.al.syntax import Name, Statement, Text
from handeye.core.diagnostics import (
    LIMIT,
    Diagnostic,
    Label,
    Meant,
    alternatives,
    names_sentence,
    problem,
    quoted,
)
from handeye.core.source import Source, Span
from handeye.program.motion_operations import Move
from handeye.program.operations import AnyOperation
from handeye.program.program import SourcePlace, Step

Report = Callable[[Diagnostic], None]
FIRST_STAGE = "program"
_MODIFIER_KINDS = {"FORCE": "press", "FREE": "give way", "SPIN": "be turned", "VIA": "pass"}
"""Kinds of modifiers that a motion can have only once. All other modifiers are guards."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Lowered:
    """The stages and steps of an expanded program, with the statement of each step. `shifts` gives the RESTORE
    statements of each step that has any.
    """

    stages: tuple[str, ...]
    steps: tuple[Step, ...]
    origins: Sequence[Statement]
    shifts: Mapping[int, tuple[Statement, ...]]


def lower(
    placed: Sequence[ExpandedStatement],
    source: Source,
    report: Report,
    *,
    inner: Mapping[str, Name] | None = None,
) -> Lowered:
    """Convert an expanded program to stages and steps. The stages and steps are valid only if no error was
    reported. `inner` are the labels inside macros.
    """
    lowering = _Lowerer(report=report, inner=inner or {})
    for item in placed:
        lowering.place(item)
    lowering.end()
    kept = [draft for draft in lowering.drafts if draft.operation is not None]
    return Lowered(
        stages=tuple(lowering.stages),
        steps=tuple([_step(source, draft) for draft in kept]),
        origins=[draft.statement for draft in kept],
        shifts={number: draft.shifts for number, draft in enumerate(kept) if draft.shifts},
    )


def _step(source: Source, draft: "_Draft") -> Step:
    assert draft.operation is not None
    statement = draft.statement
    text, start = source.find(statement.start)
    length, column = statement.end - statement.start, text.column(start)
    modifiers = tuple([_place(source, modifier) for modifier in draft.modifiers]) if draft.modifiers else ()
    shown = text.text[start : start + length] if draft.line is None else draft.line.text
    *outer, macro = draft.inside or ("",)
    return Step(
        operation=draft.operation, stage=draft.stage, labels=draft.labels, macro=macro,
        call=outer[0] if outer else "", file=text.key, line=statement.line, span=(column, column + length), text=shown,
        modifiers=modifiers, next=draft.next,
    )  # fmt: skip


def _place(source: Source, statement: Statement) -> SourcePlace:
    text, start = source.find(statement.start)
    column = text.column(start)
    span = (column, column + statement.end - statement.start)
    return SourcePlace(file=text.key, line=statement.line, span=span)


class _Draft(msgspec.Struct, gc=False):
    """A step whose targets are not known yet. `operation` is None for a statement with an error."""

    statement: Statement
    call: Call
    stage: int
    operation: AnyOperation | None
    modifier: ExpandedStatement | None  # the first one
    next: int | None  # the following draft
    inside: tuple[str, ...]  # the macros that contain it, outermost first
    reach: Call  # the call whose labels a jump sees
    line: FilledLine | None
    modifiers: Sequence[Statement] = ()  # modifiers that apply, and calls that give them operands
    labels: tuple[str, ...] = ()
    shifts: tuple[Statement, ...] = ()

    @property
    def word(self) -> str:
        return "" if self.statement.word is None else self.statement.word.text


@dataclass(slots=True)
class _Lowerer:
    report: Report
    inner: Mapping[str, Name]
    drafts: list[_Draft] = field(default_factory=list)
    branches: list[int] = field(default_factory=list)  # drafts that jump or skip
    stages: dict[str, Span] = field(default_factory=dict)  # by name
    stage: int = 0
    labels: dict[tuple[Call, str], tuple[int, Name]] = field(default_factory=dict)
    pending: list[ExpandedStatement] = field(default_factory=list)  # modifiers of the next motion
    shiftable: bool = False  # after a MOVE, or one of its RESTOREs
    searches: list[tuple[int, int]] = field(default_factory=list)  # of searches: first step, AOJ
    unresolved: int = 0  # unresolved jumps

    def place(self, item: ExpandedStatement) -> None:
        statement = item.statement
        for label in statement.labels:
            self.label(label, item.call)
        if statement.word is None and not statement.broken:
            return
        definition = INSTRUCTIONS.get(statement.word.text) if statement.word is not None else None
        role = STEP if definition is None else definition.role
        if statement.broken or definition is None:
            # The meaning of this statement is unknown, as is that of a call of a macro in a file that is not read.
            # Nothing that depends on the statement is reported.
            if role not in (MODIFIER, DECLARATION, SHIFT):
                self.pending.clear()
                self.draft(item, None)
            self.shiftable = True
        elif role is MODIFIER:
            self.pending.append(item)
            self.shiftable = False
        elif role is SHIFT:
            self.restore(statement)
        elif role is DECLARATION:
            self.declare(statement)
        else:
            self.step(item, role)

    def label(self, label: Name, call: Call) -> None:
        before = self.labels.setdefault((call, label.text), (len(self.drafts), label))[1]
        if before is not label:
            first = Label(span=before.span, text="first here")
            self.problem("label-twice", f"label {quoted(label.text)} is defined twice", label, first)
        if self.pending:
            word = _word(self.pending[0])
            first = Label(span=word.span, text="a jump to the label would skip this modifier")
            message = f"label {quoted(label.text)} is between `{word.text}` and its motion"
            help = f"put the label before `{word.text}`"
            self.problem("label-splits-modifier", message, label, first, help=help)
        self.shiftable = False

    def declare(self, statement: Statement) -> None:
        assert statement.word is not None
        name = statement.operands[0]
        if statement.word.text == "STAGE" and isinstance(name, Text):
            if name.text in self.stages:
                first = Label(span=self.stages[name.text], text="first here")
                message = f"two stages have the name {quoted(name.text)}"
                help = "give each stage a different name: commands and reports refer to stages by name"
                self.problem("stage-twice", message, name, first, help=help)
            self.stages.setdefault(name.text, name.span)
            self.stage = list(self.stages).index(name.text)

    def restore(self, statement: Statement) -> None:
        assert statement.word is not None
        if not self.shiftable:
            help = "a `RESTORE` shifts the goal of the `MOVE` on the line above"
            self.problem("restore-without-move", "there is no `MOVE` to shift", statement.word, help=help)
        elif self.drafts and isinstance(move := self.drafts[-1].operation, Move):
            shifts = (*move.restore, restore(statement))
            self.drafts[-1].operation = replace(move, restore=shifts)
            self.drafts[-1].shifts += (statement,)

    def step(self, item: ExpandedStatement, role: Role) -> None:
        statement = item.statement
        if role is not MOTION and self.pending:
            self.no_motion(Label(span=statement.span, text="this instruction is not a motion"))
        if role is SKIP or role is JUMP:
            self.branches.append(len(self.drafts))
        modifiers = self.modifiers(statement) if self.pending else ()
        self.draft(item, operation(statement, modifiers), modifiers)
        self.pending.clear()
        self.shiftable = statement.word is not None and statement.word.text == "MOVE"

    def modifiers(self, motion: Statement) -> list[Statement]:
        """Return the pending modifiers that apply to a motion."""
        firsts: dict[str, ExpandedStatement] = {}
        fitting = []
        for modifier in self.pending:
            first = firsts.setdefault(_MODIFIER_KINDS.get(_word(modifier).text, ""), modifier)
            if self.fits(modifier, first, motion):
                fitting.append(modifier.statement)
        return fitting

    def draft(
        self, item: ExpandedStatement, made: AnyOperation | None, modifiers: Sequence[Statement] = ()
    ) -> None:
        if not self.stages:
            self.stages[FIRST_STAGE] = item.statement.span
        modifier = self.pending[0] if self.pending else None
        behind = len(self.drafts) + 1
        filled = [placed.line for placed in (*self.pending, item) if placed.line is not None]
        if filled:
            modifiers = (*modifiers, *dict.fromkeys(call for line in filled for call in line.calls))
        self.drafts.append(
            _Draft(
                item.statement, item.call, self.stage, made, modifier, behind, item.inside,
                item.jumps_from, item.line, modifiers,
            )
        )  # fmt: skip

    def fits(self, modifier: ExpandedStatement, first: ExpandedStatement, motion: Statement) -> bool:
        """Return True if a motion can have `modifier`, and if no earlier modifier of the same kind precedes it.
        `first` is the first modifier of that kind: `modifier` itself, if none precedes it. Reports a problem if the
        result is False.
        """
        word = _word(modifier)
        assert motion.word is not None
        fits = INSTRUCTIONS[word.text].fits
        if motion.word.text not in fits:
            modified = Label(span=motion.word.span, text="the motion")
            message = f"`{word.text}` cannot modify `{motion.word.text}`"
            help = "this modifier can modify only " + ", ".join(f"`{op}`" for op in fits)
            self.problem("modifier-misplaced", message, word, modified, help=help)
            return False
        if modifier is not first:
            other = Label(span=_word(first).span, text="the other modifier")
            message = f"`{motion.word.text}` cannot have both `{_word(first).text}` and `{word.text}`"
            if _word(first).text == word.text:
                message = f"`{motion.word.text}` cannot have `{word.text}` twice"
            self.problem("modifier-twice", message, word, other)
        return modifier is first

    def no_motion(self, after: Label | None) -> None:
        word = _word(self.pending[0])
        secondary = () if after is None else (after,)
        message, help = f"no motion follows `{word.text}`", "a modifier must be before the motion it modifies"
        self.problem("modifier-without-motion", message, word, *secondary, help=help)
        self.pending.clear()

    def end(self) -> None:
        if self.pending:
            self.no_motion(None)
        if self.drafts:
            self.drafts[-1].next = None
        for (_, name), (index, _) in self.labels.items():
            if index < len(self.drafts):
                self.drafts[index].labels += (name,)
        for index in self.branches:
            self.link(index)
        if self.searches:
            self.mark_searching()

    def link(self, index: int) -> None:
        """Set the targets of a step that jumps or skips."""
        draft = self.drafts[index]
        operation = draft.operation
        assert operation is not None
        if INSTRUCTIONS[draft.word].role is SKIP:
            skipped = self.skip(index)
            raised, draft.next = (skipped, draft.next) if draft.word == "SKIPE" else (draft.next, skipped)
            draft.operation = operation.leading_to(raised)
        elif operation.branches:
            draft.operation = operation.leading_to(self.jump(index))
        else:
            draft.next = self.jump(index)

    def at(self, index: int) -> int | None:
        return index if index < len(self.drafts) else None

    def jump(self, index: int) -> int | None:
        draft = self.drafts[index]
        label = draft.statement.operands[-1]
        assert isinstance(label, Name)
        scopes = [draft.reach[:depth] for depth in range(len(draft.reach), -1, -1)]
        for scope in scopes:
            if (scope, label.text) in self.labels:
                target = self.labels[scope, label.text][0]
                if draft.word == "AOJ":
                    self.searches.append((target, index))
                return self.at(target)
        self.unknown_label(label, scopes)
        return None

    def unknown_label(self, label: Name, scopes: Sequence[Call]) -> None:
        self.unresolved += 1
        inner = self.inner.get(label.text)
        if inner is not None:
            there = Label(span=inner.span, text="the label is inside a macro")
            message = f"label {quoted(label.text)} belongs to a macro"
            help = (
                "a jump from outside a macro cannot lead to a label in the macro; if the label should not be in "
                "the macro, end the macro with a blank line before the label"
            )
            self.problem("unknown-label", message, label, there, *uses(label), help=help)
            return
        message = f"there is no label {quoted(label.text)}"
        # Finding similar names takes time, so it is done only for the diagnostics that will be shown.
        known = [name for scope, name in self.labels if scope in scopes] if self.unresolved <= LIMIT else []
        meant = alternatives(label.text, known)
        self.problem("unknown-label", message, label, *uses(label), help=names_sentence(meant), meant=meant)

    def mark_searching(self) -> None:
        """Find every MOVE between a label and an AOJ that jumps back to the label, and mark the MOVE as part of a
        search.
        """
        change = [0] * (len(self.drafts) + 1)
        for first, last in self.searches:
            if first < last:
                change[first] += 1
                change[last] -= 1
        for draft, loops in zip(self.drafts, accumulate(change), strict=False):
            if loops and isinstance(draft.operation, Move) and draft.word == "MOVE":
                draft.operation = replace(draft.operation, searching=True)

    def skip(self, index: int) -> int | None:
        """Return the step after the skipped instruction. The call of a macro counts as one instruction."""
        draft = self.drafts[index]
        assert draft.statement.word is not None
        if index + 1 == len(self.drafts):
            message = f"there is no instruction for `{draft.word}` to skip"
            self.problem("skip-at-end", message, draft.statement.word)
            return None
        skipped = self.drafts[index + 1]
        depth = _shared(draft.call, skipped.call)
        unit, end = skipped.call[: depth + 1], index + 2
        if len(unit) > depth:
            while end < len(self.drafts) and self.drafts[end].call[: depth + 1] == unit:
                end += 1
        modifier = skipped.modifier
        if modifier is not None and (len(unit) == depth or modifier.call[: depth + 1] != unit):
            self.skips_modifier(draft.statement.word, _word(modifier))
        return self.at(end)

    def skips_modifier(self, skip: Name, modifier: Name) -> None:
        skipped = Label(span=modifier.span, text="only this modifier would be skipped")
        message = f"`{skip.text}` would skip `{modifier.text}`, but not the motion it modifies"
        help = "to skip the modifier and the motion, use the opposite test and a `JUMP`"
        self.problem("skip-over-modifier", message, skip, skipped, help=help)

    def problem(
        self, code: str, message: str, at: Name | Text, *secondary: Label,
        help: str | None = None, meant: Meant | None = None,
    ) -> None:  # fmt: skip
        self.report(problem(code, message, at.span, *secondary, help=help, meant=meant))


def _shared(one: Call, other: Call) -> int:
    """Return how many calls, counted from the outermost, are the same in two paths of nested calls."""
    for depth, (a, b) in enumerate(zip(one, other, strict=False)):
        if a != b:
            return depth
    return min(len(one), len(other))


def _word(item: ExpandedStatement) -> Name:
    assert item.statement.word is not None
    return item.statement.word
