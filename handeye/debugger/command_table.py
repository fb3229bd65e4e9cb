"""The table of the stepper's commands, from which both parsing and help are derived."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.entries import Capability
from handeye.core.errors import NoSuchName, Refused
from handeye.debugger import commands as acts
from handeye.debugger.breakpoints import meant
from handeye.debugger.command import Command, check_bare, rows
from handeye.debugger.reply import CommandResult
from handeye.debugger.session import DebugSession
from handeye.runs.runner import Runner

StepperCommand = Command[Callable[[DebugSession, str], CommandResult]]


def find(line: str) -> tuple[StepperCommand, str]:
    """Return the command in a line, and its operand. Raises InvalidInput if the line does not begin with a command, or
    if the operand is not allowed.
    """
    word, _, rest = line.strip().partition(" ")
    name, _, more = _SHORT.get(word.casefold(), word.casefold()).partition(" ")
    rest = f"{more} {rest}".strip()
    named = [command for command in COMMANDS if command.name == name]
    if not named:
        near = meant(word, [command.name for command in COMMANDS])
        if word.casefold() in _SYNONYMS:
            near = f"; did you mean {quoted(_SYNONYMS[word.casefold()])}?"
        raise NoSuchName(f"there is no command {quoted(word)}{near or '; `help` lists the commands'}")
    check_bare(named, rest)
    return named[0], rest


def commands_of(runner: Runner) -> tuple[StepperCommand, ...]:
    """Return the commands that have an effect in a run, each with the help text for that run."""
    words, can = runner.kind.words, runner.kind.entry.can
    unable = {name for name, capability in _ASKING.items() if capability not in can}
    return tuple(
        replace(each, help=words.commands.get(each.usage, each.help))
        for command in COMMANDS
        if command.name not in unable.union(words.without)
        for each in (_settings(command, runner) if command.name == "set" else [command])
    )


_ASKING: Final[dict[str, Capability]] = {"undo": "undo", "type": "console"}


def _settings(command: StepperCommand, runner: Runner) -> list[StepperCommand]:
    return [
        replace(command, usage=f"set {kind} {settable.usage}", help=f"set a {settable.noun}")
        for kind, settable in runner.system.settables().items()
    ]


def manual(runner: Runner) -> str:
    """Return the manual of all commands that have an effect in this run."""
    words = runner.kind.words
    return "\n".join(
        [
            *words.about,
            *rows(commands_of(runner)),
            "",
            *words.places,
            f"    {', '.join(runner.kind.topics)}.",
            f"Units: {words.units}. On a terminal, an empty line repeats the last",
            "step, stage or continue.",
        ]
    )


def _help(session: DebugSession, rest: str) -> CommandResult:
    if not rest:
        return CommandResult(said=manual(session.runner))
    name = find(rest.partition(" ")[0])[0].name
    told = [f"{each.shown}: {each.help}" for each in commands_of(session.runner) if each.name == name]
    if not told:
        raise Refused(f"`{name}` is not a command for runs of {session.runner.kind.entry.title}")
    return CommandResult(said="\n".join(told))


_GOING, _BACK, _BREAKS, _LOOKING = "Continuing", "Going back in time", "Breakpoints", "Inspecting"
_TRYING, _CALLED, _LEAVING = "Trying something else", "When the operator is called", "Saving and leaving"

COMMANDS: Final[tuple[StepperCommand, ...]] = (
    Command(
        usage="step [N]", short="s", group=_GOING, act=acts.step, repeats=True,
        help="execute the next step, or the next N steps",
    ),
    Command(
        usage="stage", short="n", group=_GOING, act=acts.stage, repeats=True,
        help="continue to the end of the stage",
    ),
    Command(
        usage="continue", short="c", group=_GOING, act=acts.go_on, repeats=True,
        help="continue to a breakpoint, an operator call or the end",
    ),
    Command(
        usage="until PLACE", short="u", group=_GOING, act=acts.until,
        help="continue to a place, or to the first breakpoint before that place",
    ),
    Command(
        usage="pause", group=_GOING, act=acts.pause, meanwhile=True,
        help="pause after the current step; you can type this command while the arm moves",
    ),
    Command(
        usage="pace [1x|4x|free]", group=_GOING, act=acts.pace, meanwhile=True,
        help="run in real time, 4 times as fast, or as fast as possible",
    ),
    Command(
        usage="back [N]", short="b", group=_BACK, act=acts.back,
        help="go back one step, or N steps: arm, parts and program return to their earlier state",
    ),
    Command(
        usage="back stage", short="bs", group=_BACK, act=acts.back,
        help="go back to the beginning of this stage or, if the run is already there, of the previous stage",
    ),
    Command(
        usage="undo [N|stage]", group=_BACK, act=acts.undo,
        help="make the arm undo the last step, the last N steps or the stage (`back` resets the simulator instead)",
    ),
    Command(
        usage="break PLACE", group=_BREAKS, act=acts.set_break, help="pause at a place each time the run reaches it"
    ),
    Command(usage="breaks", group=_BREAKS, act=acts.breaks, help="list the breakpoints, with their numbers"),
    Command(usage="delete N", group=_BREAKS, act=acts.delete, help="delete the breakpoint with this number"),
    Command(
        usage="list [LINE]", short="l", group=_LOOKING, act=acts.script,
        help="show the script around the next step, or around a line",
    ),
    Command(
        usage="show [WHAT]", short="p", group=_LOOKING, act=acts.look,
        help="show the state of the run: all of it, or one topic",
    ),
    Command(
        usage="picture FILE", group=_LOOKING, act=acts.picture,
        help="write the last picture, with the detected features, to a new PNG file",
    ),
    Command(
        usage="set KIND NAME x y z", group=_TRYING, act=acts.experiment,
        help="change a value that the program remembers"
    ),
    Command(
        usage="type TASK TEXT", group=_TRYING, act=acts.type_line, meanwhile=True,
        help="type a line at the console of a task",
    ),
    Command(
        usage="proceed", group=_CALLED, act=acts.answer("proceed"), help="continue after the step that called the "
            "operator"
    ),
    Command(
        usage="retry", group=_CALLED, act=acts.answer("retry"),
        help="repeat the stage from its first step, with the parts where they are now",
    ),
    Command(usage="skip", group=_CALLED, act=acts.answer("skip"), help="skip the rest of the stage"),
    Command(usage="abort", group=_CALLED, act=acts.abort, help="end the run"),
    Command(
        usage="checkpoint [FILE]", group=_LEAVING, act=acts.checkpoint,
        help="save this state, for `handeye resume`",
    ),
    Command(usage="quit", short="q", group=_LEAVING, act=acts.leave, help="save this state and leave the stepper"),
    Command(usage="help [COMMAND]", short="h", group=_LEAVING, act=_help, help="show this list, or the help of one "
        "command"),
)  # fmt: skip

MEANWHILE: Final = " and ".join(
    f"`{command.name}`" for command in COMMANDS if command.meanwhile and command.name not in _ASKING
)
_SHORT: Final = {
    "?": "help",
    "exit": "quit",
    **{c.short: " ".join(filter(str.islower, c.usage.split())) for c in COMMANDS if c.short},
}
_SYNONYMS: Final = {"run": "continue", "go": "continue", "next": "step", "print": "show", "info": "show"}
