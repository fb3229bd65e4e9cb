"""Write the tables of docs/figures.md from the rigs in tests/tasks/water_pump; the text around them is written by hand.

python docs/make_figures.py
"""

import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "support"), str(ROOT / "tests" / "tasks" / "water_pump")]

import pressing_rigs  # noqa: E402
import screw_rigs  # noqa: E402
import static_rigs  # noqa: E402
from static_rigs import Force  # noqa: E402

from handeye.tasks.water_pump.world.pump_world import PumpWorld  # noqa: E402

PAGE = ROOT / "docs" / "figures.md"
BEGIN, END = "<!-- Below: docs/make_figures.py -->\n", "<!-- Above: docs/make_figures.py -->\n"
SEED = 1


def weights() -> list[Force]:
    """Forces between weights, levers and springs."""
    return [force for rig in static_rigs.RIGS for force in rig()]


def screws() -> list[Force]:
    """Clamp forces of screws."""
    return list(screw_rigs.screws())


def felt(world: PumpWorld) -> list[Force]:
    """Forces that the hand feels in a world."""
    return [force for rig in pressing_rigs.RIGS for force in rig(world)]


def tables(
    weights: Iterable[Force], screws: Iterable[Force], nominal: Iterable[Force], drawn: Iterable[Force]
) -> str:
    """The tables of the page."""
    alone = [_forces(force, 2) for force in weights] + [_forces(force, 1) for force in screws]
    head = ["rig", "force", "by arithmetic", "simulated", "off"]
    hand = [
        [*_forces(a, 1)[:4], *_felt(a), _forces(b, 1)[2], *_felt(b)]
        for a, b in zip(nominal, drawn, strict=True)
    ]
    there = ["by arithmetic", "felt", "off"]
    both = [*head[:4], *there[1:], *(f"{column}, world {SEED}" for column in there)]
    return _table(head, alone) + "\n" + _table(both, hand)


def page(tables: str) -> str:
    """The whole page with these tables."""
    above, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    return above + BEGIN + "\n" + tables + "\n" + END + rest.partition(END)[2]


def _forces(force: Force, places: int) -> list[str]:
    """Cells with the calculated and the simulated force, to the given decimals of newtons."""
    places += 2 * (force.unit == "N m")
    reckoned, simulated = f"{force.reckoned:.{places}f} {force.unit}", f"{force.simulated:.{places}f}"
    return [force.rig, force.what, reckoned, simulated, _percent(force.simulated, force.reckoned)]


def _felt(force: Force) -> list[str]:
    """Cells with the force that the hand feels, if it feels one."""
    if force.felt is None:
        return []
    return [f"{force.felt:.{3 if force.unit == 'N m' else 1}f}", _percent(force.felt, force.reckoned)]


def _percent(value: float, right: float) -> str:
    return f"{100 * abs(value / right - 1):.1f} %"


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


if __name__ == "__main__":
    made = tables(weights(), screws(), felt(PumpWorld.nominal()), felt(PumpWorld.sample(SEED)))
    PAGE.write_text(page(made), encoding="utf-8")
