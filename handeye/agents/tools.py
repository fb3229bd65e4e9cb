"""The table of the tools: the name, description, arguments and effects of each."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from handeye.agents import requests
from handeye.agents.call import Call
from handeye.agents.replies import Reply
from handeye.agents.requests import Request
from handeye.agents.toolbox import Toolbox
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import HandeyeError, NoSuchName


@dataclass(frozen=True, slots=True, kw_only=True)
class Tool:
    """A tool as clients see it."""

    name: str
    about: str
    takes: type[Request]
    act: Callable[[Toolbox, Any, Call], Reply]
    changes: bool = False  # begins, advances or changes a run
    drops: bool = False  # loses a part of a run
    queues: bool = False  # uses a cell, so that one such call is executed at a time


TOOLS: Final = (
    Tool(
        name="docs", takes=requests.Docs, act=Toolbox.docs,
        about="Read the manual: the index, or a page. Start with `language`, then `tutorial`; each instruction has "
        "a page, such as `search`. Also shows included scripts and taught files (insertion.al, insertion.toml).",
    ),
    Tool(
        name="check", takes=requests.Check, act=Toolbox.check,
        about="Check a script and its taught positions, and whether the arm reaches its goals. Nothing moves. Use "
        "it before `run`.",
    ),
    Tool(
        name="explain", takes=requests.Explain, act=Toolbox.explain,
        about="Explain a diagnostic code, an error number or an instruction, with an example.",
    ),
    Tool(
        name="plan", takes=requests.PlanOf, act=Toolbox.plan,
        about="Plan a script, and list its stages with their times, or the steps of one stage. Nothing moves.",
    ),
    Tool(
        name="world", takes=requests.WorldOf, act=Toolbox.world,
        about="List the quantities that differ from world to world, each with its spread, unit and source. The "
        "value of a quantity in a world stays hidden; a program must find it with the arm's sensors.",
    ),
    Tool(
        name="run", takes=requests.Advance, act=Toolbox.run, changes=True, queues=True,
        about="Begin a run of a script in a simulated world, or continue a run: to a place, for some steps, or to "
        "the end. Returns what each step did, and where the run pauses. A run of the whole assembly takes minutes. "
        "If the call is cancelled, the run pauses.",
    ),
    Tool(
        name="state", takes=requests.StateOf, act=Toolbox.state, queues=True,
        about="Show where a run is, and what the arm's own sensors measure: joints, hand, force, gap, saved "
        "differences, measured parts.",
    ),
    Tool(
        name="picture", takes=requests.PictureOf, act=Toolbox.picture, queues=True,
        about="Show the last picture that the program took, with what the program found in it.",
    ),
    Tool(
        name="back", takes=requests.Back, act=Toolbox.back, changes=True, drops=True, queues=True,
        about="Return a run to an earlier state. The events after that state are lost; `fork` first to keep them.",
    ),
    Tool(
        name="fork", takes=requests.Fork, act=Toolbox.fork, changes=True, queues=True,
        about="Begin a new run from a state of an existing run: its present state, or the state before a stage. The "
        "existing run is kept.",
    ),
    Tool(
        name="result", takes=requests.ResultOf, act=Toolbox.result, queues=True,
        about="The verdict on a run that has ended: accepted, stopped (the program called the operator) or silent "
        "(the program reported success, but the referee found the work wrong).",
    ),
    Tool(
        name="submit", takes=requests.Submit, act=Toolbox.submit, queues=True,
        about="Run a script to its end in several worlds, and let the referee judge each run. Nothing is kept.",
    ),
)  # fmt: skip
_BY_NAME: Final = {tool.name: tool for tool in TOOLS}


def tool_named(name: str) -> Tool:
    """Return the tool called `name`. If no tool has this name, raises NoSuchName, which suggests the nearest name."""
    if name not in _BY_NAME:
        near = suggestion(name, _BY_NAME) or f"the tools are {', '.join(_BY_NAME)}"
        raise NoSuchName(f"there is no tool {quoted(name)}; {near}")
    return _BY_NAME[name]


def used(tool: Tool, toolbox: Toolbox, arguments: object, call: Call) -> Reply:
    """Use a tool. A call that cannot be executed gets a reply that says why, in a sentence."""
    try:
        return tool.act(toolbox, requests.read(tool.name, tool.takes, arguments), call)
    except HandeyeError as error:
        return Reply(text=str(error), failed=True)
    except Exception as error:  # an agent cannot use a traceback, and the other runs must go on
        return Reply(
            text=f"`{tool.name}` failed because of a defect in handeye ({type(error).__name__}); please report the "
            "call",
            failed=True,
        )
