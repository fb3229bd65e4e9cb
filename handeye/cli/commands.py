"""The commands by name, each loaded when it is called or asked for its help; lists of commands load none."""

from contextlib import suppress
from types import FunctionType
from typing import Final

from cyclopts import App
from cyclopts.command_spec import CommandSpec

from handeye.core.entries import loaded

COMMANDS: Final = """
assemble = runs:assemble: Assemble the water pump, or do another task with its own program: plan, work, judge.
run = runs:run: Carry out a plan in the work cell of its task, or stages of it, or step by step.
resume = runs:resume: Resume an interrupted run.
dismantle = dismantling:dismantle: Have the arm undo what it did in a run: take the pump apart again.
show = reports:show: Show the result of a run, or how far it has got; its folder is not changed.
report = reports:report: Make a page of a run, or of two: one file with what happened, why, and what was seen and felt.
video = videos:video: Make a video of a recorded run; nothing is simulated.
view = views:view: Show the live cell in a browser, and step a run or teach positions there; or show a run that was recorded.
compare = reports:compare: Compare two runs, step by step: what went otherwise first, where each searched, felt and corrected.
do = teaching:do: Plan functions and carry them out at once, each by itself: `handeye do "OPEN 3" PARK`.
repl = teaching:repl: Type functions to collect and check them; DO carries them out. HELP lists the commands.
teach = teaching:teach: Move the arm and name positions; new names go into the taught file, and the rest of it stays.
check = scripts:check: Check a script and its taught positions, the arm's reach included; nothing moves.
plan = scripts:plan: Compile a script into a plan.
stages = scripts:stages: List the stages of a plan and their steps, with lines of the source.
fmt = editing:fmt: Format scripts in columns, as in a listing of the period; comments stay.
explain = editing:explain: Explain a diagnostic's code, an error number or an instruction; without an argument, list the codes.
lsp = editing:lsp: Serve an editor over standard input and output (language server protocol).
export: Hand a world, or what a run has left, to other programs.
export mjcf = exports:mjcf: Write a scene that plain MuJoCo opens: scene.xml, its meshes and textures, and a README.
export glb = exports:glb: Write solids for programs that show or measure shapes, and check that they are closed and weigh what they should.
inspect = scripts:inspect: Show what a plan does: stages, steps, times, guards, forces, and what each step depends on.
diff = scripts:diff: Compare what two plans do, step by step.
schema = scripts:schema: Print the JSON schema of the plan format.
trace: Read the traces that runs leave.
trace show = traces:show: Show what happened in a run, and why.
trace stats = traces:stats: Count and time what happened in a run, stage by stage.
trace photograph = traces:photograph: Photograph the cell as it was at a moment of a recorded run; nothing is simulated.
trace verify = traces:verify: Carry out a recorded run again and compare.
trace thin = exports:thin: Write a trace with no more of the motion than it takes to show the run, a tenth as large.
trace plot = exports:plot: Draw joints, force of the hand and events of a run against time; it needs the extra `plot`, matplotlib.
trace export: Write joints, forces and events of a run as tables.
trace export csv = exports:csv: Write tables of a run as CSV, with a README that tells their columns.
trace export parquet = exports:parquet: Write tables of a run as Parquet, with a README that tells their columns; it needs the extra `export`, pyarrow.
world = worlds:world: List every quantity in which worlds differ: what it is in this world, unit, spread and source.
render = worlds:render: Render a picture of the work cell.
faults = fault_matrix:faults: Assemble once with each fault of a matrix, at its usual size, and say which were noticed.
trials: Try in many worlds and count.
trials assembly = batches:assembly_trials: Assemble in many worlds and count: how often, how sure that is, and what failed where.
trials dismantling = batches:dismantling_trials: Assemble in many worlds, have the arm take each apart again, and count how often everything is where it was.
trials disturbed = trials:disturbed_trials: Build a pump, change something behind the arm's back, and have the arm undo it: is it stopped before harm?
trials compare = batches:compare_trials: Compare batches with a first one, world by world: what a sense, or an error of the world, makes of the rate.
trials base = trials:base_vision_trials: Find the base on the belt at many poses: how often, how exactly, and how often wrongly.
trials gasket = trials:gasket_vision_trials: Check gaskets of every kind by eye: on properly, shifted by .3 in, absent, and one on another.
trials chaos = trials:chaos_trials: Draw faults, times, worlds, kills, panics, retries and skips together, and check what must always hold.
bench: Measure how long things take.
bench timing = benches:timing: Assemble once and print the timing table beside that of 1973.
bench insertion = benches:insertion: Put one pin into one hole, many times: success, peak force, and time from the first contact to seated.
"""  # noqa: E501 - a command a line
"""`NAME = MODULE:FUNCTION: SENTENCE` of each command, with the sentence that lists say of it, which is the first one of
its docstring; a group of commands has no function. Modules are those of this folder."""


class _Command(CommandSpec):
    def resolve(self, parent_app: App) -> App:
        """Import the command. Its own help is its docstring: the sentence is for lists, which do not import it."""
        self.help = None
        restore_docstring(loaded(self.import_path, "the command at "))
        return super().resolve(parent_app)


def restore_docstring(command: object) -> None:
    """Give a command the docstring back that Python leaves out with -OO, from its source: it is the help."""
    if isinstance(command, App):
        for part in (command.default_command, *command._commands.values()):
            restore_docstring(part)
    if command.__doc__ is not None or not isinstance(command, FunctionType):
        return
    import ast
    import inspect
    from textwrap import dedent

    with suppress(OSError):  # where the source is not shipped
        (written,) = ast.parse(dedent(inspect.getsource(command))).body
        assert isinstance(written, ast.FunctionDef)
        command.__doc__ = ast.get_docstring(written, clean=False)


def add_commands(app: App, table: str, folder: str = "") -> None:
    """Add the commands of a table to those there are, which stay; modules are full names where no `folder` is given."""
    for line in table.strip().splitlines():
        named, sentence = line.split(": ", 1)
        name, _, path = named.partition(" = ")
        *before, last = name.split()
        group = app
        for word in before:
            group = group[word]
        if not path:
            group.command(App(name=last, help=sentence))
            continue
        path = f"{folder}.{path}" if folder else path
        group._commands.setdefault(last, _Command(import_path=path, name=last, help=sentence))
