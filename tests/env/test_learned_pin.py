"""The learned policy for the pin: its weights, what it sees, and an episode in a world in which it was not trained."""

import csv
from pathlib import Path

import numpy as np
import pytest

from examples.learned_pin.policy import WEIGHTS, LearnedPin, Network
from examples.learned_pin.senses import FEATURES
from examples.learned_pin.teacher import answer
from handeye.core.pose import Array
from handeye.env.environment import AssemblyEnv
from handeye.env.evaluation import play

ROOT = Path(__file__).parents[2]
UNSEEN = 975000
"""The first world of the result in docs/environments.md. The training used worlds from 5000."""


def features(seen: dict[str, float]) -> Array:
    """Features of a pin in the air over the face, but for those that are given."""
    return np.array([seen.get(name, 0.0) for name in FEATURES])


def test_the_weights_are_a_small_file_without_pickle() -> None:
    layers = Network.load().layers
    assert [weights.shape for weights, _ in layers] == [(len(FEATURES), 64), (64, 64), (64, 4)]
    assert all(np.isfinite(part).all() for layer in layers for part in layer)
    assert WEIGHTS.stat().st_size < 200_000


def test_the_same_network_is_written_as_the_same_bytes(tmp_path: Path) -> None:
    Network.load().save(tmp_path / "again.npz")
    assert (tmp_path / "again.npz").read_bytes() == WEIGHTS.read_bytes()


def test_the_teacher_says_done_only_of_a_pin_that_stands_deep_and_pressed() -> None:
    seated = {"touched": 1, "height over the face": -1.9, "height": -2.23, "lag, vertical, averaged": -2}
    assert answer(features(seated))[3] == 1
    for otherwise in (
        {"height over the face": 0, "height": -0.33},  # pressed, but on the face
        {"lag, vertical, averaged": -0.5},  # deep, but not pressed
        {"rise in .35 s": -0.5},  # still on its way down
    ):
        assert answer(features(seated | otherwise))[3] == 0


def test_the_page_shows_the_curve_that_the_training_wrote() -> None:
    page = (ROOT / "docs/environments.md").read_text(encoding="utf-8")
    with (ROOT / "examples/learned_pin/curve.csv").open(encoding="utf-8", newline="") as file:
        _, *rows = csv.reader(file)
    for number, *found in rows:
        actor = "teacher" if number == "0" else "network"
        assert f"| {number} | {actor} | {' | '.join(found)} |" in page


@pytest.mark.slow
def test_it_inserts_the_pin_in_an_unseen_world_with_the_same_actions_each_time() -> None:
    env, acted = AssemblyEnv("handeye/Pin-v0"), []

    class Noted(LearnedPin):
        def act(self, observation: object) -> Array:
            acted.append(super().act(observation))  # type: ignore[arg-type]
            return acted[-1]

    found = play(env, Noted, UNSEEN)
    assert found.referee["outcome"] == "right"
    first, (seen, _) = acted[:20], env.reset(seed=UNSEEN)
    again = LearnedPin(env.facts())
    for action in first:
        assert env.action_space.contains(action)
        assert again.act(seen).tobytes() == action.tobytes()
        seen, *_ = env.step(action)
