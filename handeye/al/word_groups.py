"""Words of the language in the groups that colours go by, each in the order of the table of instructions."""

from typing import Final

from handeye.al.definition import Refers, Role
from handeye.al.instructions import FREE, INSTRUCTIONS

FREE_TEXT: Final = [op for op in INSTRUCTIONS if op in FREE]
"""Take words up to the end of the line."""
JUMPS: Final = [i.op for i in INSTRUCTIONS.values() if any(o.refers is Refers.LABEL for o in i.operands)]
"""Take a label."""
MODIFIERS: Final = [i.op for i in INSTRUCTIONS.values() if i.role in (Role.MODIFIER, Role.SHIFT)]
"""Change the motion after them, or the one before."""
OTHERS: Final = [op for op in INSTRUCTIONS if op not in (*FREE_TEXT, *JUMPS, *MODIFIERS)]
OPERAND_WORDS: Final = sorted({o.word for i in INSTRUCTIONS.values() for o in i.operands if o.word})
"""Stand among operands, such as `OF` and `HOLD`."""
