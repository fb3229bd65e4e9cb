"""The type of all operations. Operations use SI units and depend on no language. To add an operation, define its class
in one of the modules imported here.
"""

from handeye.program.flow_operations import FlowOperation
from handeye.program.motion_operations import MotionOperation
from handeye.program.vision_operations import VisionOperation

AnyOperation = MotionOperation | FlowOperation | VisionOperation
