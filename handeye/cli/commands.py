"""The commands by name. A command is imported when it is called or when its help is requested, but not when commands
are listed.
"""

from contextlib import suppress
from types import FunctionType
from typing import Final

from cyclopts import App
from cyclopts.command_spec import CommandSpec

from handeye.core.entries import loaded

COMMANDS: Final = """
demo = demo:demo: Show a recorded assembly of the pump: a 3D replay beside its program, with the camera pictures and the forces.
assemble = runs:assemble: Assemble the water pump, or do another task with its own program: plan, run, judge.
run = runs:run: Run a plan, or some of its stages, in the work cell of its task: straight through or step by step.
resume = runs:resume: Resume an interrupted run.
dismantle = dismantling:dismantle: Make the arm undo the steps of a run: take the pump apart again.
show = reports:show: Show the result of a run, or its progress so far, without changing the run folder.
report = reports:report: Write one self-contained HTML page of a run, or of two: 3D replay, pictures, forces, and what happened and why.
video = videos:video: Make a video of a recorded run, without simulating it again.
view = views:view: Step through a run or teach positions in a browser, which shows the live cell. Or show a recorded run.
compare = reports:compare: Compare two runs, step by step: show the first difference, and how the searches, stops and corrections of the runs differ.
do = teaching:do: Plan instructions and run them immediately, one after the other: `handeye do "OPEN 3" PARK`.
repl = teaching:repl: Type instructions, which are checked and collected; DO runs them. HELP lists the commands.
teach = teaching:teach: Move the arm and name positions; new names are added to the taught file, and the rest of the file is kept.
check = scripts:check: Check a script and its taught positions, and whether the arm reaches its goals; nothing moves.
plan = scripts:plan: Compile a script into a plan.
stages = scripts:stages: List the stages of a plan and their steps, with their source lines.
fmt = editing:fmt: Format scripts in columns, like a listing of 1973; comments are kept.
explain = editing:explain: Explain a diagnostic code, an error number or an instruction; without an argument, list the codes.
docs = docs:docs: List the pages of the documentation, or print one.
exercise = exercises:exercise: List the exercises of the course, show one of them, or grade a program. A grade says in which worlds the program is right, and gives hints.
lsp = editing:lsp: Serve an editor over standard input and output (language server protocol).
mcp = agents:mcp: Offer an agent twelve tools to write and judge programs, over standard input and output (model context protocol).
export: Export a world, or the state of a run, to other programs.
export mjcf = exports:mjcf: Write a scene that plain MuJoCo can load: scene.xml, its meshes and textures, and a README.
export glb = exports:glb: Write the solids of a scene for programs that show or measure shapes; check that each solid is closed and has the right mass.
export urdf = exports:urdf: Write the arm to a URDF file, with the dimensions of its drawing, and list the joints of the arm.
export lerobot = datasets:lerobot: Write runs as a data set for learned policies, in the format of LeRobot 3, with a data card; needs the extra `lerobot`.
inspect = scripts:inspect: Show what a plan does: stages, steps, times, guards, forces, and what each step depends on.
diff = scripts:diff: Compare what two plans do, step by step.
schema = scripts:schema: Print the JSON schema of the plan format.
trace: Read the traces of runs.
trace show = traces:show: Show what happened in a run, and why.
trace stats = traces:stats: For each stage of a run, count what happened, and show how long the stage took.
trace photograph = traces:photograph: Photograph the cell at a moment of a recorded run, without simulating it again.
trace verify = traces:verify: Repeat a recorded run, and compare the repetition with the recording.
trace thin = exports:thin: Shrink a trace to about a tenth of its size, for sharing; the smaller trace keeps the motion that is needed to show the run.
trace plot = exports:plot: Plot joints, hand force and events of a run against time; needs the extra `plot` (matplotlib).
trace export: Write joints, forces and events of a run as tables.
trace export csv = exports:csv: Write tables of a run as CSV, with a README that describes the columns.
trace export parquet = exports:parquet: Write tables of a run as Parquet, with a README that describes the columns; needs the extra `export` (pyarrow).
world = worlds:world: List every quantity that varies between worlds: its value in this world, unit, spread and source.
render = worlds:render: Render a picture of the work cell.
faults = fault_matrix:faults: Assemble once with each fault of a standard set, at its usual size, and report which faults the program noticed.
trials: Repeat a task in many worlds and count successes.
trials assembly = batches:assembly_trials: Assemble in many worlds, to learn the success rate with its confidence interval, and what failed where.
trials dismantling = batches:dismantling_trials: Assemble in many worlds, make the arm take each pump apart again, and count how often every part is back in place.
trials disturbed = trials:disturbed_trials: Disturb a finished pump without telling the program, then take the pump apart: does a guard stop the arm before the arm does damage?
trials compare = batches:compare_trials: Compare one or more batches of trials with the first batch, world by world, to see how much a sensor, or an error of the world, changes the success rate.
trials base = trials:base_vision_trials: Find the base of the pump on the belt, at many poses: how often it is found, how accurately, and how often in the wrong place.
trials gasket = trials:gasket_vision_trials: Inspect the gasket by camera in four cases: in place, shifted by .3 in, absent, and with a second gasket on top.
trials chaos = trials:chaos_trials: Chaos test: random faults, crashes, interruptions and operator answers; each failure is reduced to one command that repeats it.
trials mutants = mutants:mutant_trials: Make mutants of a program, each with one check taken away or weakened. Does the proof refuse each mutant? If not, does another check catch the faults for which the changed check was meant?
trials record = datasets:record: Record runs in many worlds, for data sets and reports; keep each run and its trace in a folder of its own.
trials rare = rare:rare_trials: Estimate, by subset simulation, how rarely a program stops, and how rarely it fails silently.
trials worst = rare:worst_trials: Find the failing worlds whose errors are smallest, and the quantities that make the program fail.
env: Gymnasium environments of the cell, for learned policies; need the extra `env` (gymnasium).
env list = environments:environments: List the Gymnasium environments: their ids, jobs and time limits.
env evaluate = environments:evaluate: Evaluate a policy: success rate and false-done rate with their confidence intervals, how many steps of the work the policy finished, peak force and time.
bench: Benchmarks: stage times, inserting a pin into a hole, and programs that agents write.
bench timing = benches:timing: Assemble once and print the times of the stages next to those of 1973.
bench agents = agents:bench_agents: Score programs that agents write, in worlds that the agents have not seen; silent failures count twice.
bench insertion = benches:insertion: Insert one pin into one hole, many times, and measure success rate, peak force, and time from first contact until the pin is seated.
"""  # noqa: E501 - a command a line
"""Commands as lines `NAME = MODULE:FUNCTION: SENTENCE`. Lists of commands show the sentence, which is the first
sentence of the command's docstring; a group of commands has no function. The modules are in this folder.
"""


class _Command(CommandSpec):
    def resolve(self, parent_app: App) -> App:
        """Import the command. The docstring of the command is its help. The table `COMMANDS` has one sentence for each
        command. A list of commands shows these sentences, so the list needs no import of the commands.
        """
        self.help = None
        restore_docstring(loaded(self.import_path, "the command at "))
        return super().resolve(parent_app)


def restore_docstring(command: object) -> None:
    """Restore the docstring of a command from its source, because this docstring is the text for --help, and Python
    -OO drops docstrings.
    """
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
    """Add the commands of a table. A command that `app` already has under the same name is not replaced. If `folder`
    is empty, the table must give the full names of modules.
    """
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
