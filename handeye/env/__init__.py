"""Gymnasium environments of the work cell. Importing this package registers them.

An environment runs at the servo's 60 Hz. The observations are the readings of the sensors, and "done" is a part of the
action: only the referee, at the end of the episode, says whether the work is right. docs/environments.md describes
observations, actions and rewards.
"""

try:
    import gymnasium
except ImportError:
    from handeye.core.errors import MissingExtra

    raise MissingExtra("handeye.env", "gymnasium", "env") from None

from handeye.env.jobs import JOBS

for _job in JOBS:
    if _job.id not in gymnasium.registry:
        gymnasium.register(
            id=_job.id, entry_point="handeye.env.environment:AssemblyEnv", kwargs={"job": _job.id}
        )
