"""What the ends of the pump's programs rest on."""

import json
from pathlib import Path

import pytest
from conftest import Command

from benchmarks.planted import Planted, holes, sample, script, variants, verdict
from handeye.al import compile_text
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.core.variation import Overrides, WorldSpec
from handeye.program.program import Program
from handeye.program.taught import load_taught
from handeye.proof.argument import argument, unproved
from handeye.proof.proof import Proof, prove
from handeye.tasks.water_pump.task import WATER_PUMP

pytestmark = pytest.mark.slow

SIX = WATER_PUMP.obligations(WorldSpec(seed=0))
SEVEN = WATER_PUMP.obligations(WorldSpec(seed=0, overrides=Overrides(set={"pump.screws": 7.0})))
PICTURE = Path(__file__).parents[2] / "docs" / "pictures" / "proof.svg"
RESULT = Path(__file__).parents[2] / "demo" / "result.json"


def program(name: str) -> Program:
    taught = load_taught(plans() / f"{name}.toml")
    text = (plans() / f"{name}.al").read_text(encoding="utf-8")
    found, _ = compile_text(Source(name=f"{name}.al", text=text), taught)
    assert found is not None
    return found


@pytest.fixture(scope="module")
def careful() -> tuple[Program, Proof]:
    found = program("water_pump")
    return found, prove(found, SIX)


def verdicts(proof: Proof, of: str) -> set[str]:
    return {each.finding for each in proof.findings if proof.verdict(each) == of}


def test_every_finding_of_the_referee_is_an_obligation_once() -> None:
    judged = json.loads(RESULT.read_bytes())["referee"]
    assert sorted(each.finding for each in SIX) == sorted(judged)


def test_the_pumps_program_shows_every_finding_that_is_asked_of_it(careful: tuple[Program, Proof]) -> None:
    found, proof = careful
    assert proof.holds
    assert len(verdicts(proof, "shown")) == 30
    assert unproved(proof, found) == []
    text = "\n".join(argument(proof, found))
    assert (
        "\nrotor_place: the fingers feel that the end of the crank pin is 2.86 inches over the face" in text
    )
    assert "Every path passes line" in text


def test_the_program_of_1973_lacks_what_it_never_checks() -> None:
    found = program("water_pump_1973")
    proof = prove(found, SIX)
    assert verdicts(proof, "avoided") == {
        "base_far", "base_left", "base_yaw", "base_height", "base_tilt", "gasket_height", "top_height", "screws",
        "screws_depth", "screws_size", "screws_lean", "screws_clamp", "pins", "pins_tilt", "rack", "rack_tilt",
        "rotor", "rotor_place", "rotor_lean",
    }  # fmt: skip
    (size,) = [each for each in unproved(proof, found) if "`screws_size`" in each.message]
    assert size.message.endswith("(hole 1)")  # the first screw is the measure for the others


def test_the_seventh_screw_is_driven_but_its_head_is_not_felt() -> None:
    text = (plans() / "water_pump.al").read_text(encoding="utf-8")
    head, behind = text.index('        STAGE   "find'), text.rindex("        RACK")
    text = (
        f"{text[:head]}        TRANS   S7 [6 43.8 6.37 90 90 0]\n"
        "        TRANS   H6 [-.004 -1.576 6.874 -89.96 89.99 0] OF PUMP\n"
        f"{text[head:behind]}        SCREW   S7 H6 Y1 7\n{text[behind:]}"
    )
    found, _ = compile_text(Source(name="seven.al", text=text), load_taught(plans() / "water_pump.toml"))
    assert found is not None
    proof = prove(found, SEVEN)
    assert verdicts(proof, "avoided") == {
        "gasket_height",
        "top_height",
        "screws",
        "screws_depth",
        "screws_lean",
        "screws_clamp",
    }
    assert all("(hole 7)" in each.message for each in unproved(proof, found))


@pytest.mark.parametrize("hole", sample(holes(script()), 7, seed=52), ids=lambda hole: hole.rule)
def test_a_planted_hole_is_found(hole: Planted) -> None:
    proof = verdict(hole, SIX)
    assert verdicts(proof, "avoided")
    assert not proof.holds


DECIDED = [
    each for each in variants(script()) if not (each.rule.startswith("counted in") and " PRESS " in each.rule)
]
"""All variants but four: the proof does not decide whether a touch of PRESS is made if a counter leads to it."""


@pytest.mark.parametrize("variant", sample(DECIDED, 3, seed=52), ids=lambda variant: variant.rule)
def test_a_sound_variant_is_accepted(variant: Planted) -> None:
    assert verdict(variant, SIX).holds


def test_check_prove_refuses_a_program_with_the_path_and_exit_code_2(command: Command) -> None:
    code, out, err = command("check", "--prove", "water_pump_1973")
    assert code == 2
    assert "error[finding-unnoticed]: the program can end without noticing that `pins`" in err
    assert "the path: lines" in err
    assert out.startswith(
        "water_pump_1973: every path to the end shows 11 findings of the referee; 19 findings can remain unnoticed"
    )


def test_check_prove_gives_the_proof_as_json_and_as_a_drawing(command: Command) -> None:
    code, out, _ = command("check", str(plans() / "water_pump.plan.json"), "--prove", "--json")
    answer = json.loads(out)
    assert (code, answer["diagnostics"]) == (0, [])
    assert {claim["verdict"] for claim in answer["proof"]["claims"]} == {"shown"}
    plan = str(plans() / "water_pump.plan.json")
    code, _, _ = command("check", "--prove", plan, "--graph", "svg", "-o", "proof.svg")
    assert code == 0
    drawn = Path("proof.svg").read_text(encoding="utf-8")
    assert "MATCH PUMP WHOLE DONE" in drawn
    assert drawn == PICTURE.read_text(encoding="utf-8"), "draw it again, as docs/proof.md says"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("check", "insertion", "--prove"), "declares no obligations"),
        (("check", "insertion", "--graph", "svg"), "need --prove"),
        (("check", "insertion", "--prove", "--watch"), "--prove and --watch"),
        (
            ("check", str(plans() / "water_pump.plan.json"), "--prove", "--set", "pump.screws=5"),
            "must be 6 or 7",
        ),
        (("check", str(plans() / "train.ml"), "--prove"), "works only for programs that are planned"),
    ],
)
def test_check_prove_says_what_it_cannot_do(command: Command, words: tuple[str, ...], said: str) -> None:
    code, _, err = command(*words)
    assert (code, said in err) == (2, True)
