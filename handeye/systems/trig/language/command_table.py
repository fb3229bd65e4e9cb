"""The table of TRIG's commands, each with its arguments, action and help."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from handeye.systems.trig.language import (
    arm_commands,
    program_commands,
    step_commands,
)
from handeye.systems.trig.language.arguments import Arguments, Kind
from handeye.systems.trig.language.session import Session


@dataclass(frozen=True, slots=True, kw_only=True)
class TrigCommand:
    """A command of TRIG with its help. `needs` is the number of required arguments."""

    usage: str
    takes: tuple[Kind, ...] = ()
    needs: int = 0
    act: Callable[[Session, Arguments], None]
    help: str
    group: str

    @property
    def word(self) -> str:
        return self.usage.partition(" ")[0]


ARM: Final = "drive the arm without changing the program"
STEPS: Final = "add a step below the active step"
CHANGES: Final = "change steps"
POSITIONS: Final = "define positions"
CURSOR: Final = "move the cursor"
RUNS: Final = "run, save, leave"

TABLE: Final = (
    TrigCommand(
        usage="FREE", group=ARM, act=arm_commands.free, help="drive the arm with the teach box until you press record"
    ),
    TrigCommand(
        usage="GOPOS [-]POS", group=ARM, takes=("signed",), needs=1, act=arm_commands.go, help="go to a position"
    ),
    TrigCommand(
        usage="GOGPOS [-]POS", group=ARM, takes=("signed",), needs=1, act=arm_commands.feel,
        help="go to a position slowly; a force on the finger stops the arm",
    ),
    TrigCommand(usage="GOGRASP", group=ARM, act=arm_commands.close, help="close the hand"),
    TrigCommand(usage="GOUNGRASP", group=ARM, act=arm_commands.open, help="open the hand"),
    TrigCommand(
        usage="M [[-]POS [n|g]]", group=STEPS, takes=("signed", "branch"), act=step_commands.move(None),
        help="move to a position; if the position is new, you teach it, and it takes its kind (absolute or "
        "relative) from the nearest move above",
    ),
    TrigCommand(
        usage="MA [POS [n|g]]", group=STEPS, takes=("position", "branch"), act=step_commands.move("absolute"),
        help="move to an absolute position",
    ),
    TrigCommand(
        usage="MR [[-]POS [n|g]]", group=STEPS, takes=("signed", "branch"), act=step_commands.move("relative"),
        help="move by a relative position",
    ),
    TrigCommand(
        usage="MG [[-]POS [n|g]]", group=STEPS, takes=("signed", "branch"), act=step_commands.move(None, guarded=True),
        help="like M, but slow and guarded: a force on the finger stops the move, and the program continues on the "
            "guarded branch",
    ),
    TrigCommand(
        usage="MAG [POS [n|g]]", group=STEPS, takes=("position", "branch"),
        act=step_commands.move("absolute", guarded=True), help="like MA, but slow and guarded",
    ),
    TrigCommand(
        usage="MRG [[-]POS [n|g]]", group=STEPS, takes=("signed", "branch"),
        act=step_commands.move("relative", guarded=True), help="like MR, but slow and guarded",
    ),
    TrigCommand(usage="GRASP", group=STEPS, act=step_commands.hand(True), help="close the hand"),
    TrigCommand(usage="UNGRASP", group=STEPS, act=step_commands.hand(False), help="open the hand"),
    TrigCommand(
        usage="SAVPOS POS [n|g]", group=STEPS, takes=("position", "branch"), needs=1, act=step_commands.save,
        help="during a run, set a position to the place where the arm is",
    ),
    TrigCommand(
        usage="LOOP STEP COUNT", group=STEPS, takes=("step", "count"), needs=2, act=step_commands.loop,
        help="go back COUNT times to STEP, so the steps of the loop are done COUNT + 1 times; then continue",
    ),
    TrigCommand(
        usage="L STEP [n|g]", group=STEPS, takes=("step", "branch"), needs=1, act=step_commands.link,
        help="continue at an existing step; LINK is the same command",
    ),
    TrigCommand(
        usage="CN STEP", group=CHANGES, takes=("step",), needs=1, act=step_commands.rename,
        help="name the active step",
    ),
    TrigCommand(
        usage="CP POS", group=CHANGES, takes=("position",), needs=1, act=step_commands.change_position,
        help="change the position of the active step",
    ),
    TrigCommand(
        usage="CT THRESHOLD", group=CHANGES, takes=("threshold",), needs=1, act=step_commands.change_threshold,
        help="change the threshold of the active guarded step, in ounces",
    ),
    TrigCommand(
        usage="CV (X Y Z)", group=CHANGES, takes=("vector",), needs=1, act=step_commands.change_vector,
        help="change the force vector of the active guarded step",
    ),
    TrigCommand(
        usage="D [STEP [n|g]]", group=CHANGES, takes=("step", "branch"), act=step_commands.delete,
        help="delete a step; for a guarded step, n or g is the branch to keep",
    ),
    TrigCommand(
        usage="DA [STEP]", group=CHANGES, takes=("step",), act=step_commands.delete_all,
        help="delete a step and all steps that can be reached only through it",
    ),
    TrigCommand(
        usage="DLINK STEP [n|g]", group=CHANGES, takes=("step", "branch"), needs=1, act=step_commands.unlink,
        help="remove the link from the active step to STEP, provided that another step also leads to STEP",
    ),
    TrigCommand(usage="FLUSH", group=CHANGES, act=step_commands.flush, help="erase the program"),
    TrigCommand(
        usage="HERE POS", group=POSITIONS, takes=("position",), needs=1, act=arm_commands.here,
        help="name the present position of the arm",
    ),
    TrigCommand(
        usage="SA POS", group=POSITIONS, takes=("position",), needs=1, act=arm_commands.here, help="the same as HERE"
    ),
    TrigCommand(
        usage="SR POS", group=POSITIONS, takes=("position",), needs=1, act=arm_commands.here_relative,
        help="give a name to the move from the end of the last step to the present place of the arm",
    ),
    TrigCommand(
        usage="CALPOS", group=POSITIONS, act=arm_commands.begin_way, help="remember the place of the arm for ENDCAL"
    ),
    TrigCommand(
        usage="ENDCAL POS", group=POSITIONS, takes=("position",), needs=1, act=arm_commands.end_way,
        help="give a name to the move from the place remembered by CALPOS to the present place of the arm",
    ),
    TrigCommand(
        usage="N [COUNT]", group=CURSOR, takes=("count",), act=program_commands.next_step, help="go down COUNT steps"
    ),
    TrigCommand(
        usage="P [COUNT]", group=CURSOR, takes=("count",), act=program_commands.previous_step,
        help="go up COUNT steps; from a step with several parents, go to the parent that was active last",
    ),
    TrigCommand(
        usage="GOTO STEP", group=CURSOR, takes=("step",), needs=1, act=program_commands.goto, help="go to a named step"
    ),
    TrigCommand(
        usage="RUN [COUNT]", group=RUNS, takes=("count",), act=program_commands.run,
        help="run the program from the top; with COUNT, run COUNT steps from the active step; with a negative "
        "COUNT, undo steps",
    ),
    TrigCommand(usage="W [FILE]", group=RUNS, takes=("file",), act=program_commands.write,
        help="write the program to a file"),
    TrigCommand(
        usage="R FILE", group=RUNS, takes=("file",), needs=1, act=program_commands.read,
        help="read a program from a file, replacing the present program",
    ),
    TrigCommand(
        usage="EX FILE", group=RUNS, takes=("file",), needs=1, act=program_commands.leave_written,
        help="write the program to a file and leave",
    ),
    TrigCommand(usage="Q", group=RUNS, act=program_commands.leave, help="leave without writing"),
)  # fmt: skip  # the 37 commands of the paper's appendix
COMMANDS: Final = {command.word: command for command in TABLE}
SYNONYMS: Final = {"LINK": "L"}  # the paper's text uses this name for a command of its appendix
