"""Controls access to the server. A request must use the server's name, come from the server's page, and have
the token of the printed address.
"""

import hmac
import secrets
from collections.abc import Sequence
from dataclasses import dataclass, field
from http import HTTPStatus
from typing import Final
from urllib.parse import parse_qs

HOST: Final = "127.0.0.1"  # the only interface that the server listens on
PAGE: Final = "/"
LIVE: Final = "/live"
NOTHING: Final = "no such page"
_NAMES: Final = (HOST, "localhost")


@dataclass(frozen=True, slots=True)
class Refusal:
    """The reason why a request is refused."""

    status: HTTPStatus
    sentence: str


@dataclass(frozen=True, slots=True)
class Access:
    """The conditions that a request must meet."""

    port: int
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24))

    @property
    def address(self) -> str:
        """The address to open in a browser, with the token."""
        return f"http://{HOST}:{self.port}{PAGE}?token={self.token}"

    def refusal(self, target: str, hosts: Sequence[str], origins: Sequence[str]) -> Refusal | None:
        """Return the reason why a request is refused, or None if it is permitted. `target` is the path and
        query of the request; `hosts` and `origins` are its `Host` and `Origin` headers.

        A browser sends the origin when a page opens a socket, and usually sends none when a person opens a
        page.
        """
        path, _, query = target.partition("?")
        own = [f"{name}:{self.port}" for name in _NAMES]
        if [*hosts] not in ([host] for host in own):
            wrong = "this server does not answer to that host name; open the address that handeye printed"
            return Refusal(HTTPStatus.FORBIDDEN, wrong)
        if [*origins] not in ([f"http://{host}"] for host in own) and (origins or path == LIVE):
            return Refusal(HTTPStatus.FORBIDDEN, "this server refuses requests from other web pages")
        if not self._has_token(query):
            wrong = "the token is missing or wrong: open the address that handeye printed"
            return Refusal(HTTPStatus.FORBIDDEN, wrong)
        if path not in (PAGE, LIVE):
            return Refusal(HTTPStatus.NOT_FOUND, NOTHING)
        return None

    def _has_token(self, query: str) -> bool:
        given = parse_qs(query, max_num_fields=8).get("token", []) if query.count("&") < 8 else []
        return len(given) == 1 and hmac.compare_digest(given[0].encode(errors="replace"), self.token.encode())
