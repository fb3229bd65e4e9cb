"""The job of the environment. This module does not load the physics."""

from typing import Final

from handeye.env.jobs import Job

CHESS: Final = Job(
    id="handeye/Chess-v0",
    meaning="Two chess pieces stand somewhere on three lines. Find them with the light beam, measure and report "
    "their heights, and put each on the line for pieces of its height.",
    task="chess",
    machine="handeye.systems.sigma.episodes.machine:ControlledGantry",
    policies={"program": "handeye.systems.sigma.episodes.policy:ProgramPolicy"},
    limit_s=180.0,
    steps={
        "put the pieces on their lines": ("standing", "on_the_board", "sorted"),
        "report their heights": ("heights",),
    },
)
