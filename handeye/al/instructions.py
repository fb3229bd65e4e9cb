"""The table of instructions, from which parser, checker, formatter and manual derive.

Words and meanings of the period: Bolles and Paul, AIM-220 (1973), and what is left of the arm program's
manual. What the period does not document and we added in its spirit has `ours` set.
"""

from typing import Final

from handeye.al.definition import (
    DEG,
    IN,
    IN_PER_S,
    MIN_POSITIVE,
    NIL,
    ONE,
    OZ,
    OZ_IN,
    REV_PER_MIN,
    Instruction,
    Operand,
    Refers,
    Role,
)
from handeye.al.operand_kinds import (
    ALONG,
    ERROR,
    LENS,
    MOMENT,
    STEP,
    STEPS,
    TIMES,
    also,
    count,
    gap,
    name_of,
    named_vector,
    number,
    vector,
    word,
)
from handeye.al.syntax import Name, Number, Text, Vector
from handeye.program.motion_operations import VIAS

MAX_COUNT: Final = 1000


_NIL = word(NIL, ours=False)
_COUNTER = Operand(name="counter", takes=(Name,), refers=Refers.COUNTER)
_LABEL = name_of("label", Refers.LABEL)
_PICTURE = name_of("picture", Refers.PICTURE)
_PART = name_of("part", Refers.PART)
_COMPARED = (_PART, name_of("before", Refers.PICTURE), name_of("after", Refers.PICTURE))
_ALL = ("MOVE", "CHANGE", "TURN", "PARK")

MOTIONS, MODIFIER_GROUP, HAND_WORDS, FLOW = "Motions", "Modifiers", "Hand", "Flow"
PLACES, TOOL, VISION, RUN = "Positions", "Tool and load", "Vision", "Order of the work"

_TABLE = (
    Instruction(
        op="MOVE",
        group=MOTIONS,
        help="go to a position: up first, over it, and down; with DIRECT, straight there",
        operands=(name_of("position", Refers.POSITION), word("DIRECT")),
        role=Role.MOTION,
    ),
    Instruction(
        op="CHANGE",
        group=MOTIONS,
        help="move straight from the present place: direction in table coordinates, inches, inches a second "
        "(0: the usual speed)",
        operands=(
            named_vector(ONE),
            Operand(name="distance", takes=(Number,), units=(IN,), nonzero=True),
            _NIL,
            number("speed", IN_PER_S, 0.0, optional=True, ours=True),
            Operand(
                name="0",
                takes=(Number,),
                units=(ONE,),
                low=0.0,
                high=0.0,
                why="its meaning of 1977 is lost; only 0 is known to change nothing",
                optional=True,
            ),
        ),
        role=Role.MOTION,
    ),
    Instruction(
        op="PLACE",
        group=MOTIONS,
        help="lower the hand, at most 3 in, until it meets the least force that is surely felt; else error 23",
        role=Role.MOTION,
    ),
    Instruction(op="PARK", group=MOTIONS, help="go to the position called PARK", role=Role.MOTION),
    Instruction(
        op="TURN",
        group=MOTIONS,
        help="move on a circle about the vertical through a position, degrees counter-clockwise",
        operands=(name_of("position", Refers.POSITION), number("angle", DEG)),
        role=Role.MOTION,
        ours=True,
    ),
    Instruction(
        op="STOP",
        group=MODIFIER_GROUP,
        help="end the next motion when the hand presses along the vector with more than its length (oz), "
        "or, for one number (ours), when anything opposes the motion with more; or when it exerts "
        "more than the moment (oz-in); else error 23",
        operands=(
            Operand(
                name="force",
                takes=(Vector, Number, Name),
                units=(OZ, OZ, OZ),
                low=MIN_POSITIVE,
                why=f"it must be at least {MIN_POSITIVE:g} oz",
                nil=True,
                refers=Refers.VECTOR,
            ),
            MOMENT,
        ),
        role=Role.MODIFIER,
        fits=_ALL,
    ),
    Instruction(
        op="FORCE",
        group=MODIFIER_GROUP,
        help="press with this force (oz) and turn with this moment (oz-in) during the next CHANGE",
        operands=(
            Operand(name="force", takes=(Vector, Name), units=(OZ,) * 3, nil=True, refers=Refers.VECTOR),
            MOMENT,
        ),
        role=Role.MODIFIER,
        fits=("CHANGE",),
    ),
    Instruction(
        op="FREE",
        group=MODIFIER_GROUP,
        help="give way to force along these table axes during the next CHANGE: 1 or 0 each, or `2 X Y`",
        operands=(vector(x=ONE, y=ONE, z=ONE),),
        axes=True,
        role=Role.MODIFIER,
        fits=("CHANGE",),
    ),
    Instruction(
        op="SPIN",
        group=MODIFIER_GROUP,
        help="give way to a moment about these table axes during the next CHANGE: 1 or 0 each, or `2 X Y`",
        operands=(vector(x=ONE, y=ONE, z=ONE),),
        axes=True,
        role=Role.MODIFIER,
        fits=("CHANGE",),
    ),
    Instruction(
        op="VIA",
        group=MODIFIER_GROUP,
        help="on the way to the goal of the next MOVE, pass these positions, in this order, without stopping",
        operands=(name_of("position", Refers.POSITION), *[also("position", Refers.POSITION)] * (VIAS - 1)),
        role=Role.MODIFIER,
        fits=("MOVE", "PARK"),
        ours=True,
    ),
    Instruction(
        op="TOUCH",
        group=MODIFIER_GROUP,
        help="end the next motion when a finger touches something: 1 is the finger on the side that angle O "
        "points to, 2 the other, 3 either; else error 25",
        operands=(count("mask", 1, 3, "1 and 2 are the fingers, 3 is either"),),
        role=Role.MODIFIER,
        fits=_ALL,
    ),
    Instruction(
        op="TORQUE",
        group=MODIFIER_GROUP,
        help="end the next motion when the screwdriver turns with this torque (oz-in); else error 24",
        operands=(number("torque", OZ_IN, MIN_POSITIVE),),
        role=Role.MODIFIER,
        fits=_ALL,
        ours=True,
    ),
    Instruction(
        op="RESTORE",
        group=MOTIONS,
        help="shift the goal of the MOVE just before by a saved difference; with LEVEL, only horizontally",
        operands=(name_of("name", Refers.SAVED), word("LEVEL")),
        role=Role.SHIFT,
    ),
    Instruction(
        op="OPEN", group=HAND_WORDS, help="drive the fingers to this gap (in)", operands=(gap("gap"),)
    ),
    Instruction(
        op="CLOSE",
        group=HAND_WORDS,
        help="close on something; error 2 on nothing or less than the minimum (in), 7 on more than the maximum",
        operands=(gap("minimum", optional=True), gap("maximum", optional=True, ours=True)),
    ),
    Instruction(
        op="CENTER",
        group=HAND_WORDS,
        help="close without pushing the thing: the arm gives way; error 2 on nothing or less than the minimum (in)",
        operands=(gap("minimum", optional=True),),
    ),
    Instruction(
        op="SKIPE",
        group=FLOW,
        help="skip the next instruction if the last action raised this error; clears it",
        operands=(ERROR,),
        role=Role.SKIP,
    ),
    Instruction(
        op="SKIPN",
        group=FLOW,
        help="skip the next instruction if the last action did not raise this error; clears it",
        operands=(ERROR,),
        role=Role.SKIP,
    ),
    Instruction(
        op="SEARCH",
        group=FLOW,
        help="start a spiral search with this step (in), or one along a line in a direction, degrees from table x; "
        "the present place is the first; it extends three steps to each side, four along a line, or so many",
        operands=(STEP, ALONG, STEPS),
    ),
    Instruction(
        op="AOJ",
        group=FLOW,
        help="go to the next place of the search (error 6: there is none) and jump back to the label",
        operands=(_LABEL,),
        role=Role.JUMP,
    ),
    Instruction(
        op="ASSIGN",
        group=FLOW,
        help="set a counter",
        operands=(
            name_of("counter", Refers.NEW),
            count("value", 0, MAX_COUNT, f"a counter is set to 0 to {MAX_COUNT}"),
        ),
    ),
    Instruction(
        op="SOJG",
        group=FLOW,
        help="subtract one from a counter, and jump to the label while it is still positive",
        operands=(_COUNTER, _LABEL),
        role=Role.JUMP,
    ),
    Instruction(op="JUMP", group=FLOW, help="continue at the label", operands=(_LABEL,), role=Role.JUMP),
    Instruction(
        op="WAIT",
        group=FLOW,
        help="set the brakes and show the operator a text; without an operator the run ends there",
        operands=(Operand(name="text", takes=(Text,), free=True),),
    ),
    Instruction(
        op="UNDO",
        group=FLOW,
        help="have the arm undo its stage and begin it anew, once or so many times; then go on",
        operands=(word("STAGE", optional=False), TIMES),
        ours=True,
    ),
    Instruction(
        op="TRANS",
        group=PLACES,
        help="define a hand position: x, y, z (in), angles O, A, T (degrees); in table coordinates, or a part's",
        operands=(
            name_of("name", Refers.NEW),
            vector(x=IN, y=IN, z=IN, o=DEG, a=DEG, t=DEG),
            Operand(name="part", takes=(Name,), refers=Refers.PART, word="OF", optional=True, ours=True),
        ),
        role=Role.DECLARATION,
    ),
    Instruction(
        op="VECT",
        group=PLACES,
        help="define a vector for STOP, FORCE and CHANGE, in the unit of its place: ounces, ounce-inches or none; "
        "X, Y and Z are predefined",
        operands=(name_of("name", Refers.NEW), vector(x=ONE, y=ONE, z=ONE)),
        role=Role.DECLARATION,
    ),
    Instruction(
        op="SAVE",
        group=PLACES,
        help="save where the hand is, less where the last MOVE was to bring it; after CENTER only along the "
        "finger line",
        operands=(name_of("name", Refers.NEW),),
    ),
    Instruction(
        op="HERE",
        group=PLACES,
        help="define a position as where the hand is; a taught position of a part stays on that part",
        operands=(name_of("name", Refers.NEW),),
    ),
    Instruction(
        op="WHERE", group=PLACES, help="show where the hand is, as `TRANS` writes it: inches and degrees"
    ),
    Instruction(
        op="TRAVEL",
        group=PLACES,
        help="check how far (in) the last CHANGE or PLACE went; error 8 outside the range",
        operands=(number("minimum", IN, 0.0), number("maximum", IN, 0.0)),
        ours=True,
    ),
    Instruction(
        op="HEIGHT",
        group=PLACES,
        help="check how much higher (in) the hand has come to a stop than where SAVE took the name; error 9 outside "
        "the range",
        operands=(name_of("name", Refers.SAVED), number("minimum", IN), number("maximum", IN)),
        ours=True,
    ),
    Instruction(
        op="TOOL",
        group=TOOL,
        help="run the screwdriver (rpm, positive drives in); 0 is off",
        operands=(number("speed", REV_PER_MIN),),
        ours=True,
    ),
    Instruction(
        op="LOAD",
        group=TOOL,
        help="declare the weight in the hand (oz), so that the arm carries it",
        operands=(number("weight", OZ, 0.0),),
        ours=True,
    ),
    Instruction(
        op="LENS",
        group=VISION,
        help="turn the lens turret to the 25 or the 50 mm lens",
        operands=(LENS,),
        ours=True,
    ),
    Instruction(
        op="AIM",
        group=VISION,
        help="point the camera at a position or a part, and focus",
        operands=(name_of("name", Refers.TARGET),),
        ours=True,
    ),
    Instruction(
        op="LOOK",
        group=VISION,
        help="take a picture; with HOLD, at the target voltage of the one before",
        operands=(name_of("picture", Refers.NEW), word("HOLD")),
        ours=True,
    ),
    Instruction(
        op="GENERAL",
        group=VISION,
        help="find the part's outline in the picture; error 30 when it is not seen",
        operands=(_PART, _PICTURE),
        ours=True,
    ),
    Instruction(
        op="SPECIFIC",
        group=VISION,
        help="find the part's holes in the picture; error 31 when they are not seen",
        operands=(_PART, _PICTURE),
        ours=True,
    ),
    Instruction(
        op="INSPECT",
        group=VISION,
        help="compare two pictures and check that the part lies where it should; error 32 when it does not",
        operands=_COMPARED,
        ours=True,
    ),
    Instruction(
        op="MATCH",
        group=VISION,
        help="compare two pictures and check that the part stands as it stood; error 33 when it does not",
        operands=_COMPARED,
        ours=True,
    ),
    Instruction(
        op="REQUIRE",
        group=RUN,
        help="read a file of instructions, as if its lines stood here; its path is relative to this file",
        operands=(Operand(name="file", takes=(Text,), free=True),),
        role=Role.DECLARATION,
    ),
    Instruction(
        op="STAGE",
        group=RUN,
        help="begin a stage of the work, under this name in the reports",
        operands=(Operand(name='"name"', takes=(Text,)),),
        role=Role.DECLARATION,
        ours=True,
    ),
)

INSTRUCTIONS: Final[dict[str, Instruction]] = {instruction.op: instruction for instruction in _TABLE}
DEFINE: Final = Instruction(
    op="DEFINE",
    group=RUN,
    help="begin a macro, perhaps with parameters, for which each call gives operands; a blank line ends it",
    operands=(
        name_of("name", Refers.NEW),
        Operand(name="parameter ...", takes=(Name,), optional=True, ours=True),
    ),
    role=Role.DECLARATION,
)
EXPLAINED: Final = INSTRUCTIONS | {DEFINE.op: DEFINE}


FREE_TEXT: Final = [i.op for i in INSTRUCTIONS.values() if any(o.free for o in i.operands)]
SKIPS: Final = [i.op for i in INSTRUCTIONS.values() if i.role is Role.SKIP]
JUMPS: Final = [i.op for i in INSTRUCTIONS.values() if any(o.refers is Refers.LABEL for o in i.operands)]
MODIFIERS: Final = [i.op for i in INSTRUCTIONS.values() if i.role in (Role.MODIFIER, Role.SHIFT)]
OTHERS: Final = [op for op in INSTRUCTIONS if op not in (*FREE_TEXT, *JUMPS, *MODIFIERS)]
OPERAND_WORDS: Final = sorted({o.word for i in INSTRUCTIONS.values() for o in i.operands if o.word})
