"""Collects planning findings, one for each wrong position."""

from dataclasses import dataclass, field

from handeye.core.codes import CODES
from handeye.program.diagnosis.plan_findings import PlanFinding


@dataclass(slots=True)
class FindingList:
    """Findings in text order, one for each code and position."""

    findings: list[PlanFinding] = field(default_factory=list)
    _reported: set[tuple[str, str]] = field(default_factory=set)

    def add(self, finding: PlanFinding) -> None:
        """Add a finding, unless its position has one of that code."""
        if finding.position is not None:
            if (finding.code, finding.position) in self._reported:
                return
            self._reported.add((finding.code, finding.position))
        self.findings.append(finding)

    @property
    def is_fatal(self) -> bool:
        """True if there is no plan."""
        return any(CODES[finding.code].severity == "error" for finding in self.findings)
