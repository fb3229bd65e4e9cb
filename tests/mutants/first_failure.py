"""A plugin of pytest: writes down as JSON which test failed first, and how long the tests of each file took."""

import json
import os
from collections import Counter
from importlib.util import find_spec
from pathlib import Path
from typing import Final

import pytest

PLACE: Final = "FIRST_FAILURE"
"""The variable of the environment that names the file to write."""


class FirstFailure:
    """Listens to the reports of a session."""

    def __init__(self) -> None:
        self.failed: str | None = None
        self.seconds: Counter[str] = Counter()

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed:
            self.failed = self.failed or report.nodeid

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.seconds[report.nodeid.partition("::")[0]] += report.duration
        if report.failed:
            self.failed = self.failed or report.nodeid

    def pytest_sessionfinish(self) -> None:
        package = find_spec("handeye")  # not imported: a fault may keep it from that
        code = "" if package is None or package.origin is None else str(Path(package.origin).parents[1])
        told = {"failed": self.failed, "seconds": self.seconds, "code": code}
        Path(os.environ[PLACE]).write_text(json.dumps(told), encoding="utf-8")


def pytest_configure(config: pytest.Config) -> None:
    config.pluginmanager.register(FirstFailure(), "first-failure-listener")
