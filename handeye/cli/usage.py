"""Describes each mistake in a command line in one sentence, made from the report of the parser."""

from collections.abc import Iterable
from typing import Final, Literal, get_args, get_origin

from cyclopts import (
    CoercionError,
    CycloptsError,
    MissingArgumentError,
    RepeatArgumentError,
    UnknownCommandError,
    UnknownOptionError,
    UnusedCliTokensError,
)

from handeye.core.diagnostics import quoted, suggestion

_NOUNS: Final[dict[object, str]] = {float: "a number", int: "a whole number"}


FORMER: Final = {
    "--output": ("--out", "--out, or -o, gives the file or folder to write"),
    "--workers": ("--jobs", "--jobs sets the number of processes"),
    "--width": ("--size", "--size sets width and height, as in 1280x960"),
    "--svg": ("--out", "--out, or -o, gives the file or folder to write"),
    "--height": ("--size", "--size sets width and height, as in 1280x960"),
}
"""Options of earlier versions, each with its present name and a sentence about it."""


def usage_sentence(error: CycloptsError) -> str:
    """A sentence about the mistake in a command line, with a likely correction and a reference to further help."""
    command = " ".join(error.command_chain or ())
    tell_more = f"see `handeye {command} --help`" if command else "see `handeye --help`"
    return f"{_fault(error, quoted(command or 'handeye'))} ({tell_more})"


def _fault(error: CycloptsError, command: str) -> str:
    match error:
        case UnknownCommandError(unused_tokens=[word, *_], app=app):
            option = word.startswith("-")  # an option of a group, or else a command of it
            alike = () if app is None else (name for name in app if name.startswith("-") == option)
            return f"there is no {'option' if option else 'command'} {quoted(word)}{_meant(word, alike)}"
        case UnknownOptionError(token=token, argument_collection=known):
            name = token.keyword or token.value
            options = [each for one in known if one.parse for each in one.names if each.startswith("-")]
            today, told = FORMER.get(name.partition("=")[0], ("", ""))
            if today in options:
                return f"{command} has no option {quoted(name)} any more: {told}"
            return f"{command} has no option {quoted(name)}{_meant(name, options)}"
        case RepeatArgumentError(token=token):
            return f"{token.keyword} is given more than once"
        case CoercionError():
            return _wrong_value(error)
        case UnusedCliTokensError(unused_tokens=[word, *_]):
            if word.isdecimal() and "--n" in _options(error):
                return f"{command} takes the number of trials as --n {word}"
            return f"{command} does not take {quoted(word)}"
        case MissingArgumentError(argument=argument, keyword=keyword) if argument is not None:
            return f"{keyword} needs a value" if keyword else f"{command} needs {argument.name}"
    error.verbose = False
    return str(error)


def _options(error: CycloptsError) -> set[str]:
    """Return the options of the command that contains the mistake."""
    if error.app is None or error.app.default_command is None:
        return set()
    return {name for each in error.app.assemble_argument_collection() for name in each.names}


def _wrong_value(error: CoercionError) -> str:
    """A sentence about the wrong value of an option or argument."""
    name = "" if error.argument is None else error.argument.name
    if error.msg is not None:  # by a converter of our own
        return f"{name}: {error.msg}"
    given = "" if error.token is None else error.token.value
    if get_origin(error.target_type) is Literal:
        words = [str(word) for word in get_args(error.target_type)]
        return f"{name} must be one of {', '.join(words)}, not {quoted(given)}"
    if error.target_type is bool:
        return f"{name} takes no value, but {quoted(given)} was given"
    return f"{name} is {_NOUNS.get(error.target_type, 'something else')}; {quoted(given)} is not"


def _meant(name: str, known: Iterable[str]) -> str:
    """`; did you mean ...`, or a list of the names if there are few."""
    near = suggestion(name, known)
    return f"; {near}" if near else ""
