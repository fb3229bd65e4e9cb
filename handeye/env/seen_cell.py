"""The devices of a cell as a policy has them: commands become actions, and readings come from observations.

Code that is written against the ports, such as the servo and the executor of programs, then acts only through the
action space, and knows only what the observations say.
"""

from handeye.core.pose import Array
from handeye.env.policies import Episode
from handeye.env.spaces import encoded
from handeye.ports.clock import Clock
from handeye.ports.workcell import ArmPort, ArmReading, HandPort, HandReading, ScrewdriverPort, Workcell


class _Commands:
    """The commands that the devices have received, which the next action carries out."""

    def __init__(self, episode: Episode) -> None:
        self.episode = episode
        self.values: dict[str, float] = {"brake": 1.0, "magnet": 1.0}
        self.torque: Array | None = None

    def step(self, *, done: bool = False) -> None:
        """Carry out the commands for a servo period. Raises EpisodeOver at the end of the episode."""
        driven = {} if self.torque is None else {f"torque.{k}": each for k, each in enumerate(self.torque, 1)}
        values = {**self.values, **driven, "brake": float(self.torque is None), "done": float(done)}
        self.episode.step(encoded(self.episode.facts.components, values))


class _Arm(ArmPort):
    def __init__(self, commands: _Commands) -> None:
        self._commands = commands

    def read(self) -> ArmReading:
        seen = self._commands.episode.observation
        return ArmReading(q=seen["q"], qd=seen["qd"], braked=bool(seen["braked"][0]))

    def drive(self, torque: Array | None) -> None:
        self._commands.torque = torque


class _Hand(HandPort):
    def __init__(self, commands: _Commands) -> None:
        self._commands = commands

    def read(self) -> HandReading:
        seen = self._commands.episode.observation
        first, second = seen["touch"]
        return HandReading(gap=float(seen["gap"][0]), touch=(bool(first), bool(second)))

    def drive(self, gap: float, grip: float) -> None:
        self._commands.values |= {"gap": gap, "grip": grip}


class _Screwdriver(ScrewdriverPort):
    def __init__(self, commands: _Commands) -> None:
        self._commands = commands

    def torque(self) -> float:
        return float(self._commands.episode.observation["screwdriver"][0])

    def drive(self, speed: float) -> None:
        self._commands.values["driver"] = speed

    def attract(self, on: bool) -> None:
        self._commands.values["magnet"] = float(on)


class SeenClock(Clock):
    """The clock of an episode. Each servo period that passes is a step of the environment."""

    def __init__(self, commands: _Commands) -> None:
        self._commands = commands

    @property
    def now(self) -> float:
        return float(self._commands.episode.observation["clock"][0])

    def advance(self, seconds: float) -> None:
        for _ in range(round(seconds / self._commands.episode.facts.arm.servo.period)):
            self._commands.step()

    def done(self) -> None:
        """Say that the work is done. Raises EpisodeOver, because that ends the episode."""
        self._commands.step(done=True)


def seen_cell(episode: Episode) -> tuple[Workcell, SeenClock]:
    """Return the devices and the clock of an episode whose actions are torques."""
    commands = _Commands(episode)
    clock = SeenClock(commands)
    cell = Workcell(clock=clock, arm=_Arm(commands), hand=_Hand(commands), screwdriver=_Screwdriver(commands))
    return cell, clock
