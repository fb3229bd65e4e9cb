"""A script is sewn of several files, and every mistake is shown in its own."""

from collections.abc import Mapping
from pathlib import Path

import pytest
from al_support import TAUGHT, codes, diagnose
from hypothesis import given
from hypothesis import strategies as st

from handeye import al
from handeye.core.diagnostics import as_json, render
from handeye.core.source import LARGEST, Source
from handeye.program.program import Program

MACRO = "DEFINE DROP\nSTOP 50\nCHANGE [0 0 -1] 1\n\n"


def sewn(text: str, files: Mapping[str, str]) -> Source:
    return al.sewn_of(Source(name="plans/test.al", text=text), files)


def compiled(text: str, files: Mapping[str, str]) -> Program:
    program, diagnostics = al.compile_text(sewn(text, files), TAUGHT)
    assert program is not None, diagnostics
    return program


def places(program: Program) -> list[str]:
    return [f"{step.place} {step.text}" for step in program.steps]


def shown(text: str, files: Mapping[str, str]) -> str:
    source = sewn(text, files)
    return "\n".join(render(d, source) for d in al.compile_text(source, TAUGHT)[1])


def notes(text: str, files: Mapping[str, str]) -> tuple[str, ...]:
    (diagnostic,) = diagnose(text, files)
    return diagnostic.notes


# -- what is read ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("file", ["a.al", '"a.al"', "a.al ;as always", "./a.al", "lib/../a.al"])
def test_lines_of_a_required_file_stand_where_it_is_required(file: str) -> None:
    program = compiled(f"PARK\nREQUIRE {file}\nMOVE P", {"a.al": "; a\nMOVE T\nOPEN 1"})
    assert places(program) == ["1 PARK", "a.al:2 MOVE T", "a.al:3 OPEN 1", "3 MOVE P"]


def test_a_path_with_backslashes_is_told_what_divides_folders() -> None:
    assert "help: separate folders with `/`: `lib/a.al`" in shown("REQUIRE lib\\a.al", {"lib/a.al": "PARK"})


def test_blanks_in_a_file_s_name_need_no_quotes() -> None:
    assert codes("REQUIRE two words.al", {"two words.al": "PARK"}) == []


def test_required_macros_vectors_positions_and_stages_are_there() -> None:
    files = {"a.al": f'{MACRO}VECT D [0 0 -9]\nTRANS A [1 2 3 0 0 0]\nSTAGE "two"\nPARK'}
    program = compiled("MOVE A\nDROP\nCHANGE D 1\nREQUIRE a.al\nDROP", files)
    assert program.stages == ("program", "two")
    assert places(program)[1] == "a.al:3 CHANGE [0 0 -1] 1"
    assert "A" in program.positions


def test_a_required_file_may_use_what_stands_in_the_text() -> None:
    assert codes(f"{MACRO}L: REQUIRE a.al\nJUMP L", {"a.al": "DROP\nSKIPE 23\nJUMP END\nEND: PARK"}) == [
        "endless-loop"
    ]


def test_files_are_looked_for_beside_the_one_that_requires_them() -> None:
    files = {"lib/a.al": "REQUIRE b.al\nREQUIRE ../c.al", "lib/b.al": "PARK", "c.al": "MOVE T"}
    assert places(compiled("REQUIRE lib/a.al", files)) == ["lib/b.al:1 PARK", "c.al:1 MOVE T"]


def test_the_program_keeps_the_texts_of_what_it_requires() -> None:
    files = {"a.al": "PARK\n", "unused.al": "PARK"}
    program = compiled("REQUIRE a.al\nMOVE T", files)
    assert (program.source, program.required) == ("REQUIRE a.al\nMOVE T", {"a.al": "PARK\n"})


def test_a_modifier_before_a_required_file_modifies_its_first_motion() -> None:
    assert codes("STOP 50\nREQUIRE a.al", {"a.al": "CHANGE [0 0 -1] 1"}) == []


def test_a_skip_before_a_required_file_skips_its_first_instruction() -> None:
    program = compiled("CLOSE .1\nSKIPE 2\nREQUIRE a.al\nPARK", {"a.al": "OPEN 1\nOPEN 2"})
    test = program.steps[1]
    assert (test.next, getattr(test.operation, "raised", None)) == (2, 3)


# -- mistakes -------------------------------------------------------------------------------------------


def test_mistake_of_a_required_file_is_shown_in_its_own_frame() -> None:
    assert shown("PARK\nREQUIRE lib/a.al", {"lib/a.al": "\n\nOPEN 9\n"}) == (
        "error[number-out-of-range]: `9` is too large for the gap of `OPEN`\n"
        " ┌─ plans/lib/a.al:3:6\n"
        " │\n"
        "3│ OPEN 9\n"
        " │      ^ a gap must be between 0 and 4.13 in"
    )


def test_mistake_across_two_files_shows_both() -> None:
    assert shown("L: PARK\nREQUIRE a.al\nJUMP L", {"a.al": "MOVE T\nL: PARK"}) == (
        "error[label-twice]: label `L` is defined twice\n"
        " ┌─ plans/a.al:2:1\n"
        " │\n"
        "2│ L: PARK\n"
        " │ ^\n"
        " ├─ plans/test.al:1:1\n"
        " │\n"
        "1│ L: PARK\n"
        " │ - first here"
    )


def test_json_form_names_the_file_of_each_place() -> None:
    source = sewn("L: PARK\nREQUIRE a.al\nJUMP L", {"a.al": "MOVE T\nL: PARK"})
    (diagnostic,) = al.compile_text(source, TAUGHT)[1]
    found = as_json(diagnostic, source)
    assert found["file"] == "plans/a.al"
    assert found["primary"] == {"file": "plans/a.al", "line": 2, "column": 1, "end": 2, "text": ""}
    assert found["secondary"] == [
        {"file": "plans/test.al", "line": 1, "column": 1, "end": 2, "text": "first here"}
    ]


def test_warnings_of_required_files_are_found() -> None:
    assert codes("REQUIRE a.al", {"a.al": "L: PARK\nSKIPE 42\nPARK"}) == [
        "unused-label",
        "unknown-error-number",
    ]


def test_a_required_file_may_make_things_for_other_scripts() -> None:
    text = f"{MACRO}VECT D [0 0 1]\nTRANS A [1 2 3 0 0 0]\nPARK"
    assert codes("REQUIRE a.al", {"a.al": text}) == []
    assert codes(text) == ["unused-macro", "unused-vector", "unused-position"]


def test_macro_of_a_required_file_ends_with_the_file() -> None:
    text = shown("REQUIRE a.al\nPARK", {"a.al": "DEFINE DROP\nPARK"})
    assert "plans/a.al:1:8" in text
    assert "the text ends inside the macro" in text


def test_a_file_that_is_not_there_is_named_with_the_reason() -> None:
    assert notes("REQUIRE lib/a.al\nPARK", {}) == ("lib/a.al: there is no such file",)


def test_what_a_missing_file_may_have_made_is_not_told_as_unknown() -> None:
    assert codes("REQUIRE a.al\nDROP\nMOVE HERE9\nJUMP L\nOPEN 9", {}) == [
        "unreadable-file",
        "number-out-of-range",
    ]


def test_a_text_in_no_file_requires_none() -> None:
    (diagnostic,) = al.compile_text(Source(name="x.al", text="REQUIRE a.al\nPARK"), TAUGHT)[1]
    assert (diagnostic.code, diagnostic.notes) == (
        "unreadable-file",
        ("this text has not been saved as a file",),
    )


@pytest.mark.parametrize("own", ["test.al", "./test.al"])
def test_a_file_that_requires_itself_is_told_so(own: str) -> None:
    (diagnostic,) = diagnose(f"REQUIRE {own}\nPARK", {})
    assert diagnostic.code == "require-circle"
    assert diagnostic.message == "`test.al` requires itself"


def test_a_circle_is_told_with_its_way() -> None:
    files = {"a.al": "REQUIRE b.al", "b.al": "PARK\nREQUIRE a.al"}
    assert notes("REQUIRE a.al", files) == ("`a.al` requires `b.al`, which requires `a.al`",)


def test_a_long_circle_is_told_shortly() -> None:
    files = {f"{n}.al": f"REQUIRE {(n + 1) % 50}.al" for n in range(50)}
    (note,) = notes("REQUIRE 0.al\nPARK", files)
    assert note.startswith("`0.al` requires `1.al`, which requires `2.al`, which requires …")
    assert note.endswith("which requires `0.al`")


def test_a_file_read_before_is_read_no_more() -> None:
    files = {"a.al": "PARK", "b.al": "REQUIRE a.al\nMOVE T"}
    (diagnostic,) = diagnose("REQUIRE a.al\nREQUIRE b.al", files)
    assert diagnostic.message == "`a.al` is already required above, so this line has no effect"
    assert places(compiled("REQUIRE a.al\nREQUIRE b.al", files)) == ["a.al:1 PARK", "b.al:2 MOVE T"]


def test_many_warnings_are_no_errors() -> None:
    assert compiled("REQUIRE a.al\n" * 30, {"a.al": "PARK"}).steps


def test_a_chain_of_a_thousand_files_is_too_much() -> None:
    files = {f"{n}.al": f"REQUIRE {n + 1}.al" for n in range(1000)} | {"1000.al": "PARK"}
    (diagnostic,) = diagnose("REQUIRE 0.al\nPARK", files)
    assert diagnostic.code == "too-much-required"
    assert diagnostic.message == (
        f"the script requires more than 100 files, or more than {LARGEST} characters in all"
    )


def test_a_chain_that_another_program_has_sewn_is_too_much() -> None:
    chain = tuple(Source(name="", key=f"{n}.al", text=f"REQUIRE {n + 1}.al") for n in range(1000))
    found = al.compile_text(Source(name="x.al", text="REQUIRE 0.al\nPARK", required=chain), TAUGHT)[1]
    assert [d.code for d in found] == ["too-much-required"]


def test_files_too_large_together_are_too_much() -> None:
    files = {f"{n}.al": ";\n" * (LARGEST // 4) for n in range(4)}
    assert codes("REQUIRE 0.al\nREQUIRE 1.al\nREQUIRE 2.al\nREQUIRE 3.al\nPARK", files) == [
        "too-much-required"
    ]


def test_a_macro_requires_no_file() -> None:
    assert codes("DEFINE A\nREQUIRE a.al\n\nA", {"a.al": "PARK"})[0] == "require-in-macro"


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("REQUIRE", "missing-operand"),
        ('REQUIRE "a', "unterminated-string"),
        ('REQUIRE ""', "unreadable-file"),
    ],
)
def test_require_needs_a_file(text: str, code: str) -> None:
    assert codes(f"{text}\nPARK") == [code]


# -- files on disk --------------------------------------------------------------------------------------


def write(folder: Path, files: Mapping[str, str]) -> Path:
    for name, text in files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    return folder / "main.al"


def reasons(main: Path) -> list[str]:
    found = al.compile_text(al.read_script(main), TAUGHT)[1]
    return [note.replace(str(main.parent), "…") for diagnostic in found for note in diagnostic.notes]


def test_files_on_disk_are_read_from_the_script_s_folder(tmp_path: Path) -> None:
    main = write(tmp_path, {"main.al": "REQUIRE lib/a.al", "lib/a.al": "REQUIRE b.al", "lib/b.al": "PARK"})
    program, diagnostics = al.compile_text(al.read_script(main), TAUGHT)
    assert diagnostics == []
    assert program is not None
    assert list(program.required) == ["lib/a.al", "lib/b.al"]


@pytest.mark.parametrize(
    ("file", "reason"),
    [
        ("none.al", "…/none.al: there is no such file"),
        (".", "… is a directory, not a file"),
        ("/dev/zero", "/dev/zero is a device or a pipe, not a file"),
        ("latin.al", "…/latin.al is not UTF-8 text: byte 0 is 0xe9"),
        ("large.al", f"…/large.al has 10000000 bytes; the limit is {LARGEST}"),
        ("a\0b", "a\0b: there is no such file"),
    ],
)
def test_what_is_no_readable_text_is_told_with_the_reason(tmp_path: Path, file: str, reason: str) -> None:
    (tmp_path / "latin.al").write_bytes(b"\xe9")
    (tmp_path / "large.al").write_bytes(b";" * 10_000_000)
    main = write(tmp_path, {"main.al": f"REQUIRE {file}\nPARK"})
    assert [r.removeprefix("…/") for r in reasons(main)] == [reason.removeprefix("…/")]


def test_a_circle_of_folders_ends(tmp_path: Path) -> None:
    main = write(tmp_path, {"main.al": "REQUIRE in/a.al\nPARK", "a.al": "REQUIRE in/a.al"})
    (tmp_path / "in").symlink_to(tmp_path, target_is_directory=True)
    found = al.compile_text(al.read_script(main), TAUGHT)[1]
    assert [d.code for d in found] == ["unreadable-file"]


# -- whatever files there are ---------------------------------------------------------------------------

NAMES = ["a.al", "b.al", "c.al", "test.al", "d/a.al", "d/b.al", "..", "é.al", "none.al"]
WRITTEN = st.sampled_from(
    [
        *(f"REQUIRE {name}" for name in NAMES),
        "REQUIRE",
        "DEFINE M",
        "",
        "M",
        "L: PARK",
        "JUMP L",
        "OPEN 9",
        "\x00",
    ]
)
TEXTS = st.lists(WRITTEN, max_size=6).map("\n".join)


@given(TEXTS, st.dictionaries(st.sampled_from(NAMES[:-1]), TEXTS))
def test_no_tree_of_files_makes_the_compiler_fail(text: str, files: dict[str, str]) -> None:
    source = sewn(text, files)
    program, diagnostics = al.compile_text(source, TAUGHT)
    assert (program is None) == any(d.severity == "error" for d in diagnostics)
    assert all(render(d, source) and as_json(d, source) for d in diagnostics)
