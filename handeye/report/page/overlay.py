"""Prepares data on what the hand sensed. The 3D view draws these data over the cell."""

from typing import Any

from handeye.core.markup import Markup, element
from handeye.core.plain_text import printable
from handeye.report.facts.felt import guarded_motions
from handeye.report.facts.planned import searches
from handeye.report.facts.sensed import held_objects, sensed_forces, tried_places
from handeye.report.page.moments import json_markup
from handeye.report.player.scene import tool_points
from handeye.report.recorded import RecordedRun


def overlay(run: RecordedRun, name: str = "sensed") -> Markup:
    """Return the data on what the hand sensed, as an invisible HTML element with the id `name`."""
    return element("script", json_markup(_sensed(run)), id=name, type="application/json")


def _sensed(run: RecordedRun) -> dict[str, Any]:
    return {
        "tools": tool_points(run.trace.scene),
        "forces": [
            {
                "times": each.times.round(3).tolist(),
                "rows": each.forces.round(2).tolist(),
                "limit": None if each.limit is None else round(each.limit, 2),
            }
            for each in sensed_forces(run)
        ],
        "searches": [
            {"times": [round(time, 3) for time in each.times], "found": each.found}
            for each in tried_places(searches(run), guarded_motions(run))
        ],
        "held": [
            {
                "name": printable(each.name.lower().replace("_", " ")),
                "begin": round(each.begin, 3),
                "end": round(each.end, 3),
            }
            for each in held_objects(run)
        ],
    }
