"""Hostile texts: `python tests/systems/sigma/fuzz_mal.py 20000` draws more of them."""

from collections.abc import Callable
from pathlib import Path

import pytest
from fuzz_mal import carried_out
from mal_bench import codes

Command = Callable[..., tuple[int, str, str]]


@pytest.mark.slow
def test_whatever_a_text_holds_it_is_refused_or_carried_out_in_words() -> None:
    ends = [carried_out(seed) for seed in range(240)]
    assert {*ends} == {"errors", "ended", "stands", "goes on"}


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (f"10 A = {'(' * 5000}1{')' * 5000}", "long-line"),
        (f"10 A = {'(' * 200}1{')' * 200}", "too-deep"),
        (f"10 A = {'-' * 400}1", "too-deep"),
        (f"10 {'IF 1=1 THEN ' * 40}END", "too-deep"),
        (f"10 IF {'NOT ' * 100}1=1 THEN 10", "too-deep"),
        (f"10 IF {'(' * 100}1=1{')' * 100} THEN 10", "too-deep"),
        (f"10 A = {'9' * 400}", "number-too-large"),
        ("10 A = 1E999999999", "number-too-large"),
        (f"{'9' * 300} END", "number-too-large"),
        (f"{'9' * 20} END", "line-number"),
        ("10.5 END", "line-number"),
        ("1E3 END", "line-number"),
        ("0 END", "line-number"),
        ("10 A = 5\x00", "stray-character"),
        ("10 A = 5\u2028", "stray-character"),
        ("10 ABSCHALTEN = \u0665", "stray-character"),
    ],
)
def test_hostile_texts_get_one_sentence(text: str, code: str) -> None:
    assert codes(text) == [code]


def test_a_line_number_may_be_as_large_as_five_digits_and_lines_as_many() -> None:
    assert codes("\n".join(f"{number} A = 1" for number in range(1, 1000))) == []
    assert codes("99999 END") == []
    assert codes("100000 END") == ["line-number"]


@pytest.mark.parametrize("data", [b"10 END\xff", b"\xff\xfe1\x000\x00", b"10 PRINT \xe4", b"\x00" * 50])
def test_a_file_in_an_odd_encoding_is_refused_in_a_sentence(
    data: bytes, command: Command, tmp_path: Path
) -> None:
    (tmp_path / "odd.mal").write_bytes(data)
    for words in (("sigma", "run"), ("check",), ("sigma", "check"), ("fmt",)):
        code, out, err = command(*words, "odd.mal")
        assert code == 2
        assert "Traceback" not in out + err
        assert err.strip()
