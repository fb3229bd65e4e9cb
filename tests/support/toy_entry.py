"""Entry of the counter machine: a system that is no part of handeye."""

from handeye.core.entries import Entry

ENTRY = Entry(
    name="toy",
    title="the counter machine",
    help="Counts.",
    system="toy_system:TOY",
    events="toy_events:EVENTS",
    reasons={"undo": "what is counted is counted"},
    tasks={"counting": "toy_task:COUNTING"},
    languages={".toy": "toy_language:LANGUAGE"},
    commands="""
toy = toy_commands:toy: Count with registers, in one task or several.
trials counting = toy_trials:counting_trials: Count with many seeds.
""",
    sweeps={"counting": "toy_trials:COUNTING"},
)
