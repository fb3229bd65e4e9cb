"""All operations, in SI units, independent of any language. To add an operation, define its class in one of these
modules.
"""

from handeye.program.flow_operations import FlowOperation
from handeye.program.motion_operations import MotionOperation
from handeye.program.vision_operations import VisionOperation

AnyOperation = MotionOperation | FlowOperation | VisionOperation
