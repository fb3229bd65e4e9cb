"""What was sensed and put out in the servo periods of a run, as arrays."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from foxglove_schemas_protobuf.JointStates_pb2 import JointStates

from handeye.core.pose import Array
from handeye.trace.messages import GAP
from handeye.trace.records import RawMessage


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Motion:
    """Columns of n servo periods of an arm of m joints, by its sensors."""

    names: tuple[str, ...]
    """Of the joints, in order."""
    times: Array
    """Ends of the periods on the cell's clock, shape (n,), s."""
    joints: Array
    """Positions, shape (n, m), rad and (prismatic joints) m."""
    rates: Array
    """Shape (n, m), rad/s and m/s."""
    efforts: Array
    """Torques put out, shape (n, m), N m and (prismatic joints) N; zero under the brakes."""
    gaps: Array
    """Opening of the fingers, shape (n,), m."""


def read_motion(messages: Iterable[RawMessage]) -> Motion:
    """The columns of messages about joints.

    Raises:
        DecodeError, ValueError: one of them is not such a message, or of another arm than the first.
    """
    times, rows, names = [], [], None
    for message in messages:
        joints = JointStates.FromString(message.data).joints
        names = names or [joint.name for joint in joints]
        if [joint.name for joint in joints] != names:
            raise ValueError("the joints are those of another arm")
        times.append(message.time / 1e9)
        rows.append([(joint.position, joint.velocity, joint.effort) for joint in joints])
    names = names or [GAP]
    gap = names.index(GAP)
    columns = np.array(rows, dtype=np.float64).reshape(len(rows), len(names), 3)
    arm = np.delete(columns, gap, axis=1)
    return Motion(
        names=tuple(name for name in names if name != GAP),
        times=np.array(times),
        joints=arm[:, :, 0],
        rates=arm[:, :, 1],
        efforts=arm[:, :, 2],
        gaps=columns[:, gap, 0],
    )
