"""`NAME[=VALUE][@STAGE]` names a fault of a catalogue, or is refused in a sentence."""

import pytest

from handeye.core.errors import InvalidInput
from handeye.core.faults import Catalogue, Fault, FaultKind, Size
from handeye.core.units import INCH
from handeye.core.world_options import by_number, faults, from_start_only

CATALOGUE = Catalogue(
    FaultKind(name="lamp.dead", meaning="The lamp stays dark."),
    FaultKind(name="gap.off", meaning="It reads more.", size=Size(unit="in", usual=0.5, limits=(-4.0, 4.0))),
    FaultKind(name="gasket.missing", meaning="There is none.", when="before"),
    FaultKind(name="base.removed", meaning="Somebody takes it away.", usual_stage=4),
    FaultKind(name="wand.open", meaning="It signals nothing.", when="later"),
)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("lamp.dead", Fault(name="lamp.dead")),
        (" lamp.dead @ 3 ", Fault(name="lamp.dead", stage=3)),
        ("gap.off", Fault(name="gap.off", value=0.5 * INCH)),
        ("gap.off=-1", Fault(name="gap.off", value=-INCH)),
        ("gap.off=2mm@1", Fault(name="gap.off", value=0.002, stage=1)),
        ("gasket.missing", Fault(name="gasket.missing")),
        ("base.removed", Fault(name="base.removed", stage=4)),
        ("base.removed@2", Fault(name="base.removed", stage=2)),
        ("wand.open", Fault(name="wand.open")),
        ("wand.open@30s", Fault(name="wand.open", after=30.0)),
        ("wand.open @ .5 s", Fault(name="wand.open", after=0.5)),
    ],
)
def test_a_fault_is_named_with_its_size_and_its_stage(text: str, fault: Fault) -> None:
    assert faults(CATALOGUE, [text], by_number) == (fault,)


def test_a_stage_may_have_any_name() -> None:
    (fault,) = faults(CATALOGUE, ['lamp.dead@"put on=the @ top"'], {"put on=the @ top": 7}.__getitem__)
    assert fault.stage == 7


@pytest.mark.parametrize(
    ("texts", "sentence"),
    [
        (["lamp.daed"], "there is no fault `lamp.daed`; did you mean `lamp.dead`?"),
        (
            ["bell"],
            "there is no fault `bell`; known: `base.removed`, `gap.off`, `gasket.missing`, `lamp.dead`, `wand.open`",
        ),
        (["lamp"], "`lamp` is a group of faults: `lamp.dead`"),
        (["lamp.dead=3"], "the fault `lamp.dead` takes no value; leave out `=3`"),
        (["gap.off=wide"], "gap.off cannot be `wide`, which is not a number"),
        (["gap.off=5in"], "gap.off cannot be `5in`; it must be between -4 and 4 in"),
        (["gap.off=5N"], "gap.off is not measured in `N`; known: `in`, `m`, `mm`"),
        (["lamp.dead@0"], "`0` is not the number of a stage; stages are numbered from 1"),
        (["lamp.dead@"], "`lamp.dead@` is not a fault; write NAME, NAME=VALUE, NAME@STAGE or NAME@30s"),
        (["gap.off="], "`gap.off=` is not a fault; write NAME, NAME=VALUE, NAME@STAGE or NAME@30s"),
        (["lamp.dead", "lamp.dead@2"], "the fault `lamp.dead` is given twice"),
        (
            ["gasket.missing@2"],
            "the fault `gasket.missing` cannot begin during a run, only before it; leave out `@2`",
        ),
        (
            ["gasket.missing@2s"],
            "the fault `gasket.missing` cannot begin during a run, only before it; leave out `@2s`",
        ),
        (
            ["lamp.dead@2s"],
            "the fault `lamp.dead` begins at a stage, not after a time; write for example `@2`, not `@2s`",
        ),
        (
            ["wand.open@2"],
            "the fault `wand.open` begins after a time, not at a stage; write for example `@30s`, not `@2`",
        ),
        (["wand.open@0s"], "the fault `wand.open` must begin after a time of more than 0 s, not 0 s"),
    ],
)
def test_what_names_no_fault_is_refused(texts: list[str], sentence: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        faults(CATALOGUE, texts, by_number)
    assert str(refused.value) == sentence


def test_where_nothing_has_stages_a_fault_is_there_from_the_beginning() -> None:
    with pytest.raises(
        InvalidInput,
        match=r"^this command has no stages; leave out `@2`, or write a time such as `@30s` if the fault can begin "
        "after a time$",
    ):
        faults(CATALOGUE, ["lamp.dead@2"], from_start_only)


def test_a_fault_is_told_as_it_would_be_typed() -> None:
    typed = ["gap.off=-0.25in@2", "lamp.dead", "wand.open@30s"]
    assert [CATALOGUE.written(fault) for fault in faults(CATALOGUE, typed, by_number)] == typed


def test_a_recorded_fault_of_another_size_than_it_can_have_is_refused() -> None:
    with pytest.raises(InvalidInput, match=r"^the fault `gap.off` must have a value between -0\.1016 and"):
        CATALOGUE.check([Fault(name="gap.off", value=7.0)])
    with pytest.raises(InvalidInput, match=r"^the fault `lamp.dead` takes no value$"):
        CATALOGUE.check([Fault(name="lamp.dead", value=7.0)])
