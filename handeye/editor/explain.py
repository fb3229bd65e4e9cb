"""Explains codes, instructions and error numbers: which instructions raise each error, and how a script can
handle it."""

from dataclasses import dataclass
from functools import cache
from textwrap import fill, indent
from typing import Final

from handeye.al import extensions
from handeye.al.compiler import compile_text
from handeye.al.definition import Instruction
from handeye.al.formatter import format_text
from handeye.al.includes import sewn_of
from handeye.al.instructions import EXPLAINED
from handeye.al.operand_help import part, takes
from handeye.core import errors
from handeye.core.codes import CODES
from handeye.core.diagnostics import WIDTH, Diagnostic, quoted, render, suggestion
from handeye.core.errors import ERRORS, NoSuchName
from handeye.core.resources import page
from handeye.core.source import Source
from handeye.editor.samples import SAMPLE
from handeye.program.language import own_languages

_FOUND: Final = {
    "language": "while the script is checked",
    "planning": "when its motions are planned",
    "strict": "only by `handeye check --strict-1973`",
    "proof": "only by `handeye check --prove`",
}
_NUMBERS: Final = {str(number): number for number in ERRORS}
SENTENCE_WIDTH: Final = 100  # columns
_MAX_FILES = 2  # of the files that an example requires: at most this many are shown


def explanation(word: str) -> str:
    """Return the explanation of a code, error number or instruction. Raises NoSuchName if the word is unknown; the
    message suggests the nearest name.
    """
    if word in CODES:
        return _code(word)
    if word.upper() in EXPLAINED:
        return _instruction(EXPLAINED[word.upper()])
    if (number := word.lstrip("0")) in _NUMBERS:
        return error_text(_NUMBERS[number])
    for language in own_languages():
        if (text := language.explanation(word)) is not None:
            return text
    near = suggestion(word, {*CODES, *EXPLAINED, *map(str, ERRORS)}) or suggestion(
        word, [code for code in CODES if word.lower() in code]
    )
    raise NoSuchName(
        f"there is no code, error number or instruction {quoted(word)}"
        + (f"; {near}" if near else "; `handeye explain` lists the codes")
    )


def listing() -> str:
    """Return three lists with meanings: the codes of errors, the codes of warnings, and the error numbers."""
    width = max(map(len, CODES))
    out = []
    for severity in ("error", "warning"):
        out.append(f"{severity}s in a script")
        out += [f"  {c:<{width}}  {e.meaning}" for c, e in sorted(CODES.items()) if e.severity == severity]
        out.append("")
    out.append("error numbers that a script can test")
    out += [f"  {number:>2}  {meaning}" for number, meaning in sorted(ERRORS.items())]
    return "\n".join(out)


def _instruction(definition: Instruction) -> str:
    width = max((len(operand.shown) for operand in definition.operands), default=0)
    operands = [
        f"  {operand.shown:{width}}  {takes(definition, operand)} ({definition.origin_of(operand)})"
        for operand in definition.operands
    ]
    more = f"More and examples: {page(f'language/reference/{definition.op.lower()}.md')}"
    said = [definition.usage, "", definition.help, "", *operands, *[""] * bool(operands)]
    return "\n".join([*said, part(definition), more])


def _code(code: str) -> str:
    entry = CODES[code]
    out = [f"{entry.severity}[{code}]: {entry.meaning}", f"found {_FOUND[entry.phase]}", "", "for example"]
    out += ["", *(f"    {line}".rstrip() for line in _shortened(entry.example.split("\n"))), ""]
    for file, text in [*entry.required.items()][:_MAX_FILES]:
        out += [f"where {file} says", "", *(f"    {line}".rstrip() for line in text.split("\n")), ""]
    if len(entry.required) > _MAX_FILES:
        out += ["and so on", ""]
    source, diagnostic = example(code)
    if diagnostic is not None:
        # none of this is needed for numbers and instructions
        from handeye.editor.document import Document
        from handeye.editor.fix import cured
        from handeye.editor.fixes import fixes

        out += ["gives", "", *(f"    {line}".rstrip() for line in render(diagnostic, source).split("\n")), ""]
        cures = fixes(Document(source=source, taught=SAMPLE), diagnostic)
        if cures and not cures[0].choice:
            becomes = cured(source.text, cures[0]).rstrip("\n").split("\n")
            out += [f"cure: {cures[0].title}", "", *(f"    {line}".rstrip() for line in _shortened(becomes))]
    return "\n".join(out).rstrip()


def _shortened(lines: list[str], most: int = 16) -> list[str]:
    shown = [line if len(line) <= WIDTH else f"{line[:WIDTH]}..." for line in lines]
    return shown if len(shown) <= most else [*shown[: most - 4], "...", *shown[-3:]]


@cache
def example(code: str) -> tuple[Source, Diagnostic | None]:
    """Return the example of a code, and the diagnostic that the example causes. The second value is None if the
    example alone causes no diagnostic with this code.
    """
    source = sewn_of(Source(name="example.al", text=CODES[code].example), CODES[code].required)
    program, found = compile_text(source, SAMPLE)
    if program is not None:
        from handeye.editor.checking import planning

        found = [*found, *planning(program)]
    if CODES[code].phase == "strict":
        found = [*found, *extensions(source)]
    if CODES[code].phase == "proof" and program is not None:
        from handeye.editor.checking import proving

        found = [*found, *proving(program)]
    return source, next((diagnostic for diagnostic in found if diagnostic.code == code), None)


@dataclass(frozen=True, slots=True)
class Remedy:
    """How a script can handle an error, with an example."""

    advice: str
    example: str


REMEDIES: Final[dict[int, Remedy]] = {
    errors.JOINT_LIMIT: Remedy(
        "The planner reports this error for a planned position. During a run, the error occurs when a part lies "
        "farther away than planned. Test for the error in the program, so that the arm can take another path.",
        "MOVE T\nSKIPE 1 ;T is too far away\nJUMP NEAR\nMOVE P\nNEAR: OPEN 1",
    ),
    errors.NOTHING_HELD: Remedy(
        "Give CLOSE or CENTER a minimum gap. If there is nothing between the fingers, open the hand and try "
        "elsewhere, or ask the "
        "operator.",
        'MOVE P\nCLOSE .1\nSKIPN 2 ;something is in the hand\nWAIT "NO PIN THERE"\nMOVE T',
    ),
    errors.NO_SOLUTION: Remedy(
        "The planner reports this error for a planned position. During a run, the error occurs when the camera "
        "sees a part that is too far away. In that case, leave that part alone.",
        "MOVE T\nSKIPE 3 ;T is out of reach\nJUMP NEAR\nMOVE P\nNEAR: OPEN 1",
    ),
    errors.SERVO_LAG: Remedy(
        "The hand has met an object where none was expected, or the joint that the message names does not follow "
        "its set-point. If you expect contact, give the motion a STOP, so that the contact ends the motion; "
        "otherwise ask the operator.",
        'MOVE T\nCHANGE [0 0 -1] .5\nSKIPN 4 ;nothing is in the way\nWAIT "CLEAR THE TABLE"\nMOVE P',
    ),
    errors.WATCHDOG: Remedy(
        "The computer failed; the work did not fail. Either do not test for this error, or test for it and call "
        "the operator with a WAIT.",
        'MOVE T\nSKIPN 5 ;the computer kept up\nWAIT "THE COMPUTER WAS LATE"\nMOVE P',
    ),
    errors.SEARCH_EXHAUSTED: Remedy(
        "A search has 49 places, or another number if the SEARCH has STEPS. If you do not test for this error, the "
        "error calls the operator. The call is usually right, because the hole lies outside the searched places. "
        "To give up sooner, count the places with SOJG.",
        "ASSIGN TRIES 9\nSEARCH .07\nL: MOVE T\nSTOP [0 0 -50]\nCHANGE [0 0 -1] .7\nSKIPN 23 ;it met something\n"
        'JUMP IN\nSOJG TRIES NEXT\nWAIT "NO HOLE HERE"\nNEXT: AOJ L\nIN: OPEN 1',
    ),
    errors.WRONG_THICKNESS: Remedy(
        "Give CLOSE not only a minimum gap but also a maximum gap. If the part is too thick, it is the wrong part: "
        "release it.",
        "MOVE P\nCLOSE .1 .3\nSKIPE 7 ;too thick for a pin\nJUMP HELD\nOPEN 1\nHELD: PARK",
    ),
    errors.WRONG_TRAVEL: Remedy(
        "A force may end a motion too soon, for example if a pin meets the rim of its hole. TRAVEL checks how far "
        "the hand moved.",
        "MOVE T\nSTOP [0 0 -50]\nCHANGE [0 0 -1] .7\nSKIPE 23 ;nothing was met at all\nJUMP OUT\nTRAVEL .5 .6\n"
        'SKIPN 8 ;as deep as the hole\nOUT: WAIT "NOT IN ITS HOLE"\nOPEN 1',
    ),
    errors.WRONG_HEIGHT: Remedy(
        "HEIGHT compares the heights of two touches at one place, so the error of the arm cancels. If the check "
        "fails, a layer is missing, or a wrong layer is in its place.",
        "OPEN 0\nMOVE T\nSTOP [0 0 -40]\nCHANGE [0 0 -1] .7 .5\nSAVE BARE\nPARK\nMOVE T\nSTOP [0 0 -40]\n"
        'CHANGE [0 0 -1] .7 .5\nHEIGHT BARE .04 .08\nSKIPN 9 ;one gasket thick\nWAIT "SEE TO THE GASKET"\nPARK',
    ),
    errors.NO_FORCE: Remedy(
        "The hand met no resistance. This may be what you want: a pin that meets no resistance is in its hole.",
        "MOVE T\nSTOP [0 0 -50]\nCHANGE [0 0 -1] .7\nSKIPE 23 ;nothing was met: the pin is in\n"
        'WAIT "THERE IS NO HOLE"\nOPEN 1',
    ),
    errors.NO_TORQUE: Remedy(
        "The screw never resisted: it has not engaged its thread, or the driver holds no screw.",
        'MOVE T\nTOOL 100\nTORQUE 42\nCHANGE [0 0 -1] .5\nSKIPN 24 ;it is tight\nWAIT "NOT TIGHT"\nTOOL 0',
    ),
    errors.NO_TOUCH: Remedy(
        "Neither finger met anything: the part is not where the hand felt for it.",
        'MOVE P\nOPEN 1\nTOUCH 3\nCHANGE X 1\nSKIPN 25 ;a finger touches it\nWAIT "NOTHING THERE"\nPARK',
    ),
    errors.PART_NOT_SEEN: Remedy(
        "No object of the part's size is visible in the picture: ask the operator for the part.",
        'LOOK V\nGENERAL BASE V\nSKIPN 30 ;it is there\nWAIT "PUT A BASE ON THE TABLE"\nMOVE P',
    ),
    errors.FEATURES_NOT_SEEN: Remedy(
        "The part is there, but its two largest holes are not visible: it is upside down, or in a shadow.",
        'LOOK V\nGENERAL BASE V\nLOOK W\nSPECIFIC BASE W\nSKIPN 31 ;its holes are found\nWAIT "TURN THE BASE"\nMOVE P',
    ),
    errors.GASKET_WRONG: Remedy(
        "INSPECT compares a picture without the gasket and a picture with the gasket in place. The difference "
        "between these two pictures is not the one that a correctly placed gasket makes. Place the gasket again, "
        "or ask the operator.",
        "LOOK BEFORE HOLD\nMOVE P\nLOOK AFTER HOLD\nINSPECT BASE BEFORE AFTER\nSKIPN 32 ;it is on properly\n"
        'WAIT "CHECK THE GASKET"\nPARK',
    ),
    errors.PART_ASTRAY: Remedy(
        "Either the part has been moved or removed since the earlier picture, or the arm is now in another place "
        "and casts its shadow on the part. Look again, or ask the operator.",
        "LOOK BEFORE\nMOVE P\nLOOK AFTER HOLD\nMATCH BASE BEFORE AFTER\nSKIPN 33 ;it stands as it stood\n"
        'WAIT "SOMEBODY HAS MOVED THE BASE"\nPARK',
    ),
    errors.SWITCH_WRONG: Remedy(
        "A switch that is closed while its finger touches nothing is stuck. If a switch stays open while the "
        "fingers press on a part, either the switch is stuck or the motor of the fingers is weak. The reports of "
        "such a switch are worthless. Either do not test for this error, or test for it and call the operator with "
        "a WAIT.",
        'OPEN 1\nSKIPN 50 ;both switches are open\nWAIT "SEE TO THE FINGER SWITCHES"\nMOVE P\nCLOSE .1',
    ),
    errors.GAP_WRONG: Remedy(
        "If nothing is in the way of the fingers, the potentiometer that measures the gap is broken. In that case, "
        "leave out the test, so that the error calls the operator. If the fingers may meet an object as they open, "
        "open them less. A held part that slips or is pushed also changes the gap.",
        "OPEN 1.8\nSKIPN 51 ;the fingers reached their gap\nOPEN 1.5\nMOVE P",
    ),
    errors.FORCE_WRONG: Remedy(
        "The first guarded motion after a MOVE feels a force although the hand should touch nothing. Declare the "
        "weight in the hand with LOAD; after the release, write LOAD 0. If the declared weight was already right, the "
        "force has another cause: an object leans on the hand, or a drive or a tachometer fails.",
        "MOVE P\nCLOSE .1\nLOAD 30 ;else the stop feels the weight\nMOVE T\nSTOP [0 0 -50]\nCHANGE [0 0 -1] .7",
    ),
    errors.JOINT_SENSE_WRONG: Remedy(
        "The arm does not know where it is. Either do not test for the error, or test for it and call the "
        "operator with a WAIT.",
        'MOVE T\nSKIPN 53 ;both sensors of each joint agree\nWAIT "SEE TO THE ARM\'S POTENTIOMETERS"\nMOVE P',
    ),
    errors.CURRENT_WRONG: Remedy(
        "A motor takes current to start. If the current reads zero, no motion reaches its TORQUE, and the program "
        "cannot know whether a screw is tight.",
        "MOVE T\nTOOL 100\nTORQUE 42\nCHANGE [0 0 -1] .5\nSKIPN 54 ;the motor shows current\n"
        'WAIT "SEE TO THE DRIVER"\nTOOL 0',
    ),
    errors.PICTURE_WRONG: Remedy(
        "Because of noise, two pictures taken by a working camera differ, even if the scene is at rest. A picture "
        "that equals an earlier one, or is uniform, does not show the scene. A picture with far more noise than a "
        "working camera produces must not be used for measurement.",
        'LOOK V\nSKIPN 55 ;it is a live picture\nWAIT "SEE TO THE CAMERA"\nGENERAL BASE V',
    ),
    errors.JOINT_STIFF: Remedy(
        "One joint needs far more torque than its friction explains, and no force at the hand could cause the "
        "difference. Either do not test for the error, or test for it and call the operator with a WAIT.",
        'MOVE T\nSKIPN 57 ;each joint needs the same torque as at the start\nWAIT "SEE TO THE ARM\'S DRIVES"\nMOVE P',
    ),
}

_MOTIONS: Final = ("MOVE P", "CHANGE Z 1", "TURN T 10", "PARK", "PLACE")
ACTIONS: Final = "\n".join(
    (
        *_MOTIONS, *(f"{guard}\n{motion}" for guard in ("STOP 9", "TORQUE 42", "TOUCH 3") for motion in _MOTIONS[:-1]),
        "SEARCH .1\nL: MOVE T\nRESTORE H\nAOJ L", "OPEN 1", "CLOSE .1 .3", "CENTER .1", "CHANGE Z 1\nTRAVEL .1 .9",
        "SAVE H\nHEIGHT H .1 .9",
        "LENS 25", "AIM BASE", "LOOK V HOLD", "GENERAL BASE V", "SPECIFIC BASE V", "INSPECT BASE V V", "MATCH BASE "
        "V V",
    )
)  # fmt: skip
"""Every instruction that can raise an error, with all modifiers that let the instruction raise further errors."""


@cache
def raised_by() -> dict[int, tuple[str, ...]]:
    """Return, for each error number, the instructions that can raise this error."""
    program, _ = compile_text(Source(name="actions.al", text=ACTIONS), SAMPLE)
    assert program is not None
    raising = {(number, step.word) for step in program.steps for number in step.operation.raises}
    return {number: tuple(sorted(word for raised, word in raising if raised == number)) for number in ERRORS}


def error_text(number: int) -> str:
    """Return the explanation of an error number, without a final newline."""
    tested = (
        f"SKIPE {number} skips the next instruction if the error was raised; SKIPN {number} skips the next "
        f"instruction if the error was not raised. If neither SKIPE {number} nor SKIPN {number} follows the "
        "instruction that raised the error, the error sets the brakes and calls the operator."
    )
    example = indent(format_text(REMEDIES[number].example).rstrip("\n"), "    ")
    by = fill(f"raised by {', '.join(raised_by()[number])}", SENTENCE_WIDTH, subsequent_indent="    ")
    advice, tested = fill(REMEDIES[number].advice, SENTENCE_WIDTH), fill(tested, SENTENCE_WIDTH)
    return f"error {number}: {ERRORS[number]}\n{by}\n\n{advice}\n\n{tested}\n\nfor example\n\n{example}"
