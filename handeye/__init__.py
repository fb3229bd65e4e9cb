"""The Stanford hand-eye pump assembly of 1973: a script becomes a plan, a plan and a work cell become a pump.

>>> import handeye
>>> plan = handeye.plan("OPEN 1\\nOPEN 2\\n")
>>> run = handeye.assemble(script=plan, seed=3, camera="ray")
>>> run.completed
True

Names are loaded when they are first used, so that the import itself costs next to nothing.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from handeye import tasks, trials, vision
    from handeye.comparison.comparison import Comparison
    from handeye.door.begin import assemble, begin
    from handeye.door.comparing import compare
    from handeye.door.diagnostic import Diagnostic, ScriptError
    from handeye.door.opening import open
    from handeye.door.plans import Plan, plan
    from handeye.door.provided import demo, scripts
    from handeye.door.run import Run
    from handeye.door.state import State
    from handeye.door.trig_session import TrigSession
    from handeye.door.worlds import World
    from handeye.errors import HandeyeError, InvalidInput
    from handeye.judge.finding import Finding, at_least, at_most
    from handeye.report.result import Result
    from handeye.tasks.interface import Task
    from handeye.trace.trace import Trace

    __version__: str

__all__ = [
    "Comparison",
    "Diagnostic",
    "Finding",
    "HandeyeError",
    "InvalidInput",
    "Plan",
    "Result",
    "Run",
    "ScriptError",
    "State",
    "Task",
    "Trace",
    "TrigSession",
    "World",
    "__version__",
    "assemble",
    "at_least",
    "at_most",
    "begin",
    "compare",
    "demo",
    "open",
    "plan",
    "scripts",
    "tasks",
    "trials",
    "vision",
]

_HOMES = {
    "Comparison": "handeye.comparison.comparison",
    "Diagnostic": "handeye.door.diagnostic",
    "Finding": "handeye.judge.finding",
    "HandeyeError": "handeye.errors",
    "InvalidInput": "handeye.errors",
    "Plan": "handeye.door.plans",
    "Result": "handeye.report.result",
    "Run": "handeye.door.run",
    "ScriptError": "handeye.door.diagnostic",
    "State": "handeye.door.state",
    "Task": "handeye.tasks.interface",
    "Trace": "handeye.trace.trace",
    "TrigSession": "handeye.door.trig_session",
    "World": "handeye.door.worlds",
    "assemble": "handeye.door.begin",
    "at_least": "handeye.judge.finding",
    "at_most": "handeye.judge.finding",
    "begin": "handeye.door.begin",
    "compare": "handeye.door.comparing",
    "demo": "handeye.door.provided",
    "open": "handeye.door.opening",
    "plan": "handeye.door.plans",
    "scripts": "handeye.door.provided",
}
"""The module that each name comes from."""
_MODULES = ("tasks", "trials", "vision")

if not TYPE_CHECKING:  # who could not tell a wrong name otherwise

    def __getattr__(name: str) -> object:
        """Load what a name stands for when it is first used."""
        from importlib import import_module

        if name in _MODULES:
            return import_module(f"handeye.{name}")
        if name == "__version__":
            return import_module("handeye.versions").HANDEYE
        if name not in _HOMES:
            raise AttributeError(
                f"module 'handeye' has no attribute {name!r}", name=name, obj=import_module("handeye")
            )
        value = globals()[name] = getattr(import_module(_HOMES[name]), name)
        return value


def __dir__() -> list[str]:
    """Names that are here, loaded or not."""
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})
