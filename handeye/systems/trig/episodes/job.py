"""The job of the environment. This module does not load the physics."""

from typing import Final

from handeye.env.jobs import Job

BLOCKS: Final = Job(
    id="handeye/Blocks-v0",
    meaning="Five blocks stand in a stack. Put each on its place on the pallet, and then go to the place DONE.",
    task="palletise",
    machine="handeye.systems.trig.episodes.machine:ControlledPurbrick",
    policies={"program": "handeye.systems.trig.episodes.policy:TaughtPolicy"},
    limit_s=300.0,
    steps={
        "put the blocks on the pallet": ("placed", "on_the_pallet", "flat"),
        "go to the last place": ("hand",),
    },
)
