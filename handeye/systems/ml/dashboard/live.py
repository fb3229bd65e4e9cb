"""The tables of a running machine, for the live page of its run."""

import msgspec
import numpy as np

from handeye.core.markup import PagePart, element, note, section
from handeye.runs.system import LiveNews
from handeye.systems.ml.dashboard.history import Head
from handeye.systems.ml.dashboard.layout import segments
from handeye.systems.ml.dashboard.page import dashboard, facts, own_file
from handeye.systems.ml.dashboard.tape import Changes, TapeRecorder, changes_of
from handeye.systems.ml.realtime.machine import Machine
from handeye.systems.ml.run.channels import level_channels

_Y = 3  # the motor whose position is drawn at first


class LiveTables(LiveNews):
    """All changes of the tables since the beginning of the run. A page that has shown only some of the changes asks
    for the missing ones.
    """

    def __init__(self, head: Head, machine: Machine, recorder: TapeRecorder) -> None:
        self._machine, self._recorder = machine, recorder
        self._log: list[Changes] = []
        motors = next(each for each in segments(head.sides) if each.table == "MT")
        value = element(
            "input", id="tables-word", type="number", min="-32768", max="32767", step="1", required=True,
            aria_label="new value of the word",
        )  # fmt: skip
        form = element(
            "form", value, element("button", "Write", type="submit"), id="tables-write", class_="controls"
        )
        content = section(
            "tables",
            "The tables",
            note(
                "Words that changed in the cycle are highlighted. Click a word to plot its values over time. A value "
                "that you write takes effect in the next cycle, even while the arm moves."
            ),
            dashboard(form),
            facts(head, picked=motors.number(_Y, 1)),
        )
        script = own_file("dashboard.js") + own_file("live.js")
        self.channels = {part for channel in level_channels(machine.levels) for part in channel.parts}
        self.part = PagePart(content, style=own_file("dashboard.css"), script=script)
        self.restart()
        recorder.hear = self._hear

    def restart(self) -> None:
        """Begin again with the changes that are on the tape."""
        self._log = [*changes_of(self._recorder.tape)]

    def _hear(self, changes: Changes) -> None:
        self._log.append(changes)

    def since(self, seen: object) -> tuple[object, str] | None:
        log = self._log  # this list is replaced when the run goes back
        count = len(log)
        known, told = seen if isinstance(seen, tuple) else (None, 0)
        if known is log and told == count:
            return None
        new = log[told if known is log else 0 : count]
        changes = np.concatenate([*new, np.empty((0, 3), dtype=np.int32)]).ravel().tolist()
        message = {"tables": changes, "passed": self._machine.now - 1, "restarted": known is not log}
        return (log, count), msgspec.json.encode(message).decode()
