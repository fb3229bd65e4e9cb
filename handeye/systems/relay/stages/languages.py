"""The legs that do a stage of the pump in each language, and the reasons why some languages cannot do a stage."""

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Final

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.entries import PLANNED, entry_of_file
from handeye.core.errors import NoSuchName
from handeye.core.host_time import HostTimer
from handeye.core.record import Record
from handeye.core.resources import plans
from handeye.planfile.store import written_digest
from handeye.program.program import Step
from handeye.runs.legs import leg_system
from handeye.systems.relay.check import demands, own_program
from handeye.systems.relay.plan import TASK, LegPlan, ProgramPlan, RelayPlan

CAREFUL: Final = "water_pump.al"
LANGUAGES: Final = {"1973": "program", "TRIG": "trig", "ML": "ml", "MAL": "sigma"}
"""The systems of the languages. `1973` is the arm language, to which handeye has added words."""
FILES: Final = {
    "insert the aligning pins": {"TRIG": "pins.trig", "ML": "pins.ml", "MAL": "pins.mal"},
    "put on the gasket": {"ML": "gasket.ml"},
    "put on the top": {"ML": "top.ml", "MAL": "top.mal"},
}
"""The programs of the stages, by language. The arm language does every stage, with `water_pump.al`."""
_TRIG_HAND: Final = "the hand of TRIG opens to 1.3 in, and TRIG has no words for another gap"
WITHOUT_LEG: Final = {
    ("put on the gasket", "TRIG"): f"{_TRIG_HAND}: fingers in the two large holes must be more than 1.4 in apart",
    ("put on the gasket", "MAL"): (
        "the line through both finger tips is always parallel to Y, and MAL has no words to turn the hand; but the "
        "two large holes of the gasket lie along X"
    ),
    ("put on the top", "TRIG"): f"{_TRIG_HAND}: the hub of the top is 2.2 in wide",
}  # fmt: skip
"""For a stage and a language: why the stage has no leg in this language, although other languages can do the stage."""
_WORD: Final = re.compile(r"\s*(?:\w+:)?\s*(\w+)")  # of an instruction, after its label
_REMARK: Final = re.compile(r"\s*(;|\*|\d+\s+REM\b)")


class StageLeg(Record, frozen=True, kw_only=True):
    """A leg that does a stage of the pump in one language."""

    stage: str
    language: str
    file: str
    lines: int  # of the program, without blank lines and remarks

    @property
    def condition(self) -> str:
        return f"{self.stage}: {self.language}"


class StageLimits(Record, frozen=True, kw_only=True):
    """Which languages can do a stage, and which of the stage's instructions the other languages cannot express."""

    stage: str
    languages: str  # that have a leg
    without_words: str  # the instructions of the stage for which none of TRIG, ML and MAL has words
    lines: int  # of the stage in the arm language, with the lines of its macros
    trig: int  # of these, the lines for which TRIG has no words
    ml: int
    mal: int


@lru_cache(maxsize=1)
def stages() -> tuple[str, ...]:
    """Return the stages of the pump's own program."""
    return own_program(TASK)[0].stages


def shared() -> tuple[str, ...]:
    """Return the stages that several languages can do, in the order of the pump's own program."""
    return tuple(stage for stage in stages() if stage in FILES)


def stage_named(name: str) -> str:
    """Return the stage called `name`. Raises NoSuchName if the pump's own program has no stage with this name."""
    if name not in stages():
        near = suggestion(name, stages()) or f"the stages are {', '.join(map(quoted, stages()))}"
        raise NoSuchName(f"the pump's own program has no stage {quoted(name)}; {near}")
    return name


def stage_legs(stage: str) -> Iterator[StageLeg]:
    """Yield the legs of a stage. The first is the leg in the arm language."""
    for language, file in {"1973": CAREFUL, **FILES.get(stage, {})}.items():
        yield StageLeg(stage=stage, language=language, file=file, lines=_lines(stage, file))


class TimedProgram(Record, frozen=True, kw_only=True):
    """A program, and the CPU time (s) that this computer needed to plan, teach or read it."""

    program: ProgramPlan
    cpu_s: float


def programs(legs: Iterable[StageLeg]) -> dict[str, TimedProgram]:
    """Plan the careful program (`CAREFUL`) and the programs of the given legs. The keys of the result are the names of
    the program files. Raises InvalidInput if a program has errors.
    """
    found = {}
    for file in dict.fromkeys([CAREFUL, *(leg.file for leg in legs)]):
        entry, timer = entry_of_file(file)[0], HostTimer()
        system = leg_system(PLANNED if entry is None else entry.name)
        plan = system.read(plans() / file)
        cpu_s = round(timer.cpu_s, 3)
        written = ProgramPlan(file=file, system=system.system, plan=system.encode(plan).decode())
        found[file] = TimedProgram(program=written, cpu_s=cpu_s)
    return found


def relay_of(leg: StageLeg, known: Mapping[str, TimedProgram]) -> RelayPlan:
    """Return a relay in which the careful program does all stages before the stage of `leg`. The program of `leg` then
    does this stage. `known` has the programs; its keys are their files.
    """
    before = stages()[: stages().index(leg.stage)]
    done = [*((stage, CAREFUL) for stage in before), (leg.stage, leg.file)]
    return RelayPlan(
        name=leg.file,
        text="".join(f'STAGE "{stage}" {file}\n' for stage, file in done),
        programs=tuple(known[file].program for file in dict.fromkeys(file for _, file in done)),
        legs=tuple(LegPlan(stage=stage, file=file, line=n) for n, (stage, file) in enumerate(done, 1)),
    )


def digest() -> str:
    """Return a digest of the texts of all programs, and of the taught positions."""
    files = [CAREFUL, "water_pump.toml", *sorted({file for each in FILES.values() for file in each.values()})]
    return written_digest(b"\0".join((plans() / file).read_bytes() for file in files))


@lru_cache(maxsize=1)
def limits() -> tuple[StageLimits, ...]:
    """Return for each stage what the languages cannot express."""
    program, _ = own_program(TASK)
    found = []
    for number, stage in enumerate(program.stages):
        steps = [step for step in program.steps if step.stage == number]
        lacking = {
            name: [step for step in steps if not demands(step.operation) <= words]
            for name, system in LANGUAGES.items()
            if (words := leg_system(system).words) is not None
        }
        names = ({_word(step) for step in each} for each in lacking.values())
        found.append(
            StageLimits(
                stage=stage,
                languages=", ".join(leg.language for leg in stage_legs(stage)),
                without_words=", ".join(sorted(set.intersection(*names))),
                lines=_distinct(steps),
                **{name.lower(): _distinct(each) for name, each in lacking.items()},
            )
        )
    return tuple(found)


def _word(step: Step) -> str:
    match = _WORD.match(step.text)
    assert match is not None
    return match[1]


def _distinct(steps: Iterable[Step]) -> int:
    """Count the lines of some steps. A line of a macro counts only once."""
    return len({(step.file, step.line) for step in steps})


def _lines(stage: str, file: str) -> int:
    """Count the lines of a stage's program. In the arm language, count the lines that the stage executes. A line of a
    macro counts once, however often the stage calls the macro. In any other language, count the lines that are neither
    blank nor remarks.
    """
    if file == CAREFUL:
        program, _ = own_program(TASK)
        number = program.stages.index(stage)
        return _distinct(step for step in program.steps if step.stage == number)
    text = (plans() / file).read_text(encoding="utf-8").splitlines()
    return sum(bool(line.strip()) and not _REMARK.match(line) for line in text)
