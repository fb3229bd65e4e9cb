"""The site of the documentation in a browser, from the disk: the search, narrow windows, and no network.

`python3 run.py docs` builds the site; without it these checks are skipped.

python3 run.py test browser
"""

from collections.abc import Iterator
from pathlib import Path
from urllib.parse import quote

import pytest
from chromium import Browser, Page

SITE = Path(__file__).parent.parent.parent / "site"
pytestmark = pytest.mark.skipif(not SITE.exists(), reason="`python3 run.py docs` has built no site")
PAGES = (
    "index",
    "start",
    "gallery",
    "checks",
    "figures",
    "python",
    "language/index",
    "notebooks/1_the_first_pump",
)


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    with Browser.started(tmp_path_factory.mktemp("profile")) as browser:
        yield browser


def opened(page: Page, address: str) -> Page:
    page.ask("Page.navigate", url=address)
    page.wait(f"location.href === {address!r} && document.readyState === 'complete'")
    return page


@pytest.mark.parametrize(
    ("words", "place"),
    [
        ("cross-threaded", "faults.html#what-goes-wrong-and-what-notices-it"),
        ("error 23", "language/index.html#errors"),
        ("seed", "worlds.html#what-a-seed-is"),
        ("deadlock", "mal.html#deadlocks"),
        ("referee", "glossary.html#cell-and-world"),
    ],
)
def test_the_search_shows_the_place_that_explains_the_words_first(
    browser: Browser, words: str, place: str
) -> None:
    page = opened(browser.page(SITE / "index.html"), f"{(SITE / 'search.html').as_uri()}?q={quote(words)}")
    found = page.evaluate("[...document.querySelectorAll('#results a')].map((a) => a.getAttribute('href'))")
    assert found[0] == place
    assert page.errors == []


def test_words_that_are_nowhere_are_not_found(browser: Browser) -> None:
    page = opened(browser.page(SITE / "index.html"), f"{(SITE / 'search.html').as_uri()}?q=error%2023x")
    assert page.evaluate("document.getElementById('found').textContent") == "No sections contain “error 23x”."


@pytest.mark.parametrize("width", [1360, 390])
def test_no_page_is_wider_than_the_window_or_asks_the_network(browser: Browser, width: int) -> None:
    page = browser.page(SITE / "index.html", width=width, height=900)
    wide = {
        name: page.evaluate("document.documentElement.scrollWidth")
        for name in PAGES
        if opened(page, (SITE / f"{name}.html").as_uri())
    }
    assert {name: found for name, found in wide.items() if found > width} == {}
    assert [url for url in page.requests if not url.startswith("file:")] == []
    assert page.errors == []
