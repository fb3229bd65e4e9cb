"""Finds the imports of a module in its source, in every form and at every place."""

import ast
from collections.abc import Iterable, Iterator
from typing import Final

MAKERS: Final = {"importlib", "runpy", "pkgutil", "imp", "zipimport", "builtins"}
"""Modules that import others by a name that is made at run time. The source does not show that name."""
CALLED: Final = {"__import__", "exec", "eval", "__builtins__", "__loader__", "__spec__"}
"""Names that do the same without an import."""


def imports(source: str, module: str) -> set[str]:
    """Full names of everything that a module of `handeye` imports; `handeye` itself where it can reach all of it.

    Args:
        module: its name below `handeye`, as `cell.arm` or `cell.__init__`.
    """
    return imported(ast.walk(ast.parse(source)), module)


def imported(nodes: Iterable[ast.AST], module: str) -> set[str]:
    """The same, of the nodes of a module that has been parsed."""
    package = ["handeye", *module.split(".")[:-1]]
    found: set[str] = set()
    for node in nodes:
        match node:
            case ast.Import(names=names):
                found.update(alias.name for alias in names)
                found.update(
                    "handeye" for alias in names if alias.name.startswith("handeye.") and not alias.asname
                )
            case ast.ImportFrom(module=written, names=names, level=level):
                base = package[: len(package) - level + 1] if level else []
                origin = ".".join([*base, *([written] if written else [])])
                found.update(origin if alias.name == "*" else f"{origin}.{alias.name}" for alias in names)
    return found


def run_time_imports(source: str) -> set[str]:
    """Everything with which a module imports by a name made at run time."""
    return set(makers(ast.walk(ast.parse(source))))


def makers(nodes: Iterable[ast.AST]) -> Iterator[str]:
    """The same, of the nodes of a module that has been parsed."""
    for node in nodes:
        match node:
            case ast.Import(names=names):
                yield from (alias.name for alias in names if alias.name.split(".")[0] in MAKERS)
            case ast.ImportFrom(module=str(origin), names=names, level=0) if origin.split(".")[0] in MAKERS:
                yield from (f"{origin}.{alias.name}" for alias in names)
            case ast.ImportFrom(module="sys", names=names) if any(alias.name == "modules" for alias in names):
                yield "sys.modules"
            case ast.Attribute(value=ast.Name(id="sys"), attr="modules"):
                yield "sys.modules"
            case ast.Name(id=name) if name in CALLED:
                yield name
