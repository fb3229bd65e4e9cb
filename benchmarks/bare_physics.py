"""Replays a tape of everything that a cell wrote to its simulator. A second simulator executes only the physics."""

import copy
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import mujoco

from benchmarks.tape import Call, Move, Place, Tape, places, state_of


@dataclass(frozen=True, slots=True, kw_only=True)
class Bare:
    """The result of replaying a tape."""

    seconds: float
    """Time of the replay, by the clock that was passed."""
    physics_steps: int
    stretches: int
    same: int
    """Number of stretches that ended in the same state as in the run, bit for bit."""
    apart_s: float | None
    """The cell's clock at the end of the first stretch that ended in a different state; None if there is none."""


def play(tape: Tape, clock: Callable[[], float]) -> Bare:
    """Replay a tape, and measure the time."""
    model = copy.deepcopy(tape.model)
    data = mujoco.MjData(model)
    there = places(model, data, tape.figures)
    seconds, apart = 0.0, []
    for stretch in tape.stretches:
        moves = [_ready(move, there) for move in stretch.moves]
        begun = clock()
        for call, arguments, written in moves:
            for place, values in written:
                place[...] = values
            call(model, data, *arguments)
        seconds += clock() - begun
        for name, values in stretch.left:
            there[name][...] = values
        if state_of(model, data) != stretch.end:
            apart.append(stretch.end_s)
    return Bare(
        seconds=seconds,
        physics_steps=sum(_steps(move) for stretch in tape.stretches for move in stretch.moves),
        stretches=len(tape.stretches),
        same=len(tape.stretches) - len(apart),
        apart_s=apart[0] if apart else None,
    )


def _ready(move: Move, there: dict[str, Place]) -> tuple[Call, tuple[Any, ...], list[tuple[Place, Any]]]:
    """Return a move with its function and its places already looked up, because looking them up takes time."""
    return (
        getattr(mujoco, move.call),
        move.arguments,
        [(there[name], values) for name, values in move.written],
    )


def _steps(move: Move) -> int:
    if move.call not in ("mj_step", "mj_step2"):
        return 0
    return int(move.arguments[0]) if move.arguments else 1
