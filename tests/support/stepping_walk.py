"""The walk in docs/stepping.md: what is typed in it, and what it shows."""

import re
from pathlib import Path

from figures import as_recorded

DOC = (Path(__file__).parents[2] / "docs" / "stepping.md").read_text(encoding="utf-8")
FENCED = re.findall(r"^```(\w*)\n(.*?)^```$", DOC, re.MULTILINE | re.DOTALL)
BLOCKS = [block for language, block in FENCED if not language]
SEED = 0
SAID = "handeye> "


def of_command(words: str) -> list[str]:
    """What the walk shows behind a command of the shell, up to the next."""
    (shown,) = [block.split("\n$ ")[0] for block in BLOCKS if block.startswith(f"$ handeye {words}")]
    return shown.splitlines()[1:]


def pieces(lines: list[str]) -> list[list[str]]:
    """What stands between the dots for lines left out."""
    found: list[list[str]] = [[]]
    for line in lines:
        if line.strip() == "...":
            found.append([])
        else:
            found[-1].append(line)
    return [piece for piece in found if piece]


def stands(piece: list[str], lines: list[str]) -> bool:
    """A piece is there somewhere, line after line."""
    recorded = "\n".join(piece)
    ways = ["\n".join(lines[start : start + len(piece)]) for start in range(len(lines))]
    return any(as_recorded(way, recorded) == recorded for way in ways)


def commands() -> list[str]:
    """The lines that the walk shows of its stepper: what is said, and what is answered."""
    shown = of_command(
        f"run plans/water_pump.plan.json --seed {SEED} --checkpoints pump --from insert --step"
    )
    for block in BLOCKS:
        shown += block.splitlines() if block.startswith(SAID) else []
    return shown
