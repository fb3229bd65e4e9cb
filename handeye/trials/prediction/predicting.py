"""A prediction over many worlds, in several processes."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.variation import WorldSpec
from handeye.program.program import Program
from handeye.program.senses import Sense
from handeye.tasks import task
from handeye.tasks.interface import Predicted
from handeye.trials.seeds import in_processes

CHUNK: Final = 250
"""Worlds that a process predicts at a time."""
_Seeds = tuple[int, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Prediction:
    """What is predicted of a program in some worlds."""

    world: WorldSpec
    """What the worlds are but for their seeds."""
    seeds: tuple[int, ...]
    each: tuple[Predicted, ...]
    """By operation, in the order of the work; arrays in the order of the worlds."""

    @property
    def used(self) -> Array:
        """The largest share of a room that each world uses, shape (n,): beyond 1, something is predicted to fail."""
        return np.asarray(self._used.max(axis=0))

    @property
    def thinnest(self) -> tuple[Predicted, ...]:
        """For each world, what uses that share."""
        return tuple(self.each[k] for k in self._used.argmax(axis=0))

    @property
    def _used(self) -> Array:
        return np.stack([each.used for each in self.each])


def predict(
    program: Program,
    world: WorldSpec,
    seeds: Sequence[int],
    *,
    without: tuple[Sense, ...] = (),
    workers: int = 1,
    told: Callable[[int], None] = lambda _: None,
) -> Prediction:
    """Predict a program in some worlds.

    Args:
        world: what the worlds are but for their seeds.
        without: senses that the program does without.
        told: is told how many worlds are done, now and then.

    Raises:
        InvalidInput: the task does not predict this, or a world cannot be drawn.
        WorkerLost: a process was killed twice.
    """
    chunks = [tuple(seeds[k : k + CHUNK]) for k in range(0, len(seeds), CHUNK)]
    work = partial(_chunk, program, world, without)
    found: dict[_Seeds, tuple[Predicted, ...]] = {}
    for chunk, each in map(work, chunks) if workers == 1 else in_processes(work, chunks, workers):
        found[chunk] = each
        told(sum(map(len, found)))
    return Prediction(world=world, seeds=tuple(seeds), each=_joined([found[chunk] for chunk in chunks]))


def _chunk(
    program: Program, world: WorldSpec, without: tuple[Sense, ...], seeds: _Seeds
) -> tuple[_Seeds, tuple[Predicted, ...]]:
    return seeds, task().predict(program, world, seeds, without=without)


def _joined(chunks: Sequence[tuple[Predicted, ...]]) -> tuple[Predicted, ...]:
    return tuple(
        replace(
            same[0],
            off=np.concatenate([each.off for each in same]),
            places=None if same[0].places is None else np.concatenate([each.places for each in same]),
        )
        for same in zip(*chunks, strict=True)
    )
