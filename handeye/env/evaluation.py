"""Evaluates a policy in many worlds, with the engine that runs all trials."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

from handeye.core.distributions import random_numbers
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.env.controls import machine_of
from handeye.env.environment import AssemblyEnv
from handeye.env.jobs import job_named
from handeye.env.policies import Episode, PolicyMaker, played, policy_maker
from handeye.env.spaces import ActionKind, Observation
from handeye.trials.figures import Rate, rate
from handeye.trials.sweep import Case, Details, Sweep, TrialRow


class EpisodeRow(TrialRow, frozen=True, kw_only=True):
    """One episode of a policy."""

    said: str = ""  # outcome of the verdict; empty if the episode did not end
    reached: tuple[str, ...] = ()  # steps of the work that are finished, in order
    steps: int = 0  # of the environment
    seconds: float = 0.0  # of the episode, on the cell's clock
    peak_N: float | None = (
        None  # greatest true contact force of pin and plate; None: not measured in this cell
    )
    wrong: tuple[str, ...] = ()  # what the referee found wrong, by the names of the findings
    stopped: str = ""  # why the arm stopped for good
    passed_over: int = 0  # worlds before this one in which the program does not reach the start

    @property
    def outcome(self) -> str:
        return self.said

    @property
    def stage(self) -> str:
        return f"after `{self.reached[-1]}`" if self.reached else "at the start"

    @property
    def detail(self) -> str:
        return super().detail or self.stopped or ", ".join(self.wrong)

    @property
    def measures(self) -> Mapping[str, float]:
        if self.broken_off:
            return {}
        peak = {} if self.peak_N is None else {"peak, N": self.peak_N}
        return {**peak, "seconds": self.seconds, "steps reached": float(len(self.reached))}


@dataclass(frozen=True, slots=True, kw_only=True)
class PlayedEpisode:
    """An episode that a policy has played to its end."""

    referee: Mapping[str, Any]  # the referee's judgement, as `info["referee"]` gives it
    steps: int  # of the environment
    seconds: float  # on the cell's clock
    passed_over: int  # worlds in which no episode could start


def play(env: AssemblyEnv, maker: PolicyMaker, seed: int) -> PlayedEpisode:
    """Let a policy play an episode in the world of a seed. Raises InvalidInput, or any exception that the policy
    raises.
    """
    first, began = env.reset(seed=seed)
    own = int(random_numbers(seed, "env.policy").integers(1 << 32))
    ended: dict[str, Any] = {}

    def advance(action: Array) -> tuple[Observation, bool]:
        seen, _, terminated, truncated, info = env.step(action)
        ended.update(info)
        return seen, terminated or truncated

    facts = env.facts(own)
    episode = Episode(facts=facts, observation=first, advance=advance)
    played(maker(facts), episode)
    seconds = float(episode.observation["clock"][0] - first["clock"][0])
    return PlayedEpisode(
        referee=ended["referee"],
        steps=episode.steps,
        seconds=round(seconds, 6),
        passed_over=len(began["passed_over"]),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Evaluation:
    """Lets a policy play one episode in each world of an evaluation."""

    policy: str  # name of an included policy, or MODULE:NAME
    environment: str  # its id
    action: ActionKind
    settings: Mapping[str, Any] = field(default_factory=dict)  # further arguments of the environment

    def __call__(self, case: Case) -> list[EpisodeRow]:
        """Play the episode of a case. Raises InvalidInput, or any exception that the policy raises."""
        maker = policy_maker(self.policy, self.environment)
        env = AssemblyEnv(self.environment, action=self.action, pictures=self._sees(maker), **self.settings)
        found = play(env, maker, case.seed)
        said = found.referee
        return [
            EpisodeRow(
                trial=case.trials[0],
                seed=case.seed,
                said=said["outcome"],
                reached=tuple(said["reached"]),
                steps=found.steps,
                seconds=found.seconds,
                peak_N=said["peak_N"],
                wrong=tuple(name for name, each in said["findings"].items() if not each["ok"]),
                stopped=said["stopped"],
                passed_over=found.passed_over,
            )
        ]

    def _sees(self, maker: PolicyMaker) -> bool:
        """Return True if the policy uses pictures, and the cell has a camera."""
        seeing: bool = getattr(maker, "pictures", False)
        return seeing and machine_of(job_named(self.environment)).sees


class OutcomeShare(Record, frozen=True, kw_only=True):
    """How many episodes ended with the outcome `outcome`."""

    outcome: str
    episodes: int
    least_share: float | None  # Wilson's interval at 95 %
    rate_share: float | None
    most_share: float | None


def _rate(rows: Sequence[EpisodeRow], outcome: str) -> Rate:
    ended = [row for row in rows if not row.to_be_tried_again]
    return rate(sum(row.verdict == outcome for row in ended), len(ended))


def _details(rows: Sequence[EpisodeRow]) -> tuple[Details, ...]:
    shares = []
    for outcome in _OUTCOMES:
        found = _rate(rows, outcome)
        least, most = found.wilson95 or (None, None)
        shares.append(
            OutcomeShare(
                outcome=outcome, episodes=found.successes, least_share=least, rate_share=found.rate, most_share=most
            )
        )  # fmt: skip
    heads = ("outcome", "episodes", "at least", "rate", "at most")
    return (
        Details(
            name="rates", title="Rates, with Wilson's 95 % interval", rows=shares, heads=heads,
            span=("least_share", "rate_share", "most_share"),
        ),
    )  # fmt: skip


def _more(rows: Sequence[EpisodeRow]) -> dict[str, object]:
    reached: dict[str, int] = {}
    for row in rows:
        for step in row.reached:
            reached[step] = reached.get(step, 0) + 1
    return {
        "success": _rate(rows, "right"),
        "false_done": _rate(rows, "false done"),
        "reached": reached,
        "passed_over": sum(row.passed_over for row in rows),
    }


_OUTCOMES: Final = {"right": "right", "false done": "silent", "not done": "wrong", "stopped": "wrong"}
EPISODES: Final = Sweep(
    kind="episodes",
    row=EpisodeRow,
    outcomes=_OUTCOMES,  # type: ignore[arg-type]
    success="right",
    noun="episode",
    details=_details,
    more=_more,
    shared_worlds=False,
)
