"""Write the tables of docs/figures.md on speed and growth, from what the benchmarks have measured.

python -m benchmarks speed --seed 1 --worlds 2 --camera gl --json > speed.json
python -m benchmarks growth --json > growth.json
python docs/make_speed.py speed.json growth.json
"""

import json
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Final

PAGE: Final = Path(__file__).parent / "figures.md"
BEGIN, END = "<!-- Below: docs/make_speed.py -->\n", "<!-- Above: docs/make_speed.py -->\n"
COLUMNS: Final = {
    "physics": ("physics",),
    "devices": ("devices",),
    "servo": ("servo",),
    "motions": ("motions",),
    "pictures": ("rendering", "vision"),
    "rest": ("snapshots", "records", "other"),
}
UNITS: Final = {"cpu_s": "CPU s", "mib": "MiB"}


def page(text: str, tables: str) -> str:
    """The whole page with these tables."""
    above, _, rest = text.partition(BEGIN)
    return above + BEGIN + "\n" + tables + "\n" + END + rest.partition(END)[2]


def speed(found: dict[str, Any]) -> str:
    """Tables of the cost of runs."""
    return "\n".join((_worlds(found), _stages(found), _totals(found)))


def _worlds(found: dict[str, Any]) -> str:
    head = [
        "world",
        "verdict",
        "preparation",
        "work",
        "referee",
        "physics alone",
        "ratio",
        "ratio without pictures",
        "identical to the run",
    ]
    return _table(head, [_world(world) for world in found["worlds"]])


def _world(world: dict[str, Any]) -> list[str]:
    alone = world["physics_alone"]
    seconds = (world["preparation_cpu_s"], world["work_cpu_s"], world["referee_cpu_s"], alone["cpu_s"])
    return [
        f"seed {world['world']['seed']}",
        world["verdict"],
        *(f"{value:.1f} s" for value in seconds),
        f"{alone['ratio']:.2f}",
        f"{alone['ratio_without_pictures']:.2f}",
        f"{alone['same']} of {alone['stretches']} stretches",
    ]


def _stages(found: dict[str, Any]) -> str:
    """CPU s of each stage, the mean of the worlds."""
    worlds = found["worlds"]
    several = zip(*(world["stages"] for world in worlds), strict=True)
    rows = [("preparation", [world["preparation"] for world in worlds])]
    rows += [(stages[0]["stage"], [*stages]) for stages in several]
    rows.append(("work", [world["components"] for world in worlds]))
    return _table(["stage", "all", *COLUMNS], [_stage(name, each) for name, each in rows])


def _stage(name: str, each: Sequence[dict[str, float]]) -> list[str]:
    columns = [("cpu_s",), *(tuple(f"{part}_cpu_s" for part in parts) for parts in COLUMNS.values())]
    means = (sum(one[field] for one in each for field in fields) / len(each) for fields in columns)
    return [name, *(f"{mean:.2f}" for mean in means)]


def _totals(found: dict[str, Any]) -> str:
    worlds, memory = found["worlds"], found["peak_memory_mib"]
    rows = [
        ["start of the process", f"{found['start_cpu_s']:.1f} CPU s"],
        ["planning", f"{found['planning_cpu_s']:.1f} CPU s"],
        ["accepted", f"{found['accepted']} of {len(worlds)}"],
        ["accepted pumps per processor hour", f"{found['accepted_per_core_hour']:.0f}"],
        ["simulated time per CPU second of work", f"{found['simulated_s_per_cpu_s']:.1f} s"],
        ["greatest memory", "not measured" if memory is None else f"{memory:.0f} MiB"],
        [
            "cost of measuring, per world",
            f"{sum(world['account_cpu_s'] for world in worlds) / len(worlds):.2f} CPU s",
        ],
    ]
    return _table(["", ""], rows)


def growth(found: dict[str, Any]) -> str:
    """Tables of how the cost grows."""
    grown = found["grown"]
    counted = dict.fromkeys(each["of"] for each in grown)
    return "\n".join(_grown(of, [each for each in grown if each["of"] == of]) for of in counted)


def _grown(of: str, grown: Sequence[dict[str, Any]]) -> str:
    """A table of measurements at the same sizes; the last column is the cost of each further one."""
    head = [of, *(f"{size:,}" for size in grown[0]["sizes"]), "power", "each further one"]
    return _table(head, [_one(each) for each in grown])


def _one(each: dict[str, Any]) -> list[str]:
    unit = next(unit for unit in UNITS if unit in each)
    values, sizes = each[unit], each["sizes"]
    more = (values[-1] - values[0]) / (sizes[-1] - sizes[0])
    return [
        f"{each['what']}, {UNITS[unit]}",
        *map(_figure, values),
        f"{each['power']:.2f}",
        _small(more, unit),
    ]


def _small(value: float, unit: str) -> str:
    """A small number of CPU seconds, or of MiB."""
    if unit == "cpu_s":
        return f"{value * 1e6:,.0f} µs" if value < 0.01 else f"{value * 1e3:,.0f} ms"
    return f"{value * 2**10:,.1f} KiB" if value < 1 else f"{value:.0f} MiB"


def _figure(value: float) -> str:
    return f"{value:,.0f}" if value >= 100 else f"{value:.2f}" if value >= 1 else f"{value:.4f}"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


if __name__ == "__main__":
    measured, grown = (json.loads(Path(name).read_text(encoding="utf-8")) for name in sys.argv[1:])
    tables = speed(measured) + "\n" + growth(grown)
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8"), tables), encoding="utf-8")
