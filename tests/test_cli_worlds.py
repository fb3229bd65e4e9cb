"""Worlds on the command line: the options that choose one, and the command that lists what is in it."""

import json
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from conftest import Command

from handeye.cli.common import screen
from handeye.cli.world_options import ErrorOptions, WorldOptions
from handeye.core.variation import DRAWING, LARGEST_SEED, Overrides, Quantity, WorldSpec
from handeye.tasks import task
from handeye.tasks.water_pump.world.variation import variation

CHOSEN = ("--seed", "3", "--level", "high", "--without", "camera,base.x", "--set", "part_mass=5%",
          "--scale", "unsourced=.5")  # fmt: skip
SPEC = {
    "seed": 3,
    "level": "high",
    "overrides": {"without": ["base.x", "camera"], "set": {"part_mass": 0.05}, "scale": {"unsourced": 0.5}},
    "faults": [],
    "drawing": DRAWING,
}
CHOOSING = [
    "assemble", "run", "world", "render", "do", "repl", "teach", "bench timing", "trials base",
    "trials gasket", "faults",
]  # fmt: skip
"""Commands that build a world."""


def listed(command: Command, *words: str) -> dict[str, dict[str, object]]:
    """The quantities that `handeye world --json` lists, by name."""
    code, out, _ = command("world", "--json", *words)
    assert code == 0
    return {quantity["name"]: quantity for quantity in json.loads(out)["quantities"]}


@pytest.mark.parametrize("words", [*CHOOSING, "trials assembly"])
def test_every_command_that_builds_a_world_has_the_same_options(command: Command, words: str) -> None:
    _, out, _ = command(*words.split(), "--help")
    offered = [option for option in ("--seed", "--level", "--without", "--set") if f"{option} " in out]
    assert offered == ["--seed", "--level", "--without", "--set"]


SEVEN = ("--set", "pump.screws=7")
SIX = variation().present({})


@pytest.mark.parametrize(
    ("words", "there"), [((), SIX), (("--seed", "7000000"), SIX), (SEVEN, variation().quantities)]
)
def test_every_quantity_is_listed(
    command: Command, words: tuple[str, ...], there: Mapping[str, Quantity]
) -> None:
    assert list(listed(command, *words)) == list(there)


def test_the_number_of_screws_is_a_choice_of_the_job_that_no_level_scales(command: Command) -> None:
    found = [listed(command, "--level", level, *SEVEN)["pump.screws"] for level in ("low", "high")]
    assert [(each["value"], each["distribution"], each["spread"]) for each in found] == 2 * [
        (7.0, "choice", [6, 7])
    ]
    assert "pump.screws                          6       6 or 7\n" in command("world")[1]


@pytest.mark.parametrize("columns", ["80", "120"])
def test_the_list_fits_the_terminal(command: Command, monkeypatch: pytest.MonkeyPatch, columns: str) -> None:
    monkeypatch.setenv("COLUMNS", columns)
    code, out, _ = command("world", *CHOSEN, "--without", "light,thread_phase")
    rows = [line.split() for line in out.splitlines() if line.startswith("  ")]
    assert (code, [row[0] for row in rows]) == (0, list(SIX))
    assert max(map(len, out.splitlines())) <= int(columns)


@pytest.mark.parametrize("columns", ["1", "19"])
def test_the_list_is_whole_on_the_narrowest_terminal(
    command: Command, monkeypatch: pytest.MonkeyPatch, columns: str
) -> None:
    monkeypatch.setenv("COLUMNS", columns)
    code, out, _ = command("world")
    assert (code, [name for name in SIX if name not in "".join(out.split())]) == (0, [])


def test_no_columns_at_all_are_taken_for_the_usual_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "0")
    assert type(screen)().width == 80


def test_the_list_says_what_is_off_and_what_is_set(command: Command) -> None:
    _, out, _ = command("world", *CHOSEN)
    assert (
        "The world of seed 3, level high, without base.x, camera, part_mass set,\nunsourced scaled by 0.5\n"
        in out
    )
    rows = {line.split()[0]: " ".join(line.split()[1:]) for line in out.splitlines() if line.startswith("  ")}
    assert rows["camera.pot_noise"] == "0 deg off (noise, sigma 0.14 deg)"
    assert rows["part_mass"] == "5 % set (sigma 2 %)"
    assert rows["arm.friction.1"].endswith("N m within 0.1 N m of 0.4 N m")
    assert rows["arm.friction.2"].endswith("N m within 0.4 N m of 0.8 N m")


def test_the_page_on_worlds_shows_what_the_command_prints(command: Command) -> None:
    page = (Path(__file__).parent.parent / "docs" / "worlds.md").read_text(encoding="utf-8")
    shown = page.split("$ handeye world --seed 3\n")[1].split("...\n")[0]
    assert command("world", "--seed", "3")[1].startswith(shown)


def test_the_list_as_json_tells_the_world(command: Command) -> None:
    _, out, _ = command("world", "--json", *CHOSEN)
    assert json.loads(out)["world"] == SPEC
    found = listed(command, *CHOSEN)
    assert {name: found[name]["override"] for name in ("base.x", "base.y", "part_mass")} == {
        "base.x": "off", "base.y": None, "part_mass": "set"
    }  # fmt: skip


def test_without_a_group_nothing_else_changes(command: Command) -> None:
    before, after = listed(command, "--seed", "5"), listed(command, "--seed", "5", "--without", "fixtures")
    changed = {name for name in before if before[name]["si"] != after[name]["si"]}
    assert changed == {name for name in before if name.startswith("fixtures.")}


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("--without", ""), "--without needs names of errors, separated by single commas"),
        (("--without", "base.x,,camera"), "--without needs names of errors, separated by single commas"),
        (("--without", "camra"), "the world has no quantity `camra`; did you mean `camera`?"),
        (
            ("--without", "arm.offset.7"),
            "the world has no quantity `arm.offset.7`; did you mean `arm.",
        ),
        (
            ("--without", "weather"),
            "the world has no quantity `weather`; choose from `pump`, `base`, `arm`",
        ),
        (("--set", "part_mass"), "`part_mass` is not a setting; write NAME=VALUE"),
        (("--set", "part_mass=5kg"), "part_mass is not measured in `kg`; known: `%`"),
        (("--set", "camera.place.x=3inn"), "camera.place.x is not measured in `inn`; did you mean `in`?"),
        (("--set", "part_mass=-95"), "part_mass cannot be `-95`; it must be between -90 and 1000 %"),
        (("--set", "arm.pot_noise.1=-1"), "arm.pot_noise.1 cannot be `-1`; it must be between 0 and 360 deg"),
        (("--set", "light.zenith=120"), "light.zenith cannot be `120`; it must be between 0 and 89 deg"),
        (("--set", "pump.screws=8"), "pump.screws must be 6 or 7, not 8"),
        (("--set", "pump.screws=6.5"), "pump.screws must be 6 or 7, not 6.5"),
        (
            ("--set", "holes.base.7.x=.1"),
            "the world has the quantity `holes.base.7.x` only if pump.screws is set to 7",
        ),
        (
            ("--without", "thread_phase.7"),
            "the world has the quantity `thread_phase.7` only if pump.screws is set to 7",
        ),
        (("--set", "base.x=far"), "base.x cannot be `far`, which is not a number"),
        (
            ("--seed", str(LARGEST_SEED + 1)),
            "a seed must be a whole number from 0 to 9007199254740991 (2^53 - 1), not 9007199254740992",
        ),
    ],
)
def test_what_cannot_be_chosen_is_refused_with_what_is_near(
    command: Command, words: tuple[str, ...], sentence: str
) -> None:
    code, out, err = command("world", *words)
    assert (code, out) == (2, "")
    assert err.startswith(f"handeye: {sentence}")


@pytest.mark.parametrize(
    "words",
    ["assemble", "render -o it.png", "do PARK", "teach it.al", "trials base --n 1", "trials gasket --n 1",
     "trials assembly", "faults"],
)  # fmt: skip
def test_every_command_refuses_a_name_it_does_not_know(command: Command, words: str) -> None:
    code, out, err = command(*words.split(), "--without", "camra")
    assert (code, out) == (2, "")
    assert err.endswith("the world has no quantity `camra`; did you mean `camera`?\n")


@pytest.mark.parametrize("words", ["assemble", "trials assembly", "trials dismantling", "trials disturbed"])
@pytest.mark.parametrize(
    ("option", "told"),
    [("--set camra=1", "no quantity `camra`"), ("--seed -1", "a seed must be a whole number")],
)
def test_a_world_that_there_is_not_is_refused_before_a_program_is_planned(
    command: Command, monkeypatch: pytest.MonkeyPatch, words: str, option: str, told: str
) -> None:
    monkeypatch.setattr("handeye.planning.planner.plan_source", None)  # planning would fail
    code, out, err = command(*words.split(), *option.split())
    assert (code, out, told in err) == (2, "", True)


def test_an_unknown_level_is_refused(command: Command) -> None:
    code, _, err = command("assemble", "--level", "hihg")
    assert (code, "high" in err) == (2, True)


@pytest.mark.parametrize(
    ("scale", "told"),
    [
        ("unsourced", "`unsourced` is not a factor; write NAME=FACTOR"),
        ("unsourced=2x", "`unsourced=2x` is not a factor; write NAME=FACTOR"),
        (
            "unsourced=5",
            "`unsourced` cannot be scaled by 5.0; at the level nominal, a factor must be between 0 and 4",
        ),
        ("base=2", "there is nothing to scale: the world has no error in `base`"),
        ("camrea=2", "the world has no quantity `camrea`; did you mean `camera`?"),
    ],
)
def test_a_scale_of_nothing_or_by_too_much_is_refused(command: Command, scale: str, told: str) -> None:
    assert command("world", "--scale", scale) == (2, "", f"handeye: {told}\n")


def test_a_world_can_be_chosen_again_by_its_words() -> None:
    errors = ErrorOptions(
        level="high",
        without=["camera,arm", "base"],
        settings=["part_mass=5%", "friction=0"],
        scale=["unsourced=.5"],
    )
    assert WorldOptions(seed=3, errors=errors).words() == [
        "--seed", "3", "--level", "high", "--without", "camera,arm", "--without", "base",
        "--set", "part_mass=5%", "--set", "friction=0", "--scale", "unsourced=.5",
    ]  # fmt: skip
    assert WorldOptions().words() == ["--seed", "0"]


# -- runs ---------------------------------------------------------------------------------------------

SCRIPT = 'OPEN 2\nWHERE\nSTAGE "shut"\nOPEN 1\n'


@pytest.fixture
def half_run(command: Command, planned: Callable[[str], str]) -> Path:
    """A run in a chosen world that stands before its second stage."""
    code, _, _ = command("run", planned(SCRIPT), *CHOSEN, "--out", "half", "--until", "2")
    assert code == 0
    return Path("half")


@pytest.mark.slow
def test_a_run_records_its_world_and_goes_on_in_it(command: Command, half_run: Path) -> None:
    assert command("resume", str(half_run))[0] == 0
    result = json.loads((half_run / "result.json").read_text())
    begun = json.loads((half_run / "events.jsonl").read_text().splitlines()[0])
    assert (result["seed"], result["world"], begun["world"]) == (3, SPEC, SPEC)
    code, out, _ = command("trace", "verify", str(half_run))
    assert (code, "byte for byte" in out) == (0, True)
    assert (
        "the world of seed 3, level high, without base.x, camera, part_mass set, unsourced scaled by 0.5"
        in command("trace", "show", str(half_run))[1]
    )


@pytest.mark.slow
def test_checkpoints_of_two_worlds_do_not_mix(command: Command, half_run: Path) -> None:
    code, _, err = command("run", "job.plan.json", "--seed", "3", "--stage", "2", "--checkpoints", "half")
    told = "belongs to another run (seed 3, level high, without base.x, camera, part_mass set, unsourced scaled by "
    told += "0.5, camera auto), not to this run "
    assert (code, told in err.replace("\n", " ")) == (2, True)


@pytest.mark.slow
@pytest.mark.parametrize("words", [("--level", "low"), ("--seed", "0")])
def test_a_checkpoint_brings_its_own_world(command: Command, half_run: Path, words: tuple[str, str]) -> None:
    kept = next((half_run / "checkpoints").glob("0002-*"))
    code, _, err = command("do", "OPEN 1", "--from", str(kept), *words)
    told = "has its own world; --seed, --level, --without, --set, --scale and --fault cannot be given with --from\n"
    assert (code, err) == (2, f"handeye: {kept} {told}")


def test_equal_options_mean_equal_worlds() -> None:
    errors = ErrorOptions(
        level="high", without=["camera", "base.x,camera.place"], settings=["part_mass=0.05 "]
    )
    first = WorldOptions(seed=3, errors=errors).spec
    assert first == WorldSpec(
        seed=3, level="high", overrides=Overrides(without=("base.x", "camera"), set={"part_mass": 0.0005})
    )


# -- faults -------------------------------------------------------------------------------------------

BREAKING = ["assemble", "run", "render", "do", "repl", "teach", "trials assembly"]
"""Commands that can break something in the world that they build."""


@pytest.mark.parametrize("words", BREAKING)
def test_every_command_that_builds_a_cell_to_look_at_or_to_work_in_takes_faults(
    command: Command, words: str
) -> None:
    _, out, _ = command(*words.split(), "--help")
    assert "--fault " in out


@pytest.mark.parametrize("words", [("assemble",), ("do", "PARK"), ("trials", "assembly", "--seeds", "3")])
def test_a_fault_that_there_is_not_is_bad_input(command: Command, words: tuple[str, ...]) -> None:
    code, out, err = command(*words, "--fault", "gap_potentiometer.of")
    assert (code, out) == (2, "")
    assert err.endswith("there is no fault `gap_potentiometer.of`; did you mean `gap_potentiometer.off`?\n")


def test_a_fault_sets_in_with_a_stage_by_a_piece_of_its_name_or_not_at_all(command: Command) -> None:
    code, _, err = command("assemble", "--fault", "lamp.dead@aligning")
    assert (code, err.count("\n")) == (2, 1)
    assert "`aligning`" in err
    code, _, err = command("do", "PARK", "--fault", "lamp.dead@2")
    assert (code, err) == (
        2,
        "handeye: this command has no stages; leave out `@2`, or write a time such as `@30s` if the fault can begin "
        "after a time\n",
    )


@pytest.mark.parametrize("columns", ["80", "120"])
def test_every_fault_is_listed_with_its_size(
    command: Command, monkeypatch: pytest.MonkeyPatch, columns: str
) -> None:
    monkeypatch.setenv("COLUMNS", columns)
    code, out, _ = command("faults", "--list")
    names = [
        line.split()[0].split("=")[0] for line in out.splitlines() if line[:3].strip() and line[:2] == "  "
    ]
    assert (code, names) == (0, [*task().faults(WorldSpec(seed=0)).kinds, "panic"])
    assert max(map(len, out.splitlines())) <= int(columns)


def test_the_faults_that_are_named_are_listed_alone(command: Command) -> None:
    _, out, _ = command("faults", "--list", "--json", "--only", "pin", "--only", "panic")
    listed = {fault["name"]: fault["matrix"] for fault in json.loads(out)["faults"]}
    catalogue = task().faults(WorldSpec(seed=0))
    assert listed == {kind.name: kind.name in catalogue.matrix for kind in catalogue.select("pin")} | {
        "panic": True
    }
    assert command("faults", "--list", "--only", "lamp.dead")[1].splitlines()[0] == "lamp"


LATER = WorldSpec(seed=0, overrides=Overrides(set={"pump.screws": 7.0}))


def test_faults_are_listed_for_programs(command: Command) -> None:
    _, out, _ = command("faults", "--list", "--json", *SEVEN)
    known = {fault["name"]: fault for fault in json.loads(out)["faults"]}
    assert list(known) == [*task().faults(LATER).kinds, "panic"]
    assert known["gap_potentiometer.off"]["size"] == {"unit": "in", "usual": 0.5, "limits": [-4.0, 4.0]}
    assert known["lamp.dead"]["size"] is None
    assert known["gap_potentiometer.off"]["must"].startswith(
        "The program stops with error 51 (the finger gap differs"
    )
    assert known["thread.1.scarred"]["must"] == "The work is right."
