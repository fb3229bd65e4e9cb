"""The task's own program as a policy: the executor of programs, acting only through the action space."""

from handeye.cell.compiled_arm import CompiledArm
from handeye.core.mutable_records import copied
from handeye.env.jobs import PLANNED, job_named
from handeye.env.policies import ArmFacts, Episode, Policy
from handeye.env.seen_cell import seen_cell
from handeye.env.spaces import ActionKind
from handeye.execution.context import ExecutionContext
from handeye.execution.executor import Executor
from handeye.runs.starts import own_plan
from handeye.tasks import task
from handeye.vision.camera_model import CameraModel


def _camera(facts: ArmFacts) -> CameraModel | None:
    """Return the calibrated camera; or, if the program has not calibrated the camera, the camera of the drawing.
    Returns None if there is no camera.
    """
    if facts.memory.calibration is not None:
        return facts.memory.calibration.model
    eye = task(facts.task).eye
    return None if eye is None else eye.drawing


class ProgramPolicy(Policy):
    """Continues the program from the state in which the episode starts. The program remembers what it has measured
    before this state.

    When the program has completed the stages of the job, the policy reports that the work is done. When the program
    calls the operator, the policy sets the brakes and waits for the time limit.
    """

    facts: ArmFacts
    actions: tuple[ActionKind, ...] = ("torques",)
    environments = tuple(job.id for job in PLANNED)
    pictures = True

    def play(self, episode: Episode) -> None:
        cell, clock = seen_cell(episode)
        plan = own_plan(self.facts.task)
        context = ExecutionContext(
            plan=plan,
            arm=self.facts.arm,
            cell=cell,
            camera=_camera(self.facts),
            emit=lambda _: None,
            arithmetic=CompiledArm,
        )
        context.restore(copied(self.facts.memory))
        executor = Executor(run=context)
        until = job_named(self.facts.environment).until
        while context.state.at is not None:
            if context.state.stage is None and plan.program.steps[context.state.at].stage == until:
                clock.done()
            executor.step()
        if executor.finish():
            clock.done()
