"""The commands of the relay: run, check and trials."""

import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import App, Parameter

from handeye.cli.common import Camera, CameraKind, WholeNumber, camera_here, positive, put_json, say, show
from handeye.cli.judged_jobs import ANY_RUN, JobOptions, carry_out_job
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions, carry_out_sweep
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions

if TYPE_CHECKING:
    from handeye.runs.setup import Setup

RelayFile = Annotated[
    Path, Parameter(help="A relay, `.relay`: a list of stages and of the programs that do them.")
]

relay = App(
    name="relay",
    help="Assemble one pump with programs of several systems, which take turns on the same arm.",
)


def run(
    file: RelayFile,
    /,
    *,
    seed: Annotated[
        WholeNumber, Parameter(help="Seed of the world: it determines all errors of the world.")
    ] = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    camera: Camera = "auto",
    options: JobOptions = ANY_RUN,
) -> int:
    """Run the legs of a relay. `handeye relay FILE` does the same.

    Between two legs, the brakes are set, and a small record is handed over: where the hand is, what it holds, and the
    places that the programs have found. If the hand or the part does not agree with the record, the next leg refuses
    to begin.

    Exit code 0: right; 1: a program stopped before its end, or a leg refused to begin; 3: all programs ended, but the
    referee disagrees; 2: bad input; 130: interrupted.
    """
    return carry_out_job(_setup(file, seed, errors, camera), options)


def check(
    file: RelayFile,
    /,
    *,
    json: Annotated[bool, Parameter(help="Print the findings as JSON.")] = False,
) -> int:
    """Check a relay and its programs, without moving anything: do the legs fit together? Then list, for each leg, the
    lines of `plans/water_pump.al` for which the language of the leg has no words.

    Exit code 0: no errors; 2: bad input, or a relay with errors.
    """
    from handeye.core.diagnostics import has_errors
    from handeye.core.source import read_source
    from handeye.systems.relay.check import inexpressible, misfits
    from handeye.systems.relay.plan import made
    from handeye.systems.relay.reading import parsed

    source = read_source(file)
    mistakes = parsed(source)[1]
    if has_errors(mistakes):
        show(mistakes, source, json=json)
        return 2
    plan = made(source, file.parent)
    wrong, without = [*misfits(plan)], [*inexpressible(plan)]
    if json:
        put_json([*wrong, *without])
    else:
        for finding in (*wrong, *without):
            say(finding.told, whole=True)
        if not wrong:
            say(f"{file}: no errors")
    return 2 if wrong else 0


def relay_trials(
    file: RelayFile,
    /,
    *,
    n: Annotated[WholeNumber, Parameter(help="Number of worlds.")] = 10,
    seed: FirstSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    camera: Camera = "auto",
    options: SweepOptions = ANY,
) -> int:
    """Run a relay in many worlds. Shows how often the pump is right. For each leg, shows the time, the greatest force,
    and how often the leg ended well.

    Each trial does what `handeye relay run` does, and takes one to two CPU minutes. Ctrl-C ends the batch and prints
    the trials that have finished. If you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the programs ended but
    the referee disagrees.
    """
    from handeye.runs.systems import digest_of
    from handeye.systems.relay.trials import RELAYS, RelayWork
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import cases

    positive(n, "trial")
    options.check()
    setup = _setup(file, seed, errors, camera_here(camera))
    words = shlex.join([str(file), *errors.words()])
    return carry_out_sweep(
        RELAYS,
        RelayWork(setup),
        cases(seed, range(n)),
        head_of(RELAYS, setup.world, settings={"relay": digest_of(setup)}, camera=setup.camera),
        options,
        title=f"{file.name} in worlds with seeds from {seed} upwards",
        again=lambda row: f"handeye relay {words} --seed {row.seed}",
    )


def _setup(file: Path, seed: int, errors: OwnErrorOptions, camera: CameraKind) -> "Setup":
    """Return the setup of a relay in a world. Raises InvalidInput if the legs of the relay do not fit together."""
    from handeye.core.source import read_source
    from handeye.runs.setup import Setup
    from handeye.systems.relay.check import check_plan
    from handeye.systems.relay.plan import TASK, made

    plan = made(read_source(file), file.parent)
    check_plan(plan)
    return Setup(system="relay", plan=plan, world=errors.of(TASK).spec(seed), camera=camera, judged=True)


relay.default(run)
relay.command(run)
relay.command(check)
