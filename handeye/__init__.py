"""The Stanford hand-eye pump assembly of 1973. A script is compiled to a plan, and a run executes the plan in a
work cell.

>>> import handeye
>>> plan = handeye.plan("OPEN 1\\nOPEN 2\\n")
>>> run = handeye.assemble(script=plan, seed=3, camera="ray")
>>> run.completed
True

Each public name is imported when it is first used, so `import handeye` itself takes only milliseconds.
"""

TYPE_CHECKING = False  # type checkers take it as True; importing `typing` would delay the handling of Ctrl-C
if TYPE_CHECKING:
    from handeye import arm, tasks, trials, vision
    from handeye.api.begin import assemble, begin
    from handeye.api.control import Command
    from handeye.api.diagnostic import Diagnostic, ScriptError
    from handeye.api.plans import Plan, plan
    from handeye.api.provided import demo, scripts
    from handeye.api.run import Run
    from handeye.api.state import State
    from handeye.api.trace import Trace, compare, open
    from handeye.api.worlds import World
    from handeye.comparison.comparison import Comparison
    from handeye.core.errors import (
        BadArgument,
        BadFile,
        CannotWrite,
        HandeyeError,
        InvalidInput,
        NoSuchName,
        PhysicsFailed,
        Refused,
    )
    from handeye.judge.finding import Finding, at_least, at_most
    from handeye.results.result import Result
    from handeye.systems.ml.ml_api import Ml
    from handeye.systems.sigma.mal_api import Mal
    from handeye.systems.sigma.microbus_api import Microbus
    from handeye.systems.trig.session_api import TrigSession
    from handeye.tasks.interface import Task

    __version__: str

__all__ = [
    "BadArgument",
    "BadFile",
    "CannotWrite",
    "Command",
    "Comparison",
    "Diagnostic",
    "Finding",
    "HandeyeError",
    "InvalidInput",
    "Mal",
    "Microbus",
    "Ml",
    "NoSuchName",
    "PhysicsFailed",
    "Plan",
    "Refused",
    "Result",
    "Run",
    "ScriptError",
    "State",
    "Task",
    "Trace",
    "TrigSession",
    "World",
    "__version__",
    "arm",
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
    "BadArgument": "handeye.core.errors",
    "BadFile": "handeye.core.errors",
    "CannotWrite": "handeye.core.errors",
    "Command": "handeye.api.control",
    "Comparison": "handeye.comparison.comparison",
    "Diagnostic": "handeye.api.diagnostic",
    "Finding": "handeye.judge.finding",
    "HandeyeError": "handeye.core.errors",
    "InvalidInput": "handeye.core.errors",
    "Mal": "handeye.systems.sigma.mal_api",
    "Microbus": "handeye.systems.sigma.microbus_api",
    "Ml": "handeye.systems.ml.ml_api",
    "NoSuchName": "handeye.core.errors",
    "PhysicsFailed": "handeye.core.errors",
    "Plan": "handeye.api.plans",
    "Refused": "handeye.core.errors",
    "Result": "handeye.results.result",
    "Run": "handeye.api.run",
    "ScriptError": "handeye.api.diagnostic",
    "State": "handeye.api.state",
    "Task": "handeye.tasks.interface",
    "Trace": "handeye.api.trace",
    "TrigSession": "handeye.systems.trig.session_api",
    "World": "handeye.api.worlds",
    "assemble": "handeye.api.begin",
    "at_least": "handeye.judge.finding",
    "at_most": "handeye.judge.finding",
    "begin": "handeye.api.begin",
    "compare": "handeye.api.trace",
    "demo": "handeye.api.provided",
    "open": "handeye.api.trace",
    "plan": "handeye.api.plans",
    "scripts": "handeye.api.provided",
}
"""For each public name, the module that defines it."""
_MODULES = ("arm", "tasks", "trials", "vision")

if not TYPE_CHECKING:  # with this function, type checkers would accept every name

    def __getattr__(name: str) -> object:
        """Load a public name from its module when the name is first used."""
        from importlib import import_module

        if name in _MODULES:
            return import_module(f"handeye.{name}")
        if name == "__version__":
            return import_module("handeye.core.versions").HANDEYE
        if name not in _HOMES:
            raise AttributeError(
                f"module 'handeye' has no attribute {name!r}", name=name, obj=import_module("handeye")
            )
        value = globals()[name] = getattr(import_module(_HOMES[name]), name)
        return value


def __dir__() -> list[str]:
    """List all public names, loaded or not, and the module's special names."""
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})
