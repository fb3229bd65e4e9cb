"""Converts events and servo periods to the messages of a trace, in the order in which the trace stores them."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms

from handeye.core.units import INCHES
from handeye.execution.servo import ServoPeriod
from handeye.ports.camera import Picture
from handeye.program.event_reading import EventReader
from handeye.program.events import Event, PictureTaken, RunStarted, StageFinished, StepStarted
from handeye.trace import messages
from handeye.trace.channels import (
    ANNOTATIONS,
    EVENTS,
    FRAMES,
    HAND,
    JOINTS,
    LOG,
    MACHINES,
    PICTURE,
    SCENE,
    nanoseconds,
)
from handeye.trace.frames import Frames, Mask
from handeye.trace.hand_message import channels_message, hand_message
from handeye.trace.mcap_writer import GrowingFile
from handeye.trace.messages import Poses, annotations
from handeye.trace.moved_frames import Figures, MovedFrames
from handeye.trace.records import RawMessage, event_data
from handeye.trace.sentences import level_of, measures_of, sentence
from handeye.vision.marks import Mark

BOUNDARIES: Final = (RunStarted, StageFinished)  # events after which a run may be resumed


class TraceWriter:
    """Writes the messages of a trace to a file.

    The writer's state can be derived from the messages, so the writer can continue after messages that were
    copied from another file. Messages that belong to an event (sentence, picture, frames) precede the event, so
    a trace can be cut after any event.
    """

    def __init__(self, file: GrowingFile, frames: Frames, plan: bytes) -> None:
        self.file, self._frames, self._plan = file, frames, plan
        self.events = 0  # number of events written
        self.head: RunStarted | None = None
        self._measures = INCHES
        self._reader = EventReader()
        self._place = "", 0  # required file and line of the step under way
        self._taken: dict[str, int] = {}  # when the picture of each name was taken last, ns
        self._moved = MovedFrames(len(frames.names))
        self._joint_message = messages.JointMessage(frames.joints)
        self._frames_message = messages.FramesMessage(frames.names)

    def begin(self, head: RunStarted) -> None:
        """Write everything that precedes the messages in the file."""
        self.head, self._measures = head, measures_of(head.task)
        self.file.begin(head, self._plan)

    def event(self, event: Event) -> None:
        """Write an event, preceded by its sentence."""
        time = nanoseconds(event.time)
        if isinstance(event, RunStarted) and self.head is None:
            self.begin(event)
            self.file.write(SCENE, time, self._frames.scene(time))
        self._note(event)
        assert self.head is not None
        level = level_of(event)
        if level is not None:
            name = self.head.program
            file, line = self._place[0] or name, self._place[1]
            said = messages.log(time, level, sentence(event, self._measures), name=name, file=file, line=line)
            self.file.write(LOG, time, said)
        self.file.write(EVENTS, time, event_data(event), boundary=isinstance(event, BOUNDARIES))
        self.events += 1

    def picture(self, event: PictureTaken, picture: Picture) -> None:
        """Write a picture, still without marks. After this message, the caller writes the event of the picture."""
        time = nanoseconds(event.time)
        self.file.write(PICTURE, time, messages.picture(time, picture))
        self.file.write(
            ANNOTATIONS, time, annotations(time, ())
        )  # without this, the marks of the previous picture would stay

    def found(self, time: float, picture: str, marks: Sequence[Mark]) -> None:
        """Write the marks for what vision found in a picture. The caller must then write the event that reports the
        finding.
        """
        self.file.write(ANNOTATIONS, nanoseconds(time), annotations(self._taken[picture], marks))

    def periods(self, waiting: Sequence[tuple[ServoPeriod, Poses, Mask]]) -> None:
        """Write servo periods. For each period, also write the poses of the frames that have moved."""
        periods, poses, there = zip(*waiting, strict=True)
        for period, moved in zip(
            periods, self._moved.to_write(np.stack(poses), np.stack(there)), strict=True
        ):
            self._period(period)
            self._poses(period.sensed.time, *moved)

    def _period(self, period: ServoPeriod) -> None:
        """Write the readings and commands of a servo period, and the force on the hand."""
        time = nanoseconds(period.sensed.time)
        self.file.write(JOINTS, time, self._joint_message.filled(time, period.sensed, period.effort))
        self.file.write(HAND, time, hand_message(period))
        if period.sensed.channels:
            self.file.write(MACHINES, time, channels_message(period.sensed))

    def frames(self, time: float, poses: Poses, there: Mask) -> None:
        """Write the poses of all frames."""
        ((numbers, figures),) = self._moved.to_write(poses[None], there[None], anew=True)
        self._poses(time, numbers, figures)

    def _poses(self, time: float, numbers: list[int], figures: Figures) -> None:
        if numbers:
            message = self._frames_message.filled(nanoseconds(time), numbers, figures)
            self.file.write(FRAMES, nanoseconds(time), message)

    def _note(self, event: Event) -> None:
        if isinstance(event, StepStarted):
            self._place = event.file, event.line
        elif isinstance(event, PictureTaken):
            self._taken[event.picture] = nanoseconds(event.time)

    def copy(self, message: RawMessage) -> None:
        """Write a message copied from another file."""
        event = self._reader.read(message.data) if message.topic == EVENTS else None
        self.file.write(message.topic, message.time, message.data, boundary=isinstance(event, BOUNDARIES))
        if event is not None:
            self.events += 1
            self._note(event)
        elif message.topic == FRAMES:
            for frame in FrameTransforms.FromString(message.data).transforms:
                place, turn = frame.translation, frame.rotation
                pose = (place.x, place.y, place.z, turn.w, turn.x, turn.y, turn.z)
                self._moved.written[self._frames.names.index(frame.child_frame_id)] = pose
