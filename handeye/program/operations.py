"""All operations, in SI units, independent of language. A new operation is a class in one of these modules."""

from handeye.program.flow_operations import FlowOperation
from handeye.program.motion_operations import MotionOperation
from handeye.program.vision_operations import VisionOperation

AnyOperation = MotionOperation | FlowOperation | VisionOperation
