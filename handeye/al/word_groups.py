"""Words of the language by what they do, each group in the order of the table of instructions."""

from typing import Final

from handeye.al.definition import Refers, Role
from handeye.al.instructions import INSTRUCTIONS

FREE_TEXT: Final = [i.op for i in INSTRUCTIONS.values() if any(o.free for o in i.operands)]
"""Take words up to the end of the line."""
SKIPS: Final = [i.op for i in INSTRUCTIONS.values() if i.role is Role.SKIP]
"""Test an error, and leave the next statement out or not."""
JUMPS: Final = [i.op for i in INSTRUCTIONS.values() if any(o.refers is Refers.LABEL for o in i.operands)]
"""Take a label."""
MODIFIERS: Final = [i.op for i in INSTRUCTIONS.values() if i.role in (Role.MODIFIER, Role.SHIFT)]
"""Change the motion after them, or the one before."""
OTHERS: Final = [op for op in INSTRUCTIONS if op not in (*FREE_TEXT, *JUMPS, *MODIFIERS)]
OPERAND_WORDS: Final = sorted({o.word for i in INSTRUCTIONS.values() for o in i.operands if o.word})
"""Stand among operands, such as `OF` and `HOLD`."""
