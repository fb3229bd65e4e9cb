"""The hand-eye system of 1973: plans of motions, and cached camera calibrations."""

from handeye.core.entries import PLANNED, Entry

ENTRY = Entry(
    name=PLANNED,
    title="the system of 1973",
    help="Programs in AL's line, planned for an arm and carried out with hand and eye.",
    system="handeye.systems.stanford.executor_run:PROGRAM",
    can=("plans", "undo", "compare", "faults", "levels", "senses", "video", "chaos", "format", "python"),
    commands="""
cache = handeye.systems.stanford.cache:cache: Show the calibrations of cameras that are kept, or remove them.
""",
)
