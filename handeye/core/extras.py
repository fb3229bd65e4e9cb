"""Extras: packages that a few commands need, and that are not installed with the rest."""

from handeye.core.errors import Refused


class MissingExtra(Refused):
    """A package of an extra is not installed."""

    def __init__(self, command: str, package: str, extra: str) -> None:
        super().__init__(
            f"`{command}` needs {package}, which is not installed: `pip install {package}` brings it, and so does the "
            f"extra `{extra}` of handeye"
        )
