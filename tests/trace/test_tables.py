"""A trace as tables: what the columns hold, and the folder they are written to."""

import csv
import json
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import Command
from recordings import EVENTS, record

from handeye.core.errors import InvalidInput
from handeye.trace.reading import read_trace
from handeye.trace.sentences import sentence
from handeye.trace.table import MAX_CELL_CHARS, SHOWN_ROWS, Column, Table
from handeye.trace.tables import csv_bytes, tables
from handeye.trace.trace import Trace


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Trace:
    path = tmp_path_factory.mktemp("tables") / "a.mcap"
    record(path)
    return read_trace(path)


@pytest.fixture(scope="module")
def made(trace: Trace) -> dict[str, Table]:
    """The tables by their names."""
    return {table.name: table for table in tables(trace)}


def column(table: Table, name: str) -> list[object]:
    return list(next(each.values for each in table.columns if each.name == name))


def test_there_is_a_row_for_each_servo_period(trace: Trace, made: dict[str, Table]) -> None:
    joints = made["joints"]
    assert column(joints, "time") == pytest.approx(trace.times)
    assert column(joints, "boom_position") == trace.joints[:, 2].tolist()
    assert column(joints, "wrist_roll_rate") == trace.rates[:, 3].tolist()
    assert column(joints, "hand_roll_torque") == trace.efforts[:, 5].tolist()
    assert column(joints, "gap") == trace.gaps.tolist()


def test_units_go_by_what_joints_do(made: dict[str, Table]) -> None:
    units = {each.name: each.unit for each in made["joints"].columns}
    assert [units[f"boom_{what}"] for what in ("position", "rate", "torque")] == ["m", "m/s", "N"]
    assert [units[f"shoulder_{what}"] for what in ("position", "rate", "torque")] == ["rad", "rad/s", "N m"]


def test_each_row_tells_the_step_that_was_under_way(trace: Trace, made: dict[str, Table]) -> None:
    joints = made["joints"]
    told = list(zip(*(column(joints, name) for name in ("stage", "step", "file", "line")), strict=True))
    first, last = trace.stages[0], trace.stages[-1]
    rows = [at for at, time in zip(told, trace.times, strict=True) if first.begin < time <= first.end + 1e-6]
    assert set(rows) == {("open", 0, "", 2)}
    rows = [at for at, time in zip(told, trace.times, strict=True) if time > last.begin + 1e-3]
    assert set(rows) == {("again", 2, "", 6)}


def test_forces_have_a_row_where_there_is_something_to_tell(trace: Trace, made: dict[str, Table]) -> None:
    forces, known = trace.forces(), trace.forces().estimated
    assert 0 < known.sum() < len(known)
    assert column(made["forces"], "force_z") == forces.force[known, 2].tolist()
    assert column(made["forces"], "guard") == ["force"] * known.sum()
    assert column(made["forces"], "limit") == [8.0] * known.sum()


def test_every_event_has_its_row_its_sentence_and_all_of_it(made: dict[str, Table]) -> None:
    events = made["events"]
    assert column(events, "event") == [type(event).__name__ for event in EVENTS]
    assert column(events, "said") == [sentence(event) for event in EVENTS]
    assert [json.loads(data)["time"] for data in column(events, "data")] == [event.time for event in EVENTS]


def test_csv_gives_every_number_back_to_the_bit(made: dict[str, Table]) -> None:
    joints = made["joints"]
    head, *rows = csv.reader(csv_bytes(joints).decode().splitlines())
    assert head == [each.name for each in joints.columns]
    for number, each in enumerate(joints.columns):
        if isinstance(each.values, np.ndarray):
            assert [float(row[number]) for row in rows] == each.values.tolist()


def test_a_figure_that_is_not_there_is_an_empty_cell(made: dict[str, Table]) -> None:
    forces = made["forces"]
    lacking = next(each for each in forces.columns if each.name == "value")
    gone = replace(lacking, values=np.array([np.nan, 1.5]))
    assert csv_bytes(Table(name="two", about="", columns=(gone, gone))) == b"value,value\n,\n1.5,1.5\n"


# -- the folder ------------------------------------------------------------------------------------------------


def test_the_folder_holds_a_file_for_each_table_and_tells_its_columns(
    command: Command, tmp_path: Path
) -> None:
    record(tmp_path / "a.mcap")
    said = "told: joints (72 rows), forces (36 rows), events (37 rows)\n"
    assert command("trace", "export", "csv", "a.mcap", "-o", "told") == (0, said, "")
    assert {path.name for path in Path("told").iterdir()} == {
        "README.md", "joints.csv", "forces.csv", "events.csv",
    }  # fmt: skip
    readme = Path("told/README.md").read_text(encoding="utf-8")
    assert "| `boom_position` | m | position of the joint boom |" in readme


def test_tables_are_replaced_only_if_somebody_says_so_and_nothing_else_ever(
    command: Command, tmp_path: Path
) -> None:
    record(tmp_path / "a.mcap")
    words = ("trace", "export", "csv", "a.mcap", "-o", "told")
    assert command(*words)[0] == 0
    assert command(*words)[2] == ("handeye: told already holds tables of handeye; --overwrite replaces it\n")
    assert command(*words, "--overwrite")[0] == 0
    Path("told/mine.txt").touch()
    assert "told holds other files" in command(*words, "--overwrite")[2]


def test_of_a_trace_that_was_cut_short_it_is_said_and_the_exit_code_says_so(
    command: Command, tmp_path: Path
) -> None:
    record(tmp_path / "a.mcap")
    whole = Path("a.mcap").read_bytes()
    Path("a.mcap").write_bytes(whole[: len(whole) * 3 // 4])
    code, out, err = command("trace", "export", "csv", "a.mcap", "-o", "told")
    assert (code, out[:14], err) == (
        1,
        "told: joints (",
        "a.mcap was cut short; only the recorded part is written\n",
    )


def test_an_event_list_makes_no_tables(command: Command) -> None:
    Path("events.jsonl").touch()
    code, _, err = command("trace", "export", "csv", "events.jsonl", "-o", "told")
    assert (code, Path("told").exists()) == (2, False)
    assert err.endswith("holds no positions; use the trace.mcap\n")


def test_parquet_without_pyarrow_is_told_with_the_way_to_get_it(
    command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record(tmp_path / "a.mcap")
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    code, _, err = command("trace", "export", "parquet", "a.mcap", "-o", "told")
    needed = "`parquet` needs pyarrow, which is not installed"
    how = "`pip install pyarrow` installs it, and so does the extra `export` of handeye"
    assert (code, err) == (2, f"handeye: {needed}: {how}\n")
    assert not Path("told").exists()


def test_a_trace_gives_a_table_by_its_name(trace: Trace, made: dict[str, Table]) -> None:
    assert csv_bytes(trace.table()) == csv_bytes(made["events"])
    assert trace.table("joints")["time"].tolist() == made["joints"]["time"].tolist()
    with pytest.raises(
        InvalidInput, match=r"^there is no table 'event'; the tables are joints, forces, events, channels$"
    ):
        trace.table("event")


def test_a_slice_of_a_table_has_those_rows_of_every_column(made: dict[str, Table]) -> None:
    part = made["events"][3:5]
    assert (len(part), part["said"]) == (2, made["events"]["said"][3:5])
    with pytest.raises(
        InvalidInput, match=r"^there is no column 'tiem' in the table events; the columns are time, "
    ):
        part["tiem"]


def test_a_table_becomes_a_data_frame_where_pandas_is(
    made: dict[str, Table], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pandas", SimpleNamespace(DataFrame=dict))
    assert made["events"].to_pandas()["said"] == made["events"]["said"]
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(InvalidInput, match=r"^to_pandas\(\) needs pandas, which is not installed"):
        made["events"].to_pandas()


def test_a_notebook_shows_the_first_rows_and_tells_how_many_more_there_are(made: dict[str, Table]) -> None:
    page = made["joints"]._repr_html_()
    assert page.count("<tr>") == 1 + SHOWN_ROWS
    assert f"… and {len(made['joints']) - SHOWN_ROWS} more" in page
    assert "more;" not in made["joints"][:SHOWN_ROWS]._repr_html_()


def test_the_texts_of_a_table_are_data() -> None:
    evil = "<script>x</script>"
    table = Table(name=evil, about=evil, columns=(Column(name=evil, about="", values=(evil, "a" * 500)),))
    page = table._repr_html_()
    assert "<script" not in page
    assert page.count("&lt;script&gt;x") == 4
    assert "a" * MAX_CELL_CHARS not in page
