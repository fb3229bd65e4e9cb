"""Who is let through: nobody without the token, under another name, or from another page."""

import pytest

from handeye.view.access import Access

ACCESS = Access(8080, "secret")
HOST, ORIGIN = ["127.0.0.1:8080"], ["http://127.0.0.1:8080"]


def status(target: str, hosts: list[str] = HOST, origins: list[str] = ORIGIN) -> int | None:
    refusal = ACCESS.refusal(target, hosts, origins)
    return None if refusal is None else refusal.status.value


@pytest.mark.parametrize("target", ["/?token=secret", "/live?token=secret"])
@pytest.mark.parametrize("name", ["127.0.0.1", "localhost"])
def test_the_page_and_its_socket_are_let_through_with_the_token(target: str, name: str) -> None:
    assert status(target, [f"{name}:8080"], [f"http://{name}:8080"]) is None


def test_a_page_may_come_without_an_origin_and_a_socket_may_not() -> None:
    assert (status("/?token=secret", origins=[]), status("/live?token=secret", origins=[])) == (None, 403)


@pytest.mark.parametrize(
    "target",
    [
        "/", "/?token=", "/?token=Secret", "/?token=secre", "/?token=secret2", "/?token=secret&token=secret", "/live",
        "/?token=%FF%FE", "/?" + "a=1&" * 5000 + "token=secret", "/live?Token=secret",
    ],
)  # fmt: skip
def test_without_the_token_nothing_is_let_through(target: str) -> None:
    assert status(target) == 403


@pytest.mark.parametrize(
    "hosts",
    [
        [],
        ["evil.example"],
        ["evil.example:8080"],
        ["127.0.0.1"],
        ["127.0.0.1:80"],
        HOST * 2,
        [*HOST, "evil.example"],
    ],
)
def test_under_another_name_nothing_is_let_through(hosts: list[str]) -> None:
    assert status("/live?token=secret", hosts) == 403


@pytest.mark.parametrize(
    "origins",
    [
        ["null"],
        ["http://evil.example"],
        ["https://127.0.0.1:8080"],
        ["http://127.0.0.1"],
        ORIGIN * 2,
        ["file://"],
    ],
)
def test_from_another_page_nothing_is_let_through(origins: list[str]) -> None:
    assert (status("/live?token=secret", origins=origins), status("/?token=secret", origins=origins)) == (
        403,
        403,
    )


@pytest.mark.parametrize(
    "path", ["/etc/passwd", "/../../etc/passwd", "/live/..", "/%2e%2e/", "//evil.example/", "*"]
)
def test_there_is_nothing_but_the_page_and_its_socket(path: str) -> None:
    assert status(f"{path}?token=secret") == 404


def test_a_token_is_drawn_anew_and_long() -> None:
    one, other = Access(1), Access(1)
    assert one.token != other.token
    assert len(one.token) >= 32
    assert one.address == f"http://127.0.0.1:1/?token={one.token}"
