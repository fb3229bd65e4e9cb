"""Policies are counted by what the referee says of them, and the included ones know only what they observe."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Command

from handeye.core.errors import BadArgument
from handeye.env.evaluation import EPISODES, EpisodeRow, Evaluation
from handeye.env.policies import Episode, played
from handeye.trials.figures import figures
from handeye.trials.sweep import Case

PIN = "handeye/Pin-v0"
LIARS = """
import numpy as np
from handeye.env.policies import Policy

def liar(facts):
    said = np.zeros(len(facts.components))
    said[-1] = 1.0
    return lambda observation: said

class Sleeper(Policy):
    def play(self, episode):
        return

class Broken(Policy):
    def act(self, observation):
        raise ValueError("no such joint")
"""


@pytest.mark.slow
def test_the_scripted_policy_inserts_the_pin_by_touch(command: Command) -> None:
    code, out, _ = command("env", "evaluate", "scripted", "--seed", "1", "--n", "1", "--jobs", "1", "--json")
    found = json.loads(out)
    assert (code, found["success"]["successes"], found["false_done"]["successes"]) == (0, 1, 0)
    assert found["reached"] == {"insert the pin": 1}
    assert found["measures"]["peak, N"]["most"] < 45
    assert found["measures"]["seconds"]["most"] < 12


@pytest.mark.slow
def test_the_program_acts_through_the_actions_as_it_acts_on_the_ports() -> None:
    (row,) = Evaluation(policy="program", environment=PIN, action="torques")(Case(trials=(0,), seed=1))
    assert (row.said, row.steps) == (
        "right",
        round(row.seconds * 60) - 5,
    )  # the last step waits for six periods
    assert row.seconds == pytest.approx(3.9, abs=0.2)  # as long as the run itself takes for this stage


@pytest.mark.slow
def test_a_policy_of_ones_own_is_named_and_its_false_done_counted(command: Command) -> None:
    Path("liars.py").write_text(LIARS, encoding="utf-8")
    code, out, _ = command("env", "evaluate", "liars:liar", "--n", "3", "--jobs", "1", "--json")
    found = json.loads(out)
    assert (code, found["silent_failures"], found["right"]) == (3, 3, 0)
    assert (found["false_done"]["rate"], found["success"]["rate"]) == (1.0, 0.0)
    code, out, _ = command("env", "evaluate", "liars:Sleeper", "--n", "1", "--jobs", "1", "--limit", "1")
    assert code == 0
    assert "0 of 1 right, 0 silent failures, 1 not done" in out
    code, out, _ = command("env", "evaluate", "liars:Broken", "--n", "1", "--jobs", "1")
    assert code == 1
    assert "ValueError: no such joint" in out


def test_rates_count_every_episode_but_those_that_the_computer_lost() -> None:
    def row(trial: int, said: str = "", **more: object) -> EpisodeRow:
        return EpisodeRow(trial=trial, seed=trial, said=said, **more)  # type: ignore[arg-type]

    rows = [
        row(0, "right"),
        row(1, "false done"),
        row(2, "not done"),
        row(3, ended="raised"),
        row(4, ended="machine"),
    ]
    more = EPISODES.more(rows)
    assert (more["success"].trials, more["success"].successes) == (4, 1)  # type: ignore[attr-defined]
    assert (more["false_done"].trials, more["false_done"].successes) == (4, 1)  # type: ignore[attr-defined]
    assert figures(EPISODES, rows).exit_code == 3


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (
            ("nobody",),
            "there is no policy `nobody`; the policies are `random`, `program`, `scripted`, or MODULE:NAME",
        ),
        (("no_such:thing",), "the policy `no_such:thing` cannot be imported"),
        (("math:pi",), "`math:pi` is not a policy"),
        (("a-b:c",), "name a policy as MODULE:NAME"),
        (("scripted", "--action", "hand"), "the policy `scripted` uses the action torques, not hand"),
        (
            ("scripted", "--env", "handeye/Pump-v0"),
            "the policy `scripted` is made for handeye/Pin-v0, not for handeye/Pump-v0",
        ),
        (("random", "--env", "handeye/Pin"), "there is no environment `handeye/Pin`"),
        (("random", "--limit", "0"), "limit_s must be more than 0 s"),
        (("random", "--n", "0"), "0"),
    ],
)
def test_what_cannot_be_evaluated_is_said_before_the_first_episode(
    command: Command, words: tuple[str, ...], told: str
) -> None:
    code, out, err = command("env", "evaluate", *words)
    assert (code, out) == (2, "")
    assert told in err


def test_the_list_names_every_environment(command: Command) -> None:
    code, out, _ = command("env", "list", "--json")
    assert code == 0
    assert [each["id"] for each in json.loads(out)][:2] == [PIN, "handeye/Screw-v0"]


def test_an_object_with_act_is_a_policy_without_a_base_class() -> None:
    class Actor:
        def act(self, observation: object) -> str:
            return f"answers {observation}"

    asked: list[object] = []

    def advance(action: object) -> tuple[str, bool]:
        asked.append(action)
        return "second", True

    facts: Any = None
    played(Actor(), Episode(facts=facts, observation="first", advance=advance))  # type: ignore[arg-type]
    assert asked == ["answers first"]


@pytest.mark.parametrize("made", [None, np.zeros(13)], ids=["nothing", "an action"])
def test_a_function_of_observations_that_is_named_as_the_maker_of_a_policy_is_explained(made: object) -> None:
    episode = Episode(facts=None, observation={}, advance=lambda _: ({}, True))  # type: ignore[arg-type]
    with pytest.raises(
        BadArgument, match=rf"returned an object of type {type(made).__name__}; it must return an"
    ):
        played(made, episode)
