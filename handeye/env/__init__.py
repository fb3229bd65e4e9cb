"""Gymnasium environments of the work cell. Importing this package registers them.

Each step is a control period of the machine. The observations are the readings of the sensors. "Done" is a part of the
action, by which a policy reports that the work is done; only the referee, at the end of the episode, says whether the
work is right. docs/environments.md describes observations, actions and rewards.
"""

try:
    import gymnasium
except ImportError:
    from handeye.core.errors import MissingExtra

    raise MissingExtra("handeye.env", "gymnasium", "env") from None

from handeye.env.jobs import ids

for _id in ids():
    if _id not in gymnasium.registry:
        gymnasium.register(id=_id, entry_point="handeye.env.environment:AssemblyEnv", kwargs={"job": _id})
