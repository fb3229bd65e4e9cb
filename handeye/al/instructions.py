"""The table of instructions, from which the parser, the checks, the formatter and the manual are derived.

For each word, the table names the document in which the word was found; `docs/sources.md` describes these documents,
and says which of them are known only from memory. The words without a document are additions of handeye.
"""

from typing import Final

from msgspec.structs import replace

from handeye.al.definition import (
    ALONG,
    DEG,
    ERROR,
    IN,
    IN_PER_S,
    LENS,
    MIN_POSITIVE,
    MOMENT,
    NIL,
    ONE,
    OZ,
    OZ_IN,
    REV_PER_MIN,
    SEARCH_STEP,
    STEPS,
    TIMES,
    Document,
    Instruction,
    Operand,
    Refers,
    Role,
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
_NIL = replace(word(NIL, ours=False), document=Document.LISTING_1977)
_COUNTER = Operand(name="counter", takes=(Name,), refers=Refers.COUNTER)
_LABEL = name_of("label", Refers.LABEL)
_NEW = name_of("name", Refers.NEW)
_POSITION = name_of("position", Refers.POSITION)
_AXES = vector(x=ONE, y=ONE, z=ONE)
_PICTURE = name_of("picture", Refers.PICTURE)
_PART = name_of("part", Refers.PART)
_VALUE = count("value", 0, MAX_COUNT, f"a counter can be set to a value from 0 to {MAX_COUNT}")
_ZERO_WHY = "write 0, which has no effect: we do not know what other numbers meant in 1977"
_ZERO = Operand(name="0", takes=(Number,), units=(ONE,), low=0.0, high=0.0, why=_ZERO_WHY, optional=True)
_ZERO = replace(_ZERO, document=Document.LISTING_1977)
_FORCE = Operand(name="force", takes=(Vector, Name), units=(OZ,) * 3, nil=True, refers=Refers.VECTOR)
_STOP_FORCE = replace(
    _FORCE,
    takes=(Vector, Number, Name),
    low=MIN_POSITIVE,
    why=f"the force must be at least {MIN_POSITIVE:g} oz",
)
_COMPARED = (_PART, name_of("before", Refers.PICTURE), name_of("after", Refers.PICTURE))

MOTIONS, MODIFIER_GROUP, HAND_WORDS, FLOW = "Motions", "Modifiers", "Hand", "Flow"
PLACES, TOOL, VISION, RUN = "Positions", "Tool and load", "Vision", "Order of the work"

_MEANINGS: Final = {
    "MOVE": "go to a position: rise, move across and go down; with DIRECT, go straight to the position",
    "CHANGE": "move from the present place in a straight line: in this direction (table coordinates), by this "
    "distance (inches), at this speed (inches per second; 0 is the usual speed)",
    "PLACE": "lower the hand by at most 3 in, until it meets a force of 50 oz; error 23 if it does not meet this force",
    "PARK": "go to the position called PARK",
    "TURN": "move on a circle about the vertical line through a position, by this angle (degrees; a positive angle is "
    "counter-clockwise)",
    "STOP": (
        "end the next motion when the hand presses along this vector with a force (oz) greater than the length of "
        "the vector. If a moment (oz-in) is given, a greater moment of the hand also ends the motion. A single "
        "number is an extension of handeye: the motion ends when more than this force opposes it, in whatever "
        "direction the hand moves. Error 23 if nothing stops the motion"
    ),
    "FORCE": "press with this force (oz) and turn with this moment (oz-in) during the next CHANGE",
    "FREE": "let the hand yield to forces along the given table axes during the next CHANGE: give 1 (yield) or 0 (stay "
    "stiff) for each axis, or the number of axes that yield and their names, such as `2 X Y`",
    "SPIN": "let the hand yield to moments about the given table axes during the next CHANGE: give 1 (yield) or 0 "
    "(stay stiff) for each axis, or the number of axes that yield and their names, such as `2 X Y`",
    "VIA": "pass these positions during the next MOVE, in this order, without stopping",
    "TOUCH": (
        "end the next motion when a finger touches something: 1 is the finger on the side to which angle O points, "
        "2 the other finger, 3 either finger; error 25 if the motion ends without a touch"
    ),
    "TORQUE": "end the next motion when the screwdriver turns with this torque (oz-in); error 24 if the torque is "
    "never reached",
    "RESTORE": "shift the goal of the preceding MOVE by a saved difference; with LEVEL, only horizontally",
    "OPEN": "open or close the fingers to this gap (inches)",
    "CLOSE": "close the fingers on a part; error 2 if there is no part or the part is thinner than the minimum "
    "(inches), error 7 if the part is thicker than the maximum (inches)",
    "CENTER": "close the fingers on a part without pushing it: the arm moves instead; error 2 if there is no part or "
    "the part is thinner than the minimum (inches)",
    "SKIPE": "if the last action raised this error, clear the error and skip the next instruction",
    "SKIPN": "if the last action did not raise this error, skip the next instruction; if it did, clear the error",
    "SEARCH": (
        "start a search on a square spiral. Its places are one step (inches) apart, with three steps to each side. "
        "With ALONG, the places are on a line in the given direction (degrees from the x axis of the table), with "
        "four steps to each side. STEPS sets a different number of steps"
    ),
    "AOJ": "select the next place of the search and jump back to the label; error 6 if no place is left",
    "ASSIGN": "set a counter",
    "SOJG": "subtract one from a counter, and jump to the label if the counter is still positive",
    "JUMP": "continue at the label",
    "WAIT": "set the brakes and show the operator a text; without an operator the run ends here",
    "UNDO": "make the arm undo this stage, and start the stage again. The UNDO does this once, or at most the given "
    "number of times; after that, the UNDO has no effect, and the program continues",
    "TRANS": "define a hand position by x, y, z (inches) and the angles O, A, T (degrees), in table coordinates or "
    "relative to a part",
    "VECT": "define a vector for STOP, FORCE or CHANGE: a force (oz), a moment (oz-in) or a direction; "
    "X, Y and Z are predefined",
    "SAVE": "save the offset of the hand from the goal of the last MOVE; after CENTER, save only the component of the "
    "offset along the finger line (the line through both finger tips)",
    "HERE": "define a position as the present place of the hand; if the position was taught relative to a part, it "
    "stays relative to that part",
    "WHERE": "show the place of the hand as the six numbers of a `TRANS`, in inches and degrees",
    "TRAVEL": "check how far the hand moved in the last CHANGE, PLACE or CENTER; error 8 if this distance (inches) is "
    "outside the range",
    "HEIGHT": "check how much higher the hand is after the last motion than it was at the SAVE of this name; error 9 "
    "if this difference (inches) is outside the range",
    "TOOL": "run the screwdriver at this speed (rpm): a positive speed drives a screw in, and 0 stops the screwdriver",
    "LOAD": "declare the weight in the hand (oz), so that the arm supports it",
    "LENS": "turn the lens turret to the 25 mm or the 50 mm lens",
    "AIM": "point the camera at a position or a part, and focus",
    "LOOK": "take a picture; with HOLD, at the same target voltage (gain) as the last picture",
    "GENERAL": "find the part's outline in the picture; error 30 if the picture does not show it",
    "SPECIFIC": "find the part's holes in the picture; error 31 if the picture does not show them",
    "INSPECT": "compare two pictures and check that the part is in place; error 32 if it is not",
    "MATCH": "compare two pictures and check that the part has not moved; error 33 if it has",
    "REQUIRE": "read a file of instructions as if its lines were here; the path is relative to the folder of the file "
    "that contains the REQUIRE",
    "STAGE": "begin a stage of the work; reports call the stage by the given name",
    "DEFINE": "begin a macro, which ends at a blank line; a call of the macro gives one operand for each parameter",
}
_GROUPS: Final = {
    MOTIONS: ("MOVE", "CHANGE", "PLACE", "PARK", "TURN", "RESTORE"),
    MODIFIER_GROUP: ("STOP", "FORCE", "FREE", "SPIN", "VIA", "TOUCH", "TORQUE"),
    HAND_WORDS: ("OPEN", "CLOSE", "CENTER"),
    FLOW: ("SKIPE", "SKIPN", "SEARCH", "AOJ", "ASSIGN", "SOJG", "JUMP", "WAIT", "UNDO"),
    PLACES: ("TRANS", "VECT", "SAVE", "HERE", "WHERE", "TRAVEL", "HEIGHT"),
    TOOL: ("TOOL", "LOAD"),
    VISION: ("LENS", "AIM", "LOOK", "GENERAL", "SPECIFIC", "INSPECT", "MATCH"),
    RUN: ("REQUIRE", "STAGE", "DEFINE"),
}
_OPERANDS: Final[dict[str, tuple[Operand, ...]]] = {
    "MOVE": (_POSITION, word("DIRECT")),
    "CHANGE": (
        named_vector(ONE),
        Operand(name="distance", takes=(Number,), units=(IN,), nonzero=True),
        _NIL,
        number("speed", IN_PER_S, 0.0, optional=True, ours=True),
        _ZERO,
    ),
    "TURN": (_POSITION, replace(number("angle", DEG), nonzero=True)),
    "STOP": (_STOP_FORCE, replace(MOMENT, document=Document.MEMORY)),
    "FORCE": (_FORCE, MOMENT),
    "FREE": (_AXES,),
    "SPIN": (_AXES,),
    "VIA": (_POSITION, *[replace(_POSITION, optional=True)] * (VIAS - 1)),
    "TOUCH": (count("mask", 1, 3, "1 and 2 each select one finger, 3 selects both"),),
    "TORQUE": (number("torque", OZ_IN, MIN_POSITIVE),),
    "RESTORE": (name_of("name", Refers.SAVED), word("LEVEL")),
    "OPEN": (gap("gap"),),
    "CLOSE": (gap("minimum", optional=True), gap("maximum", optional=True, ours=True)),
    "CENTER": (replace(gap("minimum", optional=True), document=Document.MEMORY),),
    "SKIPE": (ERROR,),
    "SKIPN": (ERROR,),
    "SEARCH": (SEARCH_STEP, ALONG, STEPS),
    "AOJ": (_LABEL,),
    "ASSIGN": (name_of("counter", Refers.NEW), _VALUE),
    "SOJG": (_COUNTER, _LABEL),
    "JUMP": (_LABEL,),
    "WAIT": (Operand(name="text", takes=(Text,), free=True),),
    "UNDO": (word("STAGE", optional=False), TIMES),
    "TRANS": (
        _NEW,
        vector(x=IN, y=IN, z=IN, o=DEG, a=DEG, t=DEG),
        Operand(name="part", takes=(Name,), refers=Refers.PART, word="OF", optional=True, ours=True),
    ),
    "VECT": (_NEW, _AXES),
    "SAVE": (_NEW,),
    "HERE": (_NEW,),
    "TRAVEL": (number("minimum", IN, 0.0), number("maximum", IN, 0.0)),
    "HEIGHT": (name_of("name", Refers.SAVED), number("minimum", IN), number("maximum", IN)),
    "TOOL": (number("speed", REV_PER_MIN),),
    "LOAD": (number("weight", OZ, 0.0),),
    "LENS": (LENS,),
    "AIM": (name_of("name", Refers.TARGET),),
    "LOOK": (name_of("picture", Refers.NEW), word("HOLD")),
    "GENERAL": (_PART, _PICTURE),
    "SPECIFIC": (_PART, _PICTURE),
    "INSPECT": _COMPARED,
    "MATCH": _COMPARED,
    "REQUIRE": (Operand(name="file", takes=(Text,), free=True),),
    "STAGE": (Operand(name='"name"', takes=(Text,)),),
    "DEFINE": (_NEW, Operand(name="parameter ...", takes=(Name,), optional=True, ours=True)),
}
_ROLES: Final = {
    **dict.fromkeys(("MOVE", "CHANGE", "PLACE", "PARK", "TURN"), Role.MOTION),
    **dict.fromkeys(("STOP", "FORCE", "FREE", "SPIN", "VIA", "TOUCH", "TORQUE"), Role.MODIFIER),
    "RESTORE": Role.SHIFT,
    **dict.fromkeys(("SKIPE", "SKIPN"), Role.SKIP),
    **dict.fromkeys(("AOJ", "SOJG", "JUMP"), Role.JUMP),
    **dict.fromkeys(("TRANS", "VECT", "REQUIRE", "STAGE", "DEFINE"), Role.DECLARATION),
}  # of the instructions that are not plain steps
_FITS: Final = {
    **dict.fromkeys(("STOP", "TOUCH", "TORQUE"), ("MOVE", "CHANGE", "TURN", "PARK")),
    **dict.fromkeys(("FORCE", "FREE", "SPIN"), ("CHANGE",)),
    "VIA": ("MOVE", "PARK"),
}
_GROUP_OF: Final = {op: group for group, ops in _GROUPS.items() for op in ops}
_DOCUMENTS: Final = {
    **dict.fromkeys(
        (
            "MOVE",
            "CHANGE",
            "RESTORE",
            "STOP",
            "OPEN",
            "CLOSE",
            "CENTER",
            "SKIPE",
            "SKIPN",
            "SEARCH",
            "AOJ",
            "SAVE",
        ),
        Document.PAPER_1973,
    ),
    **dict.fromkeys(("PARK", "FREE", "REQUIRE", "DEFINE"), Document.MANUAL_1973),
    **dict.fromkeys(("TRANS", "VECT", "HERE", "WHERE"), Document.MANUAL_1976),
    **dict.fromkeys(("SPIN", "ASSIGN", "SOJG", "JUMP", "WAIT"), Document.LISTING_1977),
    **dict.fromkeys(("PLACE", "FORCE", "TOUCH"), Document.MEMORY),
}  # of the instructions that are not additions of handeye

EXPLAINED: Final = {
    op: Instruction(
        op=op,
        group=_GROUP_OF[op],
        help=help,
        operands=_OPERANDS.get(op, ()),
        role=_ROLES.get(op, Role.STEP),
        axes=op in ("FREE", "SPIN"),
        fits=_FITS.get(op, ()),
        document=_DOCUMENTS.get(op),
    )
    for op, help in _MEANINGS.items()
}
DEFINE: Final = EXPLAINED["DEFINE"]
INSTRUCTIONS: Final = {op: instruction for op, instruction in EXPLAINED.items() if op != DEFINE.op}

FREE_TEXT: Final = [i.op for i in INSTRUCTIONS.values() if any(o.free for o in i.operands)]
SKIPS: Final = [i.op for i in INSTRUCTIONS.values() if i.role is Role.SKIP]
JUMPS: Final = [i.op for i in INSTRUCTIONS.values() if any(o.refers is Refers.LABEL for o in i.operands)]
MODIFIERS: Final = [i.op for i in INSTRUCTIONS.values() if i.role in (Role.MODIFIER, Role.SHIFT)]
OTHERS: Final = [op for op in INSTRUCTIONS if op not in (*FREE_TEXT, *JUMPS, *MODIFIERS)]
OPERAND_WORDS: Final = sorted({o.word for i in INSTRUCTIONS.values() for o in i.operands if o.word})
