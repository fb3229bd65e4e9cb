"""Policies: what they know, how an episode calls them, and which policies are included with handeye."""

import os
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from gymnasium import spaces

from handeye.arm.model import ArmModel
from handeye.core.diagnostics import quoted
from handeye.core.entries import loaded
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.pose import Array
from handeye.env.jobs import job_named
from handeye.env.spaces import ActionKind, Component, Observation
from handeye.execution.state import ExecutionState


class EpisodeOver(Exception):
    """Raised by `Episode.step` when the episode has ended."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Facts:
    """The facts that a policy is allowed to know before an episode. None of these facts comes from the true state of
    the cell.
    """

    environment: str  # its id
    task: str
    period: float  # s: length of a step
    action: ActionKind
    components: tuple[Component, ...]  # of an action
    action_space: spaces.Box
    observation_space: spaces.Dict
    seed: int  # for the policy's own random numbers; it says nothing about the world


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmFacts(Facts):
    """The facts for a policy that moves the arm of a task with planned programs."""

    arm: ArmModel  # as its drawing describes it
    friction: Array  # Coulomb friction of each joint as the arm has measured it, shape (n,), N m or N
    links: Array  # measured weight of each link, divided by the weight in the model, shape (n,)
    memory: ExecutionState
    """What the program remembers when the episode starts: positions that it has measured, and the calibrated camera."""


@dataclass(slots=True, kw_only=True)
class Episode:
    """An episode as a policy sees it."""

    facts: Facts
    observation: Observation  # the last one
    advance: Callable[[Array], tuple[Observation, bool]]  # carries out an action; returns True at the end
    steps: int = field(default=0, init=False)  # done so far

    def step(self, action: Array) -> Observation:
        """Carry out an action for a period, and return the next observation. Raises EpisodeOver at the end of
        the episode.
        """
        self.observation, over = self.advance(action)
        self.steps += 1
        if over:
            raise EpisodeOver
        return self.observation


class Policy:
    """A policy for one episode. To use a policy of your own, name it as `MODULE:NAME`. The name is that of the
    policy's class, or of a function that makes the policy from the facts.

    A policy that answers each observation with an action has the method `act`. A policy that is written as a sequence
    of motions overrides `play` instead, and calls `episode.step` once in each period.
    """

    actions: tuple[ActionKind, ...] = (
        "hand",
        "torques",
    )  # kinds of action that it can use; the first is the usual one

    environments: tuple[str, ...] = ()  # ids of the environments for which it is made; empty: any
    pictures = False  # True if it uses the television camera, where there is one

    def __init__(self, facts: Facts) -> None:
        self.facts = facts

    def act(self, observation: Observation) -> Array:
        """Return the action that answers an observation."""
        raise NotImplementedError

    def play(self, episode: Episode) -> None:
        """Play an episode to its end."""
        while True:
            episode.step(self.act(episode.observation))


class RandomPolicy(Policy):
    """Draws every component of every action uniformly. On average, one step in a thousand reports that the work is
    done.
    """

    def __init__(self, facts: Facts) -> None:
        super().__init__(facts)
        self._space, self._random = facts.action_space, np.random.default_rng(facts.seed)

    def act(self, observation: Observation) -> Array:
        action = self._random.uniform(self._space.low, self._space.high)
        action[-1] = float(self._random.random() < _SAYS_DONE)
        return action


_SAYS_DONE: Final = 1e-3
PolicyMaker = Callable[[Facts], Any]
BUILT_IN: Final = {
    "random": "handeye.env.policies:RandomPolicy",
    "program": "handeye.env.program_policy:ProgramPolicy",
    "scripted": "handeye.env.scripted_pin:ScriptedPin",
}


def policy_maker(name: str, environment: str) -> PolicyMaker:
    """Return the class or function that makes the policy `name` in an environment. The name is that of a policy
    included with handeye, or it is MODULE:NAME. The module must be on Python's path or in the current folder. Raises
    InvalidInput if there is no policy with this name.
    """
    included = {**BUILT_IN, **job_named(environment).policies}
    if name in included:
        found: PolicyMaker = loaded(included[name])
        return found
    module, _, attribute = name.partition(":")
    if not attribute:
        raise NoSuchName(
            f"there is no policy {quoted(name)}; the policies are {', '.join(map(quoted, BUILT_IN))}, or "
            "MODULE:NAME for a policy of your own"
        )
    if not all(part.isidentifier() for part in (*module.split("."), attribute)):
        raise BadArgument(f"name a policy as MODULE:NAME, such as my_policy:Policy, not {quoted(name)}")
    if os.getcwd() not in sys.path:
        sys.path.append(os.getcwd())
    made = loaded(name, "the policy ")
    if not callable(made):
        raise BadArgument(f"{quoted(name)} is not a policy; a policy is a class or a function of `Facts`")
    return made  # type: ignore[no-any-return]


def usual_action(maker: PolicyMaker) -> ActionKind:
    """Return the kind of action that a policy uses by default."""
    able: tuple[ActionKind, ...] = getattr(maker, "actions", ("hand",))
    return able[0] if able else "hand"


def check_policy(name: str, maker: PolicyMaker, environment: str, action: ActionKind) -> None:
    """Raise BadArgument if a policy cannot use actions of the kind `action`, or is made for other environments only."""
    able = getattr(maker, "actions", (action,))
    if action not in able:
        raise BadArgument(
            f"the policy {quoted(name)} uses the action {' or '.join(able) or 'none'}, not {action}"
        )
    known = getattr(maker, "environments", ())
    if known and environment not in known:
        raise BadArgument(
            f"the policy {quoted(name)} is made for {' and '.join(known)}, not for {environment}"
        )


def played(policy: Any, episode: Episode) -> None:
    """Let a policy play an episode to its end. If the policy ends before the episode, the machine stands still until
    the time limit: the policy has not reported that the work is done.

    Raises:
        BadArgument: the object is not a policy. An exception that the policy raises also reaches the caller.
    """
    act = getattr(policy, "act", policy)
    if not (hasattr(policy, "play") or callable(act)):
        raise BadArgument(
            f"the function that makes the policy returned an object of type {type(policy).__name__}; it must return an "
            "object with `play` or `act`, or a function from observations to actions"
        )
    try:
        if hasattr(policy, "play"):
            policy.play(episode)
        else:
            _Function(episode.facts, act).play(episode)
        while True:
            episode.step(_still(episode))
    except EpisodeOver:
        return


class _Function(Policy):
    def __init__(self, facts: Facts, function: Callable[[Observation], Array]) -> None:
        super().__init__(facts)
        self._function = function

    def act(self, observation: Observation) -> Array:
        return self._function(observation)


def _still(episode: Episode) -> Array:
    """Return the action that commands no motion, and sets the brakes of a machine that has brakes."""
    return np.array([float(part.name == "brake") for part in episode.facts.components])
