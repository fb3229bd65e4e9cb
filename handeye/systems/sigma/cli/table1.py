"""The command that reproduces table 1 of the paper."""

from handeye.cli.common import Json, say
from handeye.systems.sigma.cli.studies import put_study


def table1(*, json: Json = False) -> int:
    """Compare the commands, seconds, bus load and idle time of four programs with table 1 of the paper.

    Layer 1 repeats one move. Layer 2 runs our own programs, `plans/table1_*.mal`, which do the work that the names of
    the paper's programs suggest. All motors are perfect.

    Exit code 0: all claims of the paper hold; 1: a claim does not hold; 2: bad input.
    """
    from handeye.systems.sigma.table1 import lines
    from handeye.systems.sigma.table1 import table1 as measured

    found = measured()
    if json:
        failed = [f"{claim.claim}: {claim.found}" for claim in found.claims if not claim.holds]
        message = "; ".join(failed) or "all claims of the paper hold"
        put_study("table1", found, completed=found.holds, message=message)
    else:
        for line in lines(found):
            say(line, whole=True)
    return 0 if found.holds else 1
