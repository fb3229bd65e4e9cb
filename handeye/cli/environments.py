"""Commands for the Gymnasium environments."""

from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import Parameter

from handeye.cli.common import Json, WholeNumber, positive, put_json, say
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions, carry_out_sweep
from handeye.cli.world_options import WORLD
from handeye.core.variation import WorldSpec, checked_seed

if TYPE_CHECKING:
    from handeye.env.evaluation import EpisodeRow

PIN: Final = "handeye/Pin-v0"


def environments(*, json: Json = False) -> int:
    """List the Gymnasium environments: their ids, jobs and time limits."""
    from handeye.env.jobs import jobs

    if json:
        put_json(
            [
                {"id": job.id, "task": job.task, "limit_s": job.limit_s, "meaning": job.meaning}
                for job in jobs()
            ]
        )
        return 0
    for job in jobs():
        say(f"{job.id:25} {job.limit_s:5.0f} s  {job.meaning}")
    return 0


def evaluate(
    policy: Annotated[
        str,
        Parameter(
            help="The policy: `random`, `program`, `scripted`, or MODULE:NAME for a policy of your own, in a module on "
            "Python's path or in the current folder."
        ),
    ],
    /,
    *,
    env: Annotated[str, Parameter(help="Id of the environment; `handeye env list` lists them.")] = PIN,
    n: Annotated[WholeNumber, Parameter(help="Number of episodes, each in a world of its own.")] = 20,
    seed: FirstSeed = 0,
    level: Annotated[
        Literal["low", "nominal", "high"],
        Parameter(
            group=WORLD, help="Size of the errors: `low` is half of `nominal`, `high` is twice `nominal`."
        ),
    ] = "nominal",
    action: Annotated[
        Literal["hand", "torques"] | None,
        Parameter(
            help="Kind of action: set-points of the hand, or joint torques. Default: that of the policy."
        ),
    ] = None,
    limit: Annotated[
        float | None,
        Parameter(help="Time limit of an episode, in simulated seconds. Default: that of the environment."),
    ] = None,
    options: SweepOptions = ANY,
) -> int:
    """Evaluate a policy: success rate and false-done rate with their confidence intervals, how many steps of the work
    the policy finished, peak force and time.

    Each episode takes place in a world of its own. A false done is an episode in which the policy says that the work
    is done, but the referee disagrees. An episode that reaches its time limit counts as a failure, even if the work is
    right. Peak force is the greatest force between pin and plate in any physics step, from the simulator's ground
    truth; the policy never sees this force. The figures are the same for any number of processes.

    Exit code 0: no false done; 1: no episode finished; 3: a false done; 2: bad input; 130: interrupted.
    """
    from handeye.env.environment import AssemblyEnv
    from handeye.env.evaluation import EPISODES, Evaluation
    from handeye.env.policies import check_policy, policy_maker, usual_action
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import cases

    positive(n, "episode")
    options.check()
    maker = policy_maker(policy, env)
    chosen = action or usual_action(maker)
    check_policy(policy, maker, env, chosen)
    settings = {"level": level, "limit_s": limit}
    AssemblyEnv(env, action=chosen, **settings)  # type: ignore[arg-type]  # refuses bad settings before the first episode
    head = {"policy": policy, "environment": env, "action": chosen} | {
        name: str(value) for name, value in settings.items()
    }
    first = checked_seed(seed)
    return carry_out_sweep(
        EPISODES,
        Evaluation(policy=policy, environment=env, action=chosen, settings=settings),
        cases(first, range(n)),
        head_of(EPISODES, WorldSpec(seed=first), settings=head, camera="ray"),
        options,
        title=f"{policy} in {env}, in worlds with seeds from {seed} upwards",
        again=lambda row: _again(row, policy, env, chosen, level),
    )


def _again(row: "EpisodeRow", policy: str, env: str, action: str, level: str) -> str:
    return (
        f"handeye env evaluate {policy} --env {env} --n 1 --seed {row.seed} --action {action} --level {level}"
    )
