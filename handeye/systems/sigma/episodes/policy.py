"""The program of the job as a policy: it acts only through the action space, and knows only what it observes."""

from typing import Final

from handeye.core.errors import Refused
from handeye.core.mutable_records import MutableRecord
from handeye.env.policies import Episode, Policy
from handeye.env.spaces import encoded
from handeye.ports.microbus import PAGE, Command, MicrobusPort, NoAnswer, Status
from handeye.program.events import SystemEvent
from handeye.systems.sigma.chess.heights import ToldHeight, told_height
from handeye.systems.sigma.episodes.job import CHESS
from handeye.systems.sigma.mal.happenings import Printed
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import DEVICES, NUMBERS, STEP_MM, Op
from handeye.systems.sigma.run.jobs import job_plan

_PIECES: Final = 2  # the program is the same for any number of pieces
_ORDER: Final = tuple(NUMBERS[name] for name in ("X1", "Y1", "Z1", "HAND1"))  # as in `status`
_WAYS: Final = dict(zip(_ORDER, ("x", "y", "z"), strict=False))


class ProgramPolicy(Policy):
    """Executes the program of the job. When the program ends without a fault, the policy reports that the work is
    done. If a fault stops the program, the policy waits for the time limit.
    """

    actions = ("hand",)
    environments = (CHESS.id,)

    def play(self, episode: Episode) -> None:
        bus = _SeenBus(episode)

        def tell(event: SystemEvent) -> None:
            if isinstance(event, Printed) and (told := told_height(event.text)) is not None:
                bus.report(told)

        machine = VirtualMachine(job_plan("chess", _PIECES).program, bus, tell, statement_us=0)
        machine.begin()
        while machine.turn:
            machine.statement()
            machine.settle()
        if machine.memory.fault is None:
            bus.step(done=1.0)


class _SeenBus(MicrobusPort):
    """A microbus whose commands and questions go to an episode. The bus collects the commands for one step of the
    episode, and combines them into one action.
    """

    def __init__(self, episode: Episode) -> None:
        self._episode = episode
        self._close = 0.0
        self._next: dict[str, float] = {}  # components of the next action
        self._sent: set[int] = set()  # microcomputers to which it gives a command
        self._aborts: dict[int, Status] = {}  # aborts that no question has cleared
        self._got = b""

    def step(self, **values: float) -> None:
        """Carry out what was collected."""
        action = {"close": self._close} | self._next | values
        self._next, self._sent = {}, set()
        seen = self._episode.step(encoded(self._episode.facts.components, action))
        for number, status in zip(_ORDER, map(Status, seen["status"]), strict=True):
            if status.aborted:
                self._aborts[number] = status

    def report(self, told: ToldHeight) -> None:
        """Let the next action report the height of a piece."""
        self._next |= {
            "report": 1.0, "report.height": told.height, "report.at": told.x, "report.line": float(told.line),
        }  # fmt: skip

    # -- the port ----------------------------------------------------------------------------------------

    @property
    def now(self) -> int:
        return round(float(self._episode.observation["clock"][0]) * 1e6)

    @property
    def next_event(self) -> int | None:
        busy = self._sent or Status.BUSY in self._episode.observation["status"]
        return self.now + round(self._episode.facts.period * 1e6) if busy else None

    def wait(self, until: int) -> int:
        self.step()
        return self.now

    @property
    def free(self) -> bool:
        return True

    def begin(self, command: Command, answer: int = 0) -> None:
        if answer:
            self._answer(command, answer)
            return
        self._sent.add(command.number)
        self._aborts.pop(command.number, None)
        if command.op == Op.ACTUATE and command.detail == DEVICES["HAND"]:
            self._close = float(command.value)
            return
        way = _WAYS[command.number]
        if command.op == Op.ORIGIN:
            self._next[f"origin.{way}"] = 1.0
        elif command.op == Op.MOVE:
            steps = -command.value if command.detail & 1 else command.value
            goal = self._reading("count", command.number) + steps
            self._next |= {f"set.{way}": 1.0, f"goal.{way}": goal * STEP_MM}
        else:
            raise Refused(f"no action of the environment can carry the bus command {Op(command.op).name}")

    def answer(self) -> bytes:
        return self._got

    def page(self, number: int) -> int:
        return sum(self._status(number * PAGE + place) << 2 * place for place in range(PAGE))

    def begun(self, number: int) -> bool:
        return True  # a short motion may be over at the end of the period

    @property
    def interrupt(self) -> bool:
        return bool(self._aborts)

    @property
    def memory(self) -> MutableRecord:
        raise Refused("an episode cannot be saved")

    def remember(self, memory: MutableRecord) -> None:
        raise Refused("an episode cannot be saved")

    # -- inside ------------------------------------------------------------------------------------------

    def _status(self, number: int) -> Status:
        if number in self._sent:
            return Status.BUSY
        if number in self._aborts:
            return self._aborts[number]
        if number not in _ORDER:
            return Status.FREE
        status = Status(self._episode.observation["status"][_ORDER.index(number)])
        return Status.BUSY if status is Status.BUSY else Status.FREE

    def _answer(self, question: Command, count: int) -> None:
        """Take the answer to a question from the last observation. If commands were collected, execute them first."""
        if self._sent:
            self.step()
        self._aborts.pop(question.number, None)
        match question.op:
            case Op.BEAM:
                self._got = bytes((int(self._episode.observation["beam"][0]),))
            case Op.POSITION:
                self._got = self._reading("count", question.number).to_bytes(2, "big", signed=True)
            case Op.ABORT_POSITION:
                self._got = self._reading("stopped", question.number).to_bytes(2, "big", signed=True)
            case _:
                raise NoAnswer(question.number, 0, count)

    def _reading(self, name: str, number: int) -> int:
        """Return the position (steps) that axis `number` has reported in the field `name` of the observation."""
        return round(float(self._episode.observation[name][_ORDER.index(number)]) / STEP_MM)
