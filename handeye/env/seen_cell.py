"""The devices of a cell for a policy. Commands to these devices become actions, and their readings come from
observations. Code that uses the ports, such as the servo and the executor of programs, can therefore run as a policy.
The code acts only through the action space, and knows only what the observations say.
"""

from handeye.core.pose import Array
from handeye.env.policies import Episode
from handeye.env.spaces import encoded
from handeye.ports.camera import CLOSE_UP, Picture, Renderer, TvCamera
from handeye.ports.clock import Clock
from handeye.ports.workcell import ArmPort, ArmReading, HandPort, HandReading, ScrewdriverPort, Workcell


class _Commands:
    """The commands that the devices have received since the last action. The next action carries them out."""

    def __init__(self, episode: Episode) -> None:
        self.episode = episode
        self.values: dict[str, float] = {"brake": 1.0, "magnet": 1.0}
        self.torque: Array | None = None

    def step(self, *, done: bool = False) -> None:
        """Carry out the commands for a servo period. Raises EpisodeOver at the end of the episode."""
        driven = {} if self.torque is None else {f"torque.{k}": each for k, each in enumerate(self.torque, 1)}
        values = {**self.values, **driven, "brake": float(self.torque is None), "done": float(done)}
        self.values |= dict.fromkeys(("set_lens", "set_aim", "set_focus"), 0.0)
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


class _Camera(TvCamera):
    """The television camera. The observation does not show when the camera's mechanism has moved. Each movement is
    therefore reported with the duration 0, and the wait for the next picture includes the time of the movement.
    """

    def __init__(self, commands: _Commands) -> None:
        self._commands = commands

    def lens(self, focal_length: float) -> float:
        if self._commands.values.get("set_aim") or self._commands.values.get("set_focus"):
            self._commands.step()  # in one action, the lens comes first
        return self._send(set_lens=1.0, close_up=float(focal_length == CLOSE_UP))

    def aim(self, pan: float, tilt: float) -> float:
        return self._send(set_aim=1.0, pan=pan, tilt=tilt)

    def focus(self, distance: float) -> float:
        return self._send(set_focus=1.0, focus=1 / distance)

    def pots(self) -> tuple[float, float]:
        pan, tilt = self._commands.episode.observation["camera"]
        return float(pan), float(tilt)

    def digitise(self, *, hold_target: bool = False) -> Picture:
        self._commands.values |= {"look": 1.0, "hold_target": float(hold_target)}
        self._commands.step()
        self._commands.values["look"] = 0.0
        while self._commands.episode.observation["picture_age"][0] != 0.0:
            self._commands.step()
        picture: Picture = self._commands.episode.observation["picture"]
        return picture

    @property
    def renderer(self) -> Renderer:
        return Renderer(method="none")

    def _send(self, **values: float) -> float:
        self._commands.values |= values
        return 0.0


class SeenClock(Clock):
    """The clock of an episode. Each servo period that passes is a step of the environment."""

    def __init__(self, commands: _Commands) -> None:
        self._commands = commands

    @property
    def now(self) -> float:
        return float(self._commands.episode.observation["clock"][0])

    def advance(self, seconds: float) -> None:
        for _ in range(round(seconds / self._commands.episode.facts.period)):
            self._commands.step()

    def done(self) -> None:
        """Report that the work is done. Always raises EpisodeOver, because this report ends the episode."""
        self._commands.step(done=True)


def seen_cell(episode: Episode) -> tuple[Workcell, SeenClock]:
    """Return the devices and the clock of an episode whose actions are torques."""
    commands = _Commands(episode)
    clock = SeenClock(commands)
    cell = Workcell(
        clock=clock,
        arm=_Arm(commands),
        hand=_Hand(commands),
        screwdriver=_Screwdriver(commands),
        camera=_Camera(commands) if "picture" in episode.observation else None,
    )
    return cell, clock
