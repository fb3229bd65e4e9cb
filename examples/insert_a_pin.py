"""A policy of your own for `handeye/Pin-v0`: it moves the hand's set-point, and feels contact when the hand lags."""

import numpy as np

from handeye.arm.kinematics import forward
from handeye.env.environment import AssemblyEnv
from handeye.env.evaluation import play
from handeye.env.policies import Episode, Policy
from handeye.touch.spiral import spiral

PRESSED, FACE, NOSE, STEP = 0.003, 0.0033, 0.01905, 0.0018  # m; a lag of 3 mm is about 16 N
MOVES = ("move.x", "move.y", "move.z")  # 2 mm at 1


class SpiralPin(Policy):
    """Comes down at one place of a spiral after another until the pin stands on its shoulder, and then says done."""

    actions = ("hand",)

    def play(self, episode: Episode) -> None:
        self.episode, place = episode, 0
        self.at = start = self.hand()
        while True:
            x, y = spiral(place)
            self.go(start + np.array([x * STEP, y * STEP, 0.0]), 0.0005)
            deepest = start[2] - FACE - NOSE
            if self.go((*self.at[:2], deepest - 0.02), 0.00005) and self.hand()[2] < deepest + 0.0025:
                episode.step(self.action(done=1.0))
            place += 1

    def go(self, goal: np.ndarray, speed: float) -> bool:
        """Move the set-point to a goal (m), at `speed` (m per period). Returns True if the hand pressed on the way."""
        while np.linalg.norm(way := np.subtract(goal, self.at)) > 1e-6:
            self.at = self.at + (moved := way * min(1.0, speed / np.linalg.norm(way)))
            self.episode.step(self.action(**dict(zip(MOVES, moved / 0.002, strict=True))))
            if way[2] < 0 and self.hand()[2] - self.at[2] > PRESSED:
                return True
        return False

    def hand(self) -> np.ndarray:
        return forward(self.facts.arm, self.episode.observation["q"])[:3, 3]

    def action(self, **values: float) -> np.ndarray:
        return np.array([values.get(part.name, float(part.name == "grip")) for part in self.facts.components])


if __name__ == "__main__":
    found = play(AssemblyEnv("handeye/Pin-v0", action="hand"), SpiralPin, seed=1)
    print(f"{found.referee['outcome']} after {found.seconds:.1f} s, with {found.referee['peak_N']:.0f} N")
