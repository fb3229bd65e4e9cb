"""The JSON output of SUPERSIGMA's studies. No referee judges these studies."""

from handeye.cli.common import put_json


def put_study(
    task: str,
    figures: object,
    *,
    completed: bool,
    message: str,
    seed: int | None = None,
    stopped_at: str | None = None,
) -> None:
    """Print the result of a study as JSON with the fields of `assemble --json`; `figures` contains the study's own
    results.
    """
    put_json(
        {
            "assembled": None,
            "completed": completed,
            "stopped_at": stopped_at,
            "message": message,
            "referee": {},
            "task": task,
            "seed": seed,
            "figures": figures,
        }
    )
