"""Sets up the run of the chess experiment: its program, and the pieces on its board."""

from typing import Final

from handeye.core.resources import plans
from handeye.core.source import read_source
from handeye.core.variation import WorldSpec
from handeye.runs.setup import Setup
from handeye.systems.sigma import ENTRY
from handeye.systems.sigma.run.plan import MalPlan

PROGRAM: Final = "chess.mal"


def chess_plan(pieces: int) -> MalPlan:
    """Return the plan for a board with this number of pieces."""
    text = read_source(plans() / PROGRAM).text
    return MalPlan(name=PROGRAM, text=text, arm="gantries", pieces=pieces)


def chess_setup(pieces: int, world: WorldSpec) -> Setup:
    """Return the setup of a run of the chess experiment."""
    return Setup(system=ENTRY.name, plan=chess_plan(pieces), world=world, camera="auto", judged=True)
