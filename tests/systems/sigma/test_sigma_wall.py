"""The wall between a MAL program and its machine is the bus: what carries programs out imports nothing else of it."""

import subprocess
import sys
from pathlib import Path
from typing import Final

from import_reading import imports

ROOT: Final = Path(__file__).parents[3]
MAL: Final = ROOT / "handeye/systems/sigma/mal"
ALLOWED: Final = (
    "handeye.core.", "handeye.ports.microbus", "handeye.systems.sigma.mal.", "handeye.systems.sigma.protocol",
    "handeye.program.events", "handeye.program.language", "handeye.program.mistakes", "handeye.systems.sigma.ENTRY",
)  # fmt: skip


def test_language_and_virtual_machine_know_the_bus_and_nothing_of_the_machine() -> None:
    found = {
        f"{file.stem}: {name}"
        for file in MAL.glob("*.py")
        for name in imports(file.read_text(encoding="utf-8"), f"systems.sigma.mal.{file.stem}")
        if name.startswith("handeye.")
        and not name.startswith(ALLOWED)
        and not name.startswith("handeye.systems.sigma.ENTRY")
    }
    assert found == set()


def test_no_numbers_of_physics_are_needed_to_carry_a_program_out() -> None:
    asked = (
        "import sys; from handeye.systems.sigma.mal.compiler import program_of\n"
        "from handeye.systems.sigma.machine.perfect import PerfectMotors\n"
        "from handeye.systems.sigma.mal.virtual_machine import VirtualMachine\n"
        "vm = VirtualMachine(program_of('a', '10 MOVE X1 BY 5'), PerfectMotors()); vm.begin(); vm.statement()\n"
        "print({'mujoco', 'scipy', 'cv2'} & {*sys.modules})"
    )
    done = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=False)
    assert done.stdout == "set()\n", done.stderr
