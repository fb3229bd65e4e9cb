"""A game: one fault is planted, and the player finds the faulty part with the tests of the paper. Fewer tests
are better."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final, NamedTuple

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.plain_text import counted
from handeye.core.source import read_source
from handeye.execution.servo import Halted
from handeye.program.events import SystemEvent
from handeye.systems.sigma.diagnosis import means
from handeye.systems.sigma.diagnosis.bench import Bench
from handeye.systems.sigma.diagnosis.faults import FAULTS, drawn
from handeye.systems.sigma.diagnosis.strategy import Strategy, Verdict, swapped
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.happenings import Printed
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import ANSWERS, AXES, NUMBERS, Op, name_of, position, self_test, signed

PARTS: Final = (
    "computer", "segment N", "regenerator N", "microcomputer NAME", "status line A|B of NAME", "interrupt wire",
    "driver of AXIS", "supply", "low|high switch of AXIS", "gauge X|Y|Z of wrist N", "accelerometer X|Y|Z of wrist N",
    "multiplexer of wrist N", "converter of wrist N", "beam of hand N", "lamp of hand N", "fingers of hand N",
)  # fmt: skip
_LONGEST_RUN: Final = 300_000_000  # microseconds


class Means(NamedTuple):
    """An action that a player can take. `counts` is True if the action counts as a test."""

    usage: str
    help: str
    counts: bool = True  # True: the action counts as a test


MEANS: Final = {
    "selftest": Means("selftest", "the power-on self-tests"),
    "clocks": Means("clocks", "measure how long each microcomputer takes to answer"),
    "strobe": Means("strobe", "make a microcomputer become free while another one receives a command"),
    "force": Means("force ARM", "apply known forces to a wrist, along each of its axes X, Y and Z"),
    "beam": Means(
        "beam ARM",
        "read the light beam of a hand three times: with nothing in the beam, with a rod, and with a grey filter",
    ),
    "grip": Means("grip ARM", "close a hand on a block that is not midway between the fingers"),
    "origin": Means("origin AXIS", "use ORIGIN to move to the low end of a rail"),
    "rail": Means("rail AXIS", "move to the high end of a rail"),
    "moves": Means(
        "moves AXIS",
        "move along a rail at full speed, then slowly back to the low switch, and look for lost steps",
    ),
    "load": Means("load AXIS", "move slowly against a spring balance, and look for lost steps"),
    "together": Means("together", "move all axes together at full speed, and look for lost steps"),
    "ask": Means("ask NAME", "ask a motor for its step count, or another microcomputer for its self-test"),
    "status": Means("status", "read the status lines of all microcomputers"),
    "swap": Means("swap NAME", "replace a microcomputer with a spare one, and switch the machine off and on"),
    "run": Means("run FILE.mal", "run a program of your own"),
    "accuse": Means("accuse PART", "name the part that has the fault; this ends the game", counts=False),
    "parts": Means("parts", "list the parts that can be accused, and the possible faults", counts=False),
    "help": Means("help", "show this list", counts=False),
    "quit": Means("quit", "give up, and show the fault", counts=False),
}


class Game:
    """A game with the fault that a seed determines."""

    def __init__(
        self, tell: Callable[[str], None], seed: int, poll: Callable[[], None] = lambda: None
    ) -> None:
        """Begin a game. `poll` is called while a program of the player runs, and may raise Halted."""
        self._tell, self.seed, self._poll = tell, seed, poll
        self.planted = drawn(seed)
        self._bench = Bench(self.planted, seed)
        self.tests = 0
        self.accused = ""
        self.over = False

    @property
    def won(self) -> bool:
        """True if the accused part has the fault."""
        return self.accused == self.planted.part

    def begin(self) -> None:
        """Explain the game to the player."""
        self._tell(
            f"One of {len(FAULTS)} faults is planted in SUPERSIGMA. Find the faulty part, in as few tests as you can. "
            "`help` lists the tests, and `parts` lists the parts that you can accuse."
        )

    def words(self) -> Sequence[str]:
        """Return the words that can complete a line."""
        return [*MEANS]

    def hear(self, line: str) -> None:
        """Do what the player has typed. If the player's line cannot be executed, raises InvalidInput and counts no
        test.
        """
        word, _, rest = line.strip().partition(" ")
        word, rest = word.lower(), rest.strip()
        if not word:
            return
        if word not in MEANS:
            near = suggestion(word, MEANS) or "`help` lists the tests and commands"
            raise NoSuchName(f"{quoted(word)} is not a test or a command of this game; {near}")
        if bool(rest) != (" " in MEANS[word].usage):
            raise BadArgument(f"the form is `{MEANS[word].usage}`")
        lines = getattr(self, f"_{word}")(rest)
        self.tests += MEANS[word].counts
        for each in lines:
            self._tell(each)

    # -- tests -----------------------------------------------------------------------------------------------

    def _selftest(self, _: str) -> Sequence[str]:
        return means.self_tests(self._bench).lines

    def _clocks(self, _: str) -> Sequence[str]:
        return means.clocks(self._bench).lines

    def _strobe(self, _: str) -> Sequence[str]:
        return means.strobe(self._bench).lines

    def _force(self, arm: str) -> Sequence[str]:
        return means.forces(self._bench, _arm(arm)).lines

    def _beam(self, arm: str) -> Sequence[str]:
        return means.beam(self._bench, _arm(arm)).lines

    def _grip(self, arm: str) -> Sequence[str]:
        return means.grip(self._bench, _arm(arm)).lines

    def _origin(self, axis: str) -> Sequence[str]:
        return means.origin(self._bench, _axis(axis)).lines

    def _rail(self, axis: str) -> Sequence[str]:
        return means.rail(self._bench, _axis(axis)).lines

    def _moves(self, axis: str) -> Sequence[str]:
        return means.moves(self._bench, _axis(axis)).lines

    def _load(self, axis: str) -> Sequence[str]:
        return means.load(self._bench, _axis(axis)).lines

    def _together(self, _: str) -> Sequence[str]:
        return means.moves(self._bench, *AXES).lines

    def _swap(self, name: str) -> Sequence[str]:
        return swapped(self._bench, _name(name)).lines

    def _ask(self, name: str) -> Sequence[str]:
        name = _name(name)
        command = position(name) if name in AXES else self_test(name)
        answer = means.asked(self._bench.bus, command)
        if answer is None:
            return [f"{name}: no answer"]
        value = signed(answer) if command.op in ANSWERS and command.op != Op.SELF_TEST else answer[0]
        what = "is at step" if name in AXES else "answers to its self-test"
        return [f"{name} {what} {value}"]

    def _status(self, _: str) -> Sequence[str]:
        bus = self._bench.bus
        states = ((place.number, bus.status(place.number)) for place in self._bench.layout.places)
        each = ", ".join(f"{name_of(number)} {status >> 1}-{status & 1}" for number, status in states)
        return [f"{each}; interrupt {'high' if bus.interrupt else 'low'}"]

    def _run(self, file: str) -> Sequence[str]:
        out: list[str] = []

        def hear(event: SystemEvent) -> None:
            if isinstance(event, Printed):
                out.append(event.text)

        program = program_of(file, read_source(Path(file)).text)
        bus = self._bench.bus
        vm = VirtualMachine(program, bus, hear, poll=self._poll)
        try:
            vm.begin()
            while vm.turn and bus.now < vm.memory.began + _LONGEST_RUN:
                vm.statement()
                vm.settle()
        except Halted:
            return [*out, f"stopped at {vm.time:.3f} s"]
        fault = vm.memory.fault
        end = (
            fault.told
            if fault
            else f"the program is still running after {_LONGEST_RUN / 1e6:g} s"
            if vm.memory.tasks
            else "the program finished"
        )
        return [*out, end]

    # -- the rest --------------------------------------------------------------------------------------------

    def _parts(self, _: str) -> Sequence[str]:
        return [
            "parts: " + "; ".join(PARTS),
            "a fault is one of: " + "; ".join(fault.help for fault in FAULTS.values()),
        ]

    def _help(self, _: str) -> Sequence[str]:
        width = max(len(each.usage) for each in MEANS.values())
        return [
            f"{each.usage:{width}}  {each.help}{'' if each.counts else ' (no test)'}"
            for each in MEANS.values()
        ]

    def _quit(self, _: str) -> Sequence[str]:
        self.over = True
        return [f"The fault: {self.planted.told}."]

    def _accuse(self, part: str) -> Sequence[str]:
        self.accused, self.over = known_part(part), True
        right = "Right" if self.won else "Wrong"
        usual = Strategy(Bench(self.planted, self.seed)).diagnose()
        paper = (
            f"the order of tests in the paper finds the part after {counted(usual.tests, 'test')}"
            if usual.part == self.planted.part
            else f"the order of tests in the paper needs {counted(usual.tests, 'test')} and does not find the part"
        )
        return [f"{right}: {self.planted.told}. You used {counted(self.tests, 'test')}; {paper}."]


def demonstrate(game: Game, tell: Callable[[str], None]) -> Verdict:
    """Play a game with the tests in the order of the paper. The function types the same lines as a player would."""

    def show(typed: str, _: Sequence[str]) -> None:
        tell(f"> {typed}")
        game.hear(typed)

    verdict = Strategy(Bench(game.planted, game.seed), show).diagnose()
    tell(f"({verdict.why})")
    last = f"accuse {verdict.part}" if verdict.part else "quit"
    tell(f"> {last}")
    game.hear(last)
    return verdict


def _arm(text: str) -> int:
    if text not in ("1", "2"):
        raise BadArgument(f"the arm must be 1 or 2, not {quoted(text)}")
    return int(text)


def _axis(text: str) -> str:
    if text.upper() not in AXES:
        raise NoSuchName(f"there is no axis {quoted(text)}; the axes are {', '.join(AXES)}")
    return text.upper()


def _name(text: str) -> str:
    if text.upper() not in NUMBERS:
        raise NoSuchName(
            f"there is no microcomputer {quoted(text)}; the microcomputers are {', '.join(NUMBERS)}"
        )
    return text.upper()


def _all_parts() -> dict[str, str]:
    """Return a dictionary from the name of each part in lower case to its usual spelling."""
    parts = ["computer", "interrupt wire", "supply", "regenerator 1", "segment 0", "segment 1"]
    for name in NUMBERS:
        parts += [f"microcomputer {name}", f"status line A of {name}", f"status line B of {name}"]
    for axis in AXES:
        parts += [f"driver of {axis}", f"low switch of {axis}", f"high switch of {axis}"]
        parts += [f"{what} {axis[0]} of wrist {axis[1]}" for what in ("gauge", "accelerometer")]
    for arm in (1, 2):
        parts += [f"{what} of wrist {arm}" for what in ("multiplexer", "converter")]
        parts += [f"{what} of hand {arm}" for what in ("beam", "lamp", "fingers")]
    return {part.lower(): part for part in parts}


def known_part(text: str) -> str:
    """Return the name of a part in its usual spelling. Raises NoSuchName if no part has this name."""
    parts, typed = _all_parts(), " ".join(text.lower().split())
    if typed not in parts:
        near = suggestion(typed, parts) or "`parts` lists them"
        raise NoSuchName(f"there is no part {quoted(text)}; {near}")
    return parts[typed]
