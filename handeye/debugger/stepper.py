"""The interactive stepper, which executes commands. It returns the reply to each command as a record, and prints it."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import msgspec
from msgspec import UNSET

from handeye.core.errors import HandeyeError, Refused
from handeye.core.plain_text import counted
from handeye.debugger.command_table import MEANWHILE, find
from handeye.debugger.formatting import as_json, as_text
from handeye.debugger.live import LineInput, Live, LiveJson, LiveText
from handeye.debugger.reply import CommandResult, Reply, step_summaries
from handeye.debugger.session import DebugSession
from handeye.debugger.views import task_views
from handeye.runs.advance import AnyStop, Pause
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint


class Stepper:
    """Executes commands on a run."""

    def __init__(
        self,
        runner: Runner,
        *,
        breaks: Sequence[str] = (),
        stops: Sequence[AnyStop] = (),
        kept: Callable[[int], Checkpoint | None] = lambda _: None,
        keep: Callable[[Checkpoint], Path | None] = lambda _: None,
        pictures: Path | None = None,
    ) -> None:
        """Take control of a run, as `DebugSession` does. Raises InvalidInput if one of `breaks` does not name a
        place."""
        self.session = DebugSession(runner, stops=stops, kept=kept, keep=keep, pictures=pictures)
        for text in breaks:
            self.session.add_break(text)
        self.repeated: str | None = None  # command that an empty line on a terminal repeats
        self.refused = False
        """True if a command was refused. A command that was refused only because the run had ended does not count: the
        user could not foresee the end.
        """

    @property
    def over(self) -> bool:
        """True if the user left the session or ended the run."""
        return self.session.over

    @property
    def pause(self) -> Pause:
        return self.session.pause

    def do(self, line: str) -> Reply:
        """Execute a command. An invalid command changes nothing."""
        line = line.strip()
        happened = len(self.session.runner.events)
        try:
            command, rest = find(line)
            self.repeated = line if command.repeats else None
            told = command.act(self.session, rest)
        except HandeyeError as error:
            self.refused |= str(error) != self.session.at_its_end()
            return self._reply(line, CommandResult(), happened, error=str(error))
        return self._reply(line, told, happened)

    def meanwhile(self, line: str) -> Reply:
        """Answer a line that was typed during a run. Most commands are refused while the run moves."""
        line, happened = line.strip(), len(self.session.runner.events)
        try:
            command, rest = find(line)
            if not command.meanwhile:
                raise Refused(
                    f"`{command.name}` was ignored: while the run moves, only {MEANWHILE} are accepted"
                )
            told = command.act(self.session, rest)
        except HandeyeError as error:
            self.refused = True
            return self._reply(line, CommandResult(), happened, error=str(error))
        return self._reply(line, told, happened)

    def standing(self) -> Reply:
        """Return the reply that is shown before the first command. This reply says where the run is paused."""
        runner = self.session.runner
        steps = counted(len(self.session.program.steps), "step")
        said = f"{self.session.program.name}, {steps}; `help` lists the commands"
        refusal = self.session.at_its_end()
        told = CommandResult(source=self.session.source(), said=refusal or said)
        return self._reply("", told, len(runner.events))

    def _reply(self, line: str, told: CommandResult, happened: int, error: str | None = None) -> Reply:
        """Return the reply to a line. The reply contains the events of the run, without the first N of them, where N
        is `happened`.
        """
        session = self.session
        runner, step, stage = session.runner, session.runner.next, session.stage
        events = runner.events[happened:]
        return Reply(
            command=line,
            position=runner.position,
            time=runner.time,
            stage=None if stage is None else session.program.stages[stage],
            stage_number=None if stage is None else stage + 1,
            step=runner.at,
            script="" if step is None else step.file,
            line=None if step is None else step.line,
            text=None if step is None else step.text,
            tasks=task_views(runner) or UNSET,
            did=step_summaries(events, session.program, session.runner.task.measures),
            events=tuple(events),
            error=error,
            **{name: getattr(told, name) for name in CommandResult.__struct_fields__},
        )


def interact(
    stepper: Stepper,
    lines: Iterator[str],
    write: Callable[[str], None],
    *,
    json: bool = False,
    prompt: bool = False,
    most: int | None = None,
    live: Live | None = None,
) -> Pause:
    """Execute commands, one per line, until the user leaves the session. If there are no more lines, the session ends
    as with the command `quit`. Returns the reason why the run paused.

    Args:
        write: prints lines of text, which it gets without the final newline.
        json: answer each command with one JSON object on one line, and print nothing else.
        prompt: print a prompt for each line; an empty line repeats the last command that advanced the run.
        most: greatest number of executed steps to print. If None, all are printed.
        live: print each step as it begins, and answer lines that are typed during the run.
    """
    face = as_json if json else partial(as_text, most=most)
    told = None if live is None else _attend(stepper, live, write, json=json, echoed=prompt)
    if not json:
        write(face(stepper.standing()))
    while not stepper.over:
        line = next(lines, "quit")
        if not line.strip():
            if not prompt or stepper.repeated is None:
                continue
            line = stepper.repeated
        if told is not None:
            told.begin()
        reply = stepper.do(line)
        if told is not None:
            told.end()
        write(face(reply if told is None else msgspec.structs.replace(reply, did=())))
        if reply.pause is not None and reply.pause.kind == "panic" and not prompt:
            return reply.pause  # no person can decide whether the next line still applies
    return stepper.pause


def _attend(
    stepper: Stepper, live: Live, write: Callable[[str], None], *, json: bool, echoed: bool
) -> LiveText | None:
    """Print steps and answer lines during the run. Returns the object that prints steps as text, or None for
    JSON."""
    runner, text = stepper.session.runner, None
    if json:
        stepper.session.output = LiveJson(runner, write)
    else:
        stepper.session.output = text = LiveText(runner, write, live.put, live.width)

    def answer(line: str) -> None:
        reply = stepper.meanwhile(line)
        if text is None:
            write(as_json(reply))
        else:
            text.leave_line(ended=echoed)
            write(reply.error or reply.said or "")

    stepper.session.input = LineInput(live.typed, answer)
    return text
