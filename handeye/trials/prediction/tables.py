"""A prediction as tables for other programs."""

import numpy as np

from handeye.trace.table import Column, Table
from handeye.trials.prediction.figures import PredictionFigures
from handeye.trials.prediction.predicting import Prediction


def tables(found: Prediction, made: PredictionFigures) -> tuple[Table, Table]:
    """A row an operation, and a row a world."""
    return operations(made), worlds(found)


def operations(made: PredictionFigures) -> Table:
    """A row for each thing of a contact operation."""
    each = made.operations
    words = (("operation", "of the work"), ("at", "position"), ("what", "is off"), ("unit", "of its figures"))
    numbers = (
        ("room", "how far off it may be"), ("median", "half are off by less"), ("p95", "5 % are off by more"),
        ("worst", "most"), ("used", "share of the room in the worst world"), ("worst_seed", "that world"),
        ("beyond", "share of the worlds in which it does not fit"),
    )  # fmt: skip
    return Table(name="operations", about=f"{made.n} worlds, nothing simulated.", columns=(
        *(Column(name=name, about=about, values=tuple(getattr(one, name) for one in each)) for name, about in words),
        *(Column(name=name, about=about, values=np.array([getattr(one, name) for one in each]))
          for name, about in numbers),
    ))  # fmt: skip


def worlds(found: Prediction) -> Table:
    thin = found.thinnest
    return Table(name="worlds", about="What is thinnest in each world, and how far off everything is.", columns=(
        Column(name="seed", about="of the world", values=np.array(found.seeds)),
        Column(name="used", about="share of the room that the thinnest uses", values=found.used),
        Column(name="thinnest", about="what that is", values=tuple(f"{p.operation}, {p.at}: {p.what}" for p in thin)),
        *(Column(name=f"{each.operation}, {each.at}: {each.what}", about=f"of {each.room:.3f}", unit=each.unit,
                 values=each.off) for each in found.each),
        *(Column(name=f"{each.operation}, {each.at}: places", about="that a search tries", values=each.places)
          for each in found.each if each.places is not None),
    ))  # fmt: skip
