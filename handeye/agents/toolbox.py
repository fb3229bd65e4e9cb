"""The tools of an agent, as functions from a request to a reply. These functions know nothing of the protocol."""

from dataclasses import dataclass, field
from typing import Any

import msgspec

from handeye.agents import replies, requests
from handeye.agents.agent_folder import AgentFolder
from handeye.agents.call import Call
from handeye.agents.judging import Verdict, judged, setup_of
from handeye.agents.open_runs import OpenRuns
from handeye.agents.replies import Reply
from handeye.agents.scripts import Scripts, included
from handeye.api.state import Answer
from handeye.api.worlds import World
from handeye.core import resources
from handeye.core.errors import BadArgument, NoSuchName, Refused
from handeye.core.pages import INDEX, page_named
from handeye.core.plain_text import counted
from handeye.editor.explain import explanation, listing
from handeye.program.language import own_languages
from handeye.tasks import DEFAULT


@dataclass(eq=False, slots=True)
class Toolbox:
    """The tools, the folder and the runs of one agent."""

    folder: AgentFolder
    runs: OpenRuns = field(init=False)
    scripts: Scripts = field(init=False)

    def __post_init__(self) -> None:
        self.runs, self.scripts = OpenRuns(self.folder), Scripts(folder=self.folder)

    def close(self) -> None:
        """Close all runs. Runs that have not ended can be resumed."""
        self.runs.close()

    # -- reading ----------------------------------------------------------------------------------------

    def docs(self, asked: requests.Docs, call: Call) -> Reply:
        """Return a page of the documentation, the index of the pages, or an included script."""
        text = included(asked.topic)
        if text is None:
            folder = resources.docs()
            page = page_named(asked.topic, folder) if asked.topic else folder / INDEX
            text = page.read_text(encoding="utf-8")
        return Reply(text=text)

    def explain(self, asked: requests.Explain, call: Call) -> Reply:
        """Explain a code, an error number or an instruction."""
        if not asked.word:
            return Reply(text=listing())
        try:
            return Reply(text=explanation(asked.word))
        except NoSuchName:
            other = (language.explanation(asked.word) for language in own_languages())
            text = next((each for each in other if each is not None), None)
            if text is None:
                raise
            return Reply(text=text)

    def check(self, asked: requests.Check, call: Call) -> Reply:
        """Check a script; nothing moves."""
        source, found = self.scripts.checked(asked.script, asked.taught, asked.task, asked.language)
        return replies.on_script(source.name, found)

    def plan(self, asked: requests.PlanOf, call: Call) -> Reply:
        """Plan a script, and list its stages or the steps of a stage."""
        plan = self.scripts.plan(asked.script, asked.taught, asked.task)
        if asked.stage is not None and asked.stage > len(plan.stages):
            raise NoSuchName(
                f"there is no stage {asked.stage}; the plan has {counted(len(plan.stages), 'stage')}"
            )
        return replies.on_plan(plan, asked.stage)

    def world(self, asked: requests.WorldOf, call: Call) -> Reply:
        """List the quantities of a task, each with its distribution over the worlds."""
        task = asked.task or DEFAULT
        worlds = World(level=asked.level, task=task)
        return replies.on_world(task, [q for q in worlds.quantities if q.name.startswith(asked.group)])

    # -- running ----------------------------------------------------------------------------------------

    def run(self, asked: requests.Advance, call: Call) -> Reply:
        """Begin a run, or continue a run, up to a given place or to the end."""
        if asked.until and asked.steps is not None:
            raise BadArgument("give `until` or `steps`, not both")
        if asked.script is None:
            _check_alone(asked)
            name, run = self.runs.find(asked.run, call)
        elif asked.answer is not None:
            raise BadArgument(
                "`answer` is for a run that has called the operator; a new run has not called the operator"
            )
        else:
            plan = self.scripts.plan(asked.script, asked.taught, asked.task)
            world = World(
                asked.seed,
                level=asked.level,
                without=asked.without,
                set=asked.set,
                faults=asked.faults,
                task=plan.record.task,
            )
            name, run = self.runs.begin(asked.run, plan, world, call)
        if asked.answer is not None:
            _done(run.say(asked.answer))
        if asked.steps == 0:
            return replies.on_run(name, run, _done(run.say("list")))
        line = f"until {asked.until}" if asked.until else f"step {asked.steps}" if asked.steps else "continue"
        return replies.on_run(name, run, _done(run.say(line)))

    def state(self, asked: requests.StateOf, call: Call) -> Reply:
        """Show the state of a run, as the program's own sensors measured it."""
        name, run = self.runs.find(asked.run, call)
        return replies.on_run(name, run, _done(run.say(f"show {asked.show}")))

    def picture(self, asked: requests.PictureOf, call: Call) -> Reply:
        """Return the last picture that the program took."""
        name, run = self.runs.find(asked.run, call)
        png = run.picture_png
        if png is None:
            raise Refused(f"the program of the run {name} has taken no picture yet")
        return Reply(text=f"the last picture of the run {name}, with what the program found in it", png=png)

    def back(self, asked: requests.Back, call: Call) -> Reply:
        """Restore an earlier state of a run."""
        name, run = self.runs.find(asked.run, call)
        run.back(asked.stage or asked.steps)
        return replies.on_run(name, run, _done(run.say("list")))

    def fork(self, asked: requests.Fork, call: Call) -> Reply:
        """Begin a new run from the state of an existing run."""
        name, run = self.runs.fork(asked.run, asked.stage, asked.to, call)
        return replies.on_run(name, run, _done(run.say("list")))

    # -- judging ----------------------------------------------------------------------------------------

    def result(self, asked: requests.ResultOf, call: Call) -> Reply:
        """Return the referee's verdict on a run that has ended."""
        name, result = self.runs.result(asked.run)
        if result.paused:
            raise Refused(
                f"the run {name} has not ended, so the referee has not judged it; `run` continues it"
            )
        return replies.on_result(name, result)

    def submit(self, asked: requests.Submit, call: Call) -> Reply:
        """Run a program in several worlds, and let the referee judge each run."""
        plan = self.scripts.plan(asked.script, asked.taught, asked.task)
        seeds = range(asked.seed, asked.seed + asked.worlds)
        found: list[Verdict] = []
        for seed in seeds:
            call.report(len(found), asked.worlds, f"world {len(found) + 1} of {asked.worlds}")
            world = World(seed, level=asked.level, task=plan.record.task)
            found.append(judged(setup_of(plan, world.spec), call))
        tally = {word: sum(each.outcome == word for each in found) for word in replies.OUTCOMES}
        lines = [
            ", ".join(f"{number} {word}" for word, number in tally.items())
            + f" of {counted(len(found), 'world')}"
        ]
        lines += [f"seed {each.seed}: {each.told}" for each in found]
        rows = [msgspec.to_builtins(each) for each in found]
        for row in rows:
            del row["steps"]
        data: dict[str, Any] = {**tally, "worlds": rows}
        return Reply(text="\n".join(lines), data=data)


def _done(answer: Answer) -> Answer:
    """Return the answer of the stepper. If the stepper refused the command, raises Refused with the reason that the
    stepper gave.
    """
    if answer.error is not None:
        raise Refused(answer.error)
    return answer


def _check_alone(asked: requests.Advance) -> None:
    """Raise BadArgument if a call that continues a run has arguments that only a new run can have."""
    new = requests.Advance()
    for name in ("taught", "task", "seed", "level", "set", "without", "faults"):
        if getattr(asked, name) != getattr(new, name):
            raise BadArgument(f"`{name}` is for a new run; give its `script` too, or leave `{name}` out")
