"""The task's own program as a policy: the executor of programs, acting only through the action space."""

from handeye.cell.compiled_arm import CompiledArm
from handeye.core.mutable_records import copied
from handeye.env.policies import Episode, Facts, Policy
from handeye.env.seen_cell import seen_cell
from handeye.env.spaces import ActionKind
from handeye.env.starts import own_plan
from handeye.execution.context import ExecutionContext
from handeye.execution.executor import Executor


class ProgramPolicy(Policy):
    """Continues the program from the state in which the episode starts, with what the program remembers there.

    It says done when the program has come to its end. When the program calls the operator, the policy sets the brakes
    and waits for the time limit.
    """

    actions: tuple[ActionKind, ...] = ("torques",)

    def __init__(self, facts: Facts) -> None:
        self._facts = facts

    def play(self, episode: Episode) -> None:
        cell, clock = seen_cell(episode)
        plan = own_plan(self._facts.task)
        context = ExecutionContext(
            plan=plan,
            arm=self._facts.arm,
            cell=cell,
            camera=None,
            emit=lambda _: None,
            arithmetic=CompiledArm,
        )
        context.restore(copied(self._facts.memory))
        executor = Executor(run=context)
        while context.state.at is not None:
            executor.step()
        if executor.finish():
            clock.done()
