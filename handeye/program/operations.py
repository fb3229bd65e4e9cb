"""The operations of a program, in SI units, of no particular language.

Each says itself what it reads, writes, raises and guards, and where it may lead: a new one is a class in one of these
modules, and an action in the working phase.
"""

from handeye.program.flow_operations import FlowOperation
from handeye.program.motion_operations import MotionOperation
from handeye.program.vision_operations import VisionOperation

AnyOperation = MotionOperation | FlowOperation | VisionOperation
