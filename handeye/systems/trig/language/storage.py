"""Stores programs as JSON. Defines which properties each kind of step has, and checks the invariants of the
program in every file.
"""

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Final, TypeVar

import msgspec

from handeye.core.errors import BadFile
from handeye.core.files import Kind, read_whole, write_over
from handeye.core.plain_text import counted
from handeye.core.record import Vector3
from handeye.core.units import OUNCE_FORCE
from handeye.systems.trig.language.graph import NONE, TOP, Graph, Node, NodeType
from handeye.systems.trig.language.place import DECIMALS, LONGEST, NAME, Measures, Place, Position, Positions
from handeye.systems.trig.language.program import TrigProgram


def faults(graph: Graph, positions: Positions) -> Iterator[str]:
    """Describe in words each invariant that is violated. Yields nothing if the program is valid."""
    torn = list(_edge_faults(graph))
    if not torn and not _has_tree(graph):
        torn = ["some steps are not connected to the top"]
    yield from torn
    if not torn:
        yield from _loop_faults(graph)
    for node in graph.nodes.values():
        yield from _step_faults(node, positions)
    names = Counter(node.name for node in graph.nodes.values() if node.name is not None)
    yield from (f"two steps are called {name}" for name, count in names.items() if count > 1)


def _edge_faults(graph: Graph) -> Iterator[str]:
    for id, node in graph.nodes.items():
        if node.type == "none" or (node.type == "top") != (id == TOP):
            yield f"step {id} cannot have the type {node.type}"
        if len(node.sons) != (2 if node.type == "guarded" else 1):
            yield f"step {id} is {node.type} and has {len(node.sons)} sons"
        for son in node.sons:
            if son != NONE and (son not in graph or son == TOP):
                yield f"step {id} leads to step {son}, which does not exist"
            elif son != NONE and id not in graph[son].fathers:
                yield f"step {son} does not name its father {id}"
        for father in node.fathers:
            if father not in graph or id not in graph[father].sons:
                yield f"step {id} names the father {father}, but step {father} does not lead to step {id}"
        if any(not 0 <= branch < len(node.sons) or node.sons[branch] == NONE for branch in node.links):
            yield f"step {id} has a link without a target"
    if graph[TOP].fathers:
        yield "a step leads back to the top"


def _has_tree(graph: Graph) -> bool:
    seen, waiting = {TOP}, [TOP]
    while waiting:
        node = graph[waiting.pop()]
        for branch, son in enumerate(node.sons):
            if son == NONE or branch in node.links:
                continue
            if son in seen or son not in graph:
                return False
            seen.add(son)
            waiting.append(son)
    return len(seen) == len(graph.nodes)


def _loop_faults(graph: Graph) -> Iterator[str]:
    for id, node in graph.nodes.items():
        if node.type not in ("loop", "bloop"):
            continue
        partner = graph.nodes.get(node.partner)
        if partner is None or partner.partner != id or {node.type, partner.type} != {"loop", "bloop"}:
            yield f"the {node.type} {id} has no partner"
        elif node.type == "bloop" and node.partner not in graph.distances(id):
            yield f"the loop {node.partner} goes back to a step from which no path leads down to the loop"
        if not 0 <= node.count <= node.wanted:
            yield f"the loop {id} has a count of {node.wanted}, but has gone back {counted(node.count, 'time')}"


def _step_faults(node: Node, positions: Positions) -> Iterator[str]:
    if node.name is not None and not (re.fullmatch(NAME, node.name) and len(node.name) <= LONGEST):
        yield f"step {node.id} has a name that is not valid"
    if node.name is not None and (not node.shown or node.type == "loop"):
        yield f"step {node.id} has a name, but a step of type {node.type} cannot have one"
    position = positions.get(node.position or "")
    if (node.type in ("normal", "guarded", "savpos")) != (position is not None):
        yield f"step {node.id}, of type {node.type}, {'must not have' if position else 'needs'} a position"
    elif position is not None and position.relative and node.type == "savpos":
        yield f"step {node.id} saves a relative position"
    elif position is not None and node.negate and not position.relative:
        yield f"step {node.id} uses the opposite of an absolute position, but only a relative position has an opposite"
    if (node.type == "guarded") != (node.threshold is not None and node.vector is not None):
        yield f"the threshold and the force vector of step {node.id} do not fit its type, {node.type}"
    if node.threshold is not None and not node.threshold >= 0:
        yield f"step {node.id} has a threshold below 0"


VERSION: Final = 1
ENDING: Final = ".trig.json"
TRIG_FILE: Final = Kind(name="TRIG program", begins=rb'\s*\{\s*"trig"', ending=ENDING)
LARGEST: Final = 20_000_000  # bytes; a program of ten thousand steps takes five million
UNITS: Final = {"length": "mm", "angle": "deg", "force": "oz"}
_MAX_MEASURE: Final = 1e9  # mm, degrees or ounces
Read = TypeVar("Read")


class _Loop(msgspec.Struct, kw_only=True):
    bloop: int
    target: int
    wanted: int
    count: int


class _Node(msgspec.Struct, kw_only=True):
    id: int
    type: NodeType
    name: str | None = None
    position: str | None = None
    negate: bool = False
    sons: list[int]
    links: list[int] = []
    fathers: list[int]
    last_father: int = NONE
    threshold: float | None = None
    vector: Vector3 | None = None
    loop: _Loop | None = None
    comment: str | None = None


class _Position(msgspec.Struct, kw_only=True):
    relative: bool
    init: Measures
    data: Measures


class _File(msgspec.Struct, kw_only=True):
    trig: int
    units: dict[str, str]
    positions: dict[str, dict[str, object]]
    nodes: list[dict[str, object]]


def trig_file(path: Path) -> Path:
    """Return the file for a name: `pallet` becomes `pallet.trig.json`."""
    return (
        path if path.name.endswith(ENDING) else path.with_name(f"{path.name}{ENDING}") if path.name else path
    )


def write_program(path: Path, program: TrigProgram) -> None:
    """Write a program. An existing file is replaced only if it is empty or holds a TRIG program."""
    write_over(path, encoded(program), TRIG_FILE)


def read_program(path: Path) -> TrigProgram:
    """Read a TRIG program. Raises BadFile if the file is not valid."""
    return decoded(read_whole(path, LARGEST), str(path))


# -- writing -------------------------------------------------------------------------------------------


def encoded(program: TrigProgram) -> bytes:
    """Return a program as the content of a file, with its steps numbered in drawing order."""
    graph = program.graph
    numbers = {id: number for number, id in enumerate(graph.order())} | {NONE: NONE}
    used = {node.position for node in graph.nodes.values()}
    positions = {n: p for n, p in sorted(program.positions.items()) if n in used or not n.startswith("_")}
    content = {
        "trig": VERSION,
        "units": UNITS,
        "positions": {name: _position_fields(position) for name, position in positions.items()},
        "nodes": [_node_fields(graph, graph[id], numbers) for id in graph.order()],
        **program.unread,
    }
    return msgspec.json.format(msgspec.json.encode(content), indent=1) + b"\n"


def _position_fields(position: Position) -> dict[str, object]:
    measures = {"init": position.init.measures(), "data": position.data.measures()}
    return {"relative": position.relative, **measures, **position.unread}


def _node_fields(graph: Graph, node: Node, numbers: Mapping[int, int]) -> dict[str, object]:
    target = graph.target(node) if node.type == "loop" else None
    loop = {
        "bloop": numbers[node.partner],
        "target": NONE if target is None else numbers[target.id],
        "wanted": node.wanted,
        "count": node.count,
    }
    return {
        "id": numbers[node.id],
        "type": node.type,
        "name": node.name,
        "position": node.position,
        "negate": node.negate,
        "sons": [numbers[son] for son in node.sons],
        "links": sorted(node.links),
        "fathers": sorted(numbers[father] for father in node.fathers),
        "last_father": numbers.get(node.recent_father, NONE),
        "threshold": None if node.threshold is None else round(node.threshold / OUNCE_FORCE, DECIMALS),
        "vector": node.vector,
        "loop": loop if node.type == "loop" else None,
        "comment": node.comment,
        **node.unread,
    }


# -- reading -------------------------------------------------------------------------------------------


def decoded(content: bytes, name: str) -> TrigProgram:
    """Return the program in the content of a file. Messages call the file `name`. Raises BadFile if the content is not
    a valid TRIG program.
    """
    try:
        return _program(content)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        raise BadFile(f"{name} is not a TRIG program: it is not JSON, or was cut short") from None
    except _Fault as fault:
        raise BadFile(f"{name} {fault}") from None


class _Fault(Exception):
    """Raised if a file is faulty. The message continues a sentence that begins with the name of the file."""


def _program(content: bytes) -> TrigProgram:
    fields = msgspec.json.decode(content)
    if not isinstance(fields, dict) or not isinstance(fields.get("trig"), int):
        raise _Fault("is not a TRIG program")
    if fields["trig"] > VERSION:
        raise _Fault(f"has version {fields['trig']}; this version of handeye reads {VERSION}")
    file = _read(fields, _File, "the file")
    if file.units != UNITS:
        raise _Fault(f"has units other than {', '.join(UNITS.values())}")
    graph = Graph()
    nodes = [_node(one) for one in file.nodes]
    if sorted(node.id for node in nodes) != [*range(len(nodes))] or [
        n.id for n in nodes if n.type == "top"
    ] != [TOP]:
        raise _Fault("is not valid: its steps are not numbered consecutively from the top")
    graph.fill(nodes)
    positions = {name: _position(name, fields) for name, fields in file.positions.items()}
    program = TrigProgram(graph=graph, positions=positions, unread=_unread(fields, _File))
    fault = next(faults(graph, program.positions), None)
    if fault is not None:
        raise _Fault(f"is not valid: {fault}")
    return program


def _read(fields: object, type: type[Read], what: str) -> Read:
    try:
        return msgspec.convert(fields, type)
    except msgspec.ValidationError as error:
        raise _Fault(f"is not valid: {what}: {error}") from None


def _unread(fields: Mapping[str, object], type: type[msgspec.Struct]) -> dict[str, object]:
    return {name: value for name, value in fields.items() if name not in type.__struct_fields__}


def _position(name: str, fields: dict[str, object]) -> Position:
    read = _read(fields, _Position, f"position {name!r:.60}")
    if any(not abs(value) <= _MAX_MEASURE for value in (*read.init, *read.data)):
        raise _Fault(f"is not valid: position {name!r:.60} is too far away")
    init = Place.measured(read.init)
    return Position(relative=read.relative, init=init, data=init, unread=_unread(fields, _Position))


def _node(fields: dict[str, object]) -> Node:
    read = _read(fields, _Node, f"step {fields.get('id')!r:.20}")
    node = Node(
        id=read.id,
        type=read.type,
        name=read.name,
        position=read.position,
        negate=read.negate,
        threshold=None if read.threshold is None else read.threshold * OUNCE_FORCE,
        vector=read.vector,
        sons=read.sons,
        links={*read.links},
        fathers=[*dict.fromkeys(read.fathers)],
        last_father=read.last_father,
        comment=read.comment,
        unread=_unread(fields, _Node),
    )
    if (read.type == "loop") != (read.loop is not None):
        raise _Fault(
            f"is not valid: step {read.id}, of type {read.type}, {'must not have' if read.loop else 'needs'} loop data"
        )
    if read.loop is not None:
        node.partner, node.wanted = read.loop.bloop, read.loop.wanted
    return node
