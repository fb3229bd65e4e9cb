"""Table 1 of the paper: both layers, its claims, and the page that shows them."""

import json
from collections.abc import Callable

import pytest
from mal_bench import codes
from table_pages import maker

from handeye.systems.sigma.table1 import ROWS, Table1, calculating, load, page_tables, real, table1, uniform

Command = Callable[..., tuple[int, str, str]]


@pytest.fixture(scope="module")
def measured() -> Table1:
    """Measured once for all tests of this file."""
    return table1()


@pytest.mark.slow
@pytest.mark.sigma_row(36)
def test_layer_1_has_the_commands_seconds_and_saturation_of_the_paper(measured: Table1) -> None:
    for row, found in zip(ROWS, measured.layer1, strict=True):
        assert found.commands == row.commands
        assert found.seconds == pytest.approx(row.seconds, rel=0.01)
        assert found.per_second == pytest.approx(row.per_second, rel=0.01)
        assert found.saturation == pytest.approx(row.saturation, abs=0.00051)  # to its last digit


@pytest.mark.slow
@pytest.mark.sigma_row(37)
def test_the_claims_of_the_paper_hold_for_real_programs(measured: Table1) -> None:
    ord_, one, two, prco = measured.layer2
    assert max(each.saturation for each in measured.layer2) < 0.5
    assert min(each.idle for each in measured.layer2) > 50
    assert 1.2 <= one.seconds / two.seconds <= 2
    assert two.per_second > max(ord_.per_second, one.per_second, prco.per_second)
    assert measured.holds


@pytest.mark.slow
@pytest.mark.sigma_row(50)
def test_arithmetic_takes_idle_time_and_commands_away(measured: Table1) -> None:
    idle = [each.idle for each in measured.arithmetic]
    rates = [each.per_second for each in measured.arithmetic]
    assert (idle, rates) == (sorted(idle, reverse=True), sorted(rates, reverse=True))
    assert idle[0] > 95
    assert idle[-1] < 30


@pytest.mark.slow
def test_the_page_has_the_tables_that_the_program_makes(measured: Table1) -> None:
    made = maker()
    assert made.page("table1", page_tables(measured)) == made.place("table1").read_text("utf-8")


@pytest.mark.slow
def test_the_table_is_a_command(command: Command) -> None:
    code, out, _ = command("sigma", "table1", "--json")
    found = json.loads(out)
    assert (code, found["completed"], len(found["figures"]["layer1"])) == (0, True, 4)


def test_programs_of_both_layers_have_no_mistakes() -> None:
    texts = [*(real(row.name) for row in ROWS), calculating(250)]
    assert [codes(text) for text in (*texts, *(uniform(r.arms, r.commands, r.steps) for r in ROWS))] == [
        []
    ] * 9


def test_a_uniform_program_shares_its_moves_between_the_arms() -> None:
    one, two = (load("test", uniform(arms, 20, 500), 0) for arms in (1, 2))
    assert (one.commands, two.commands) == (20, 20)
    assert one.seconds / two.seconds == pytest.approx(2, rel=0.01)
