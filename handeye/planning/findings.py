"""Collects what the planner finds: each wrong position once, however often it is gone to."""

from dataclasses import dataclass, field

from handeye.core.codes import CODES
from handeye.program.findings import PlanningFinding


@dataclass(slots=True)
class FindingList:
    """Findings in the order of the text."""

    found: list[PlanningFinding] = field(default_factory=list)
    _told: set[tuple[str, str]] = field(default_factory=set)
    """Codes and positions: a wrong position is one mistake."""

    def add(self, finding: PlanningFinding) -> None:
        """Take a finding, unless it is about a position that the same has been found of."""
        if finding.position is not None:
            if (finding.code, finding.position) in self._told:
                return
            self._told.add((finding.code, finding.position))
        self.found.append(finding)

    @property
    def is_fatal(self) -> bool:
        """There is no plan."""
        return any(CODES[finding.code].severity == "error" for finding in self.found)
