"""An entrant of the bench for agents: it widens a search until the public worlds accept its program.

    handeye bench agents blind_retry --command "python /path/to/guess_and_check.py" --rounds 5

The bench runs this program in the folder of a task. It understands no brief: it knows one way to put a pin into a hole,
and each time it finds `feedback.md`, it widens the search by one ring. This solves only the tasks in which nothing is
missing but a wider search. In a task of another language, it leaves no program, and so counts as stopped.
"""

import re
from pathlib import Path

BRIEF, FEEDBACK, LEFT, RINGS = Path("brief.md"), Path("feedback.md"), Path("solution.al"), 2
PROGRAM = """\
        OPEN    1
        MOVE    PIN
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    HOLE
        SAVE    ABOVE
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .25 .11
        SKIPN   23
        JUMP    IN
        SAVE    TOUCH
        SEARCH  .07 STEPS {rings}
        AOJ     L
L:      MOVE    LIFT DIRECT
        RESTORE TOUCH
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .12 .11
        SKIPE   23
        AOJ     L
IN:     CHANGE  [0 0 -1] .56 2
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .35 .3
        HEIGHT  ABOVE -.98 -.78
"""

if BRIEF.exists() and "`solution.al`" not in BRIEF.read_text(encoding="utf-8"):
    [given.unlink() for given in Path().glob("solution.*")]
    raise SystemExit("this entrant writes only programs in the arm language")
before = re.search(r"STEPS (\d+)", LEFT.read_text("utf-8")) if FEEDBACK.exists() else None
rings = int(before[1]) + 1 if before else RINGS
LEFT.write_text(PROGRAM.format(rings=rings), encoding="utf-8")
print(f"left {LEFT} with a search of {rings} rings")
