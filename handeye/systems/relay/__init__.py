"""The relay: programs in the languages of several systems do the stages of one task in turn, with the same arm."""

from handeye.core.entries import Entry

ENTRY = Entry(
    name="relay",
    title="the relay",
    help="Assemble one pump with programs of several systems, which take turns on the same arm.",
    system="handeye.systems.relay.system:RELAY",
    can=("undo", "faults", "levels", "video"),
    reasons={
        "plans": "`handeye relay run FILE.relay` runs its programs",
        "leg": "the legs of a relay must be programs of other systems",
    },
    commands="""
relay = handeye.systems.relay.cli.commands:relay: Assemble one pump with programs of several systems, which take turns on the same arm.
trials relay = handeye.systems.relay.cli.commands:relay_trials: Run a relay in many worlds: success rate, and time and force of each leg.
trials stages = handeye.systems.relay.cli.stages:stages: Do stages of the pump in several languages, from the same state in each world.
""",  # noqa: E501 - a command a line
    sweeps={
        "relay": "handeye.systems.relay.trials:RELAYS",
        "stages": "handeye.systems.relay.stages.trials:STAGES",
    },
    languages={".relay": "handeye.systems.relay.language:LANGUAGE"},
    events="handeye.systems.relay.happenings:EVENTS",
)
