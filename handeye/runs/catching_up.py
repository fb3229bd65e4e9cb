"""A run brought to where it came before it was broken off, if no checkpoint holds its last steps."""

from collections.abc import Sequence

from handeye.core.errors import Refused
from handeye.program.events import AnyEvent, StepFinished
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint


def done_since(checkpoint: Checkpoint, events: Sequence[AnyEvent]) -> int | None:
    """Steps that a run of which all these events have happened finished after a checkpoint.

    Returns:
        None: the checkpoint is not of that run.
    """
    begun = len(checkpoint.events)
    if tuple(events[:begun]) != checkpoint.events:
        return None
    return sum(isinstance(event, StepFinished) for event in events[begun:])


def caught_up(checkpoint: Checkpoint, events: Sequence[AnyEvent], name: str) -> Checkpoint:
    """The run as it was behind the last step that it finished: what it did since a checkpoint is carried out again.

    Equal runs go the same way to the byte, so that nothing is other than it was.

    Args:
        name: of the run, for messages.

    Raises:
        InvalidInput: it goes another way here, or its cell cannot be built.
    """
    if not done_since(checkpoint, events):
        return checkpoint
    last = max(number for number, event in enumerate(events) if isinstance(event, StepFinished))
    happened = events[: last + 1]
    runner = Runner(checkpoint)
    runner.repeat(happened)
    if runner.events[: len(happened)] != list(happened):
        raise Refused(
            f"what {name} did since its newest checkpoint comes out otherwise here: `handeye resume {name}` goes on "
            "from that checkpoint"
        )
    return runner.checkpoint()
