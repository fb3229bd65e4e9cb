"""TRIG programs in files: what is written, what is read back, and what is refused."""

import json
import random
from contextlib import suppress
from pathlib import Path

import pytest
from trig_sessions import PALLETISE, Typist

from handeye.core.errors import InvalidInput
from handeye.systems.trig.language.display import full_display, partial_display
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.language.storage import decoded, encoded
from handeye.systems.trig.language.styled import plain

MAJOR = {
    "id", "type", "name", "position", "negate", "sons", "links", "fathers", "last_father", "threshold", "vector",
    "loop", "comment",
}  # fmt: skip
WRITTEN = encoded(Typist(PALLETISE).session.program)


def displays(program: TrigProgram) -> str:
    """Both displays, with the cursor at the top."""
    program.cursor = 0
    return plain([*full_display(program, 80, 10), *partial_display(program, 80, 50)])


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.trig_row(32)
@pytest.mark.usefixtures("place")
def test_a_program_that_is_read_looks_as_it_was_written() -> None:
    typist = Typist(PALLETISE + "W f")
    before = displays(typist.session.program)
    typist.type("FLUSH")
    assert typist.steps == []
    typist.type("R f")
    assert displays(typist.session.program) == before
    file = json.loads(Path("f.trig.json").read_bytes())
    assert set(file) == {"trig", "units", "positions", "nodes"}
    assert {key for node in file["nodes"] for key in node} == MAJOR
    typist.type("W again")
    again = json.loads(Path("again.trig.json").read_bytes())
    assert (again["nodes"], {**again["positions"], "PALLET": 0}) == (
        file["nodes"],
        {**file["positions"], "PALLET": 0},
    )


@pytest.mark.trig_row(33)
def test_ex_writes_and_leaves_and_q_leaves_only(place: Path) -> None:
    typist = Typist("GRASP\nEX f\nGRASP")
    assert (typist.session.over, len(typist.steps), [p.name for p in place.iterdir()]) == (
        True,
        1,
        ["f.trig.json"],
    )
    written = Path("f.trig.json").read_bytes()
    typist = Typist("R f\nGRASP\nQ")
    assert (typist.session.over, Path("f.trig.json").read_bytes(), len([*place.iterdir()])) == (
        True,
        written,
        1,
    )


@pytest.mark.usefixtures("place")
def test_what_is_not_written_is_not_lost_unasked() -> None:
    typist = Typist("GRASP\nW f\nUNGRASP\nR f\nNo\nFLUSH\nNo")
    assert len(typist.steps) == 2
    typist.type("R f\nYes")
    assert len(typist.steps) == 1


def test_a_run_changes_data_and_a_program_that_is_read_begins_with_what_was_defined() -> None:
    typist = Typist(PALLETISE)
    pallet = typist.session.program.positions["PALLET"]
    assert pallet.data != pallet.init
    read = decoded(encoded(typist.session.program), "f")
    assert (read.positions["PALLET"].data, read.positions["PALLET"].init) == (pallet.init, pallet.init)


def test_a_program_that_was_read_runs_as_before() -> None:
    typist = Typist("* STACK 20 X 150 Y 0")
    typist.session.program = decoded(WRITTEN, "f")
    typist.type("RUN")
    assert typist.told[-1] == "227 steps done; the program has ended"


def test_what_this_version_does_not_know_is_kept() -> None:
    file = json.loads(WRITTEN)
    file["author"] = "me"
    file["positions"]["DONE"]["colour"] = "red"
    file["nodes"][1]["speed"] = 3
    again = json.loads(encoded(decoded(json.dumps(file).encode(), "f")))
    assert (again["author"], again["positions"]["DONE"]["colour"], again["nodes"][1]["speed"]) == (
        "me",
        "red",
        3,
    )


@pytest.mark.usefixtures("place")
def test_an_unwritable_place_and_a_foreign_file_are_refused() -> None:
    Path("mine.trig.json").write_text('{"mine": 1}', encoding="utf-8")
    typist = Typist("GRASP")
    for line, sentence in {
        "W mine": "mine.trig.json exists and is not a TRIG program; nothing was written",
        "W nowhere/f": "nowhere/f.trig.json cannot be written: No such file or directory",
        "R nothing": "nothing.trig.json: there is no such file",
        "R mine": "mine.trig.json is not a TRIG program",
    }.items():
        with pytest.raises(InvalidInput) as error:
            typist.type(line)
        assert str(error.value) == sentence
    assert (len(typist.steps), typist.session.program.changed) == (1, True)


def forged(path: str, value: object) -> bytes:
    """The palletiser with one thing in it replaced: `nodes.3.sons` and so on; without a value, taken out."""
    file = json.loads(WRITTEN)
    *way, last = path.split(".")
    there = file
    for key in way:
        there = there[int(key) if isinstance(there, list) else key]
    if value is None:
        del there[int(last) if isinstance(there, list) else last]
    else:
        there[int(last) if isinstance(there, list) else last] = value
    return json.dumps(file).encode()


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [
        ("trig", 2, "has version 2; this version of handeye reads 1"),
        ("units.length", "inch", "has units other than mm, deg, oz"),
        ("nodes.3.sons", [5], "step 5 does not name its father 3"),
        ("nodes.3.sons", [99], "step 3 leads to step 99, which does not exist"),
        ("nodes.3.sons", [], "step 3 is bloop and has 0 sons"),
        ("nodes.3.sons", None, "step 3: Object missing required field `sons`"),
        (
            "nodes.3.loop",
            {"bloop": 1, "target": 1, "wanted": 1, "count": 0},
            "step 3, of type bloop, must not have loop data",
        ),
        ("nodes.21.loop", None, "step 21, of type loop, needs loop data"),
        ("nodes.21.loop.bloop", 1, "has no partner"),
        ("nodes.21.loop.wanted", -4, "has a count of -4, but has gone back 0 times"),
        ("nodes.4.type", "jump", "step 4: Invalid enum value 'jump'"),
        ("nodes.4.type", "top", "not numbered consecutively from the top"),
        ("nodes.4.type", "none", "step 4 cannot have the type none"),
        ("nodes.4.id", 5, "not numbered consecutively from the top"),
        ("nodes.4.name", "FINISH", "two steps are called FINISH"),
        ("nodes.4.name", "a name", "step 4 has a name that is not valid"),
        ("nodes.4.position", "NOWHERE", "step 4, of type normal, needs a position"),
        (
            "nodes.4.negate",
            True,
            "step 4 uses the opposite of an absolute position, but only a relative position has an opposite",
        ),
        ("nodes.6.threshold", -1, "step 6 has a threshold below 0"),
        ("nodes.6.vector", [0, 0], "step 6: Expected `array` of length 3, got 2"),
        ("nodes.6.links", [5], "step 6 has a link without a target"),
        ("nodes.0", None, "not numbered consecutively from the top"),
        ("nodes.0.sons", [-1], "step 1 names the father 0, but step 0 does not lead to step 1"),
        ("positions.PALLET.init", [1, 2, 3], "Expected `array` of length 6, got 3"),
        ("positions.PALLET.relative", True, "saves a relative position"),
        ("positions.PALLET.data", [1e30, 0, 0, 0, 0, 0], "is too far away"),
        ("positions", [], "Expected `object`, got `array`"),
    ],
)
def test_a_forged_file_is_refused_in_a_sentence(path: str, value: object, sentence: str) -> None:
    with pytest.raises(InvalidInput) as error:
        decoded(forged(path, value), "f")
    assert sentence in str(error.value)
    assert str(error.value).startswith("f ")
    assert "\n" not in str(error.value)


def test_a_file_that_is_cut_short_anywhere_is_refused() -> None:
    for length in range(0, len(WRITTEN) - 2, 7):
        with pytest.raises(InvalidInput, match=r"^f is not a TRIG program"):
            decoded(WRITTEN[:length], "f")


@pytest.mark.parametrize(
    "content", [b"", b"[]", b"null", b"\xff\xfe", b'{"trig": true}', b"[" * 100_000, b'{"trig": 1}']
)
def test_what_is_no_program_is_refused(content: bytes) -> None:
    with pytest.raises(InvalidInput, match=r"^f is n"):
        decoded(content, "f")


def test_any_byte_may_be_wrong() -> None:
    chance = random.Random(1973)  # noqa: S311 - no secret
    for _ in range(500):
        content = bytearray(WRITTEN)
        for _ in range(chance.randint(1, 3)):
            content[chance.randrange(len(content))] = chance.randrange(256)
        try:
            program = decoded(bytes(content), "f")
        except InvalidInput:
            continue
        typist = Typist()
        typist.session.program = program
        with suppress(InvalidInput):
            typist.type("RUN 50\nRUN -50\nGOTO FINISH\nP 3\nDA")
        displays(typist.session.program)
