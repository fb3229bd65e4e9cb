"""Check the built site: every link leads somewhere, and nothing is loaded from elsewhere."""

import os
import re
from collections.abc import Iterator, Mapping
from pathlib import PurePosixPath
from typing import Final
from urllib.parse import unquote

from docs.website.built import Page

ELSEWHERE: Final = re.compile(r"[a-z]+:|//")
MUST_FIND: Final = ("cross-threaded", "error 23", "seed", "deadlock")
"""Words that readers search for, and that the search must find."""


def faults(pages: Mapping[str, Page], files: set[str]) -> Iterator[str]:
    """A sentence for each fault of the site.

    Args:
        pages: Pages of the site by path.
        files: Paths of all files of the site.
    """
    for path, page in pages.items():
        for link in [*page.links, *page.loaded]:
            if not ELSEWHERE.match(link) and not leads_somewhere(link, path, pages, files):
                yield f"{path}: the link {link} leads nowhere"
        for link in page.loaded:
            if ELSEWHERE.match(link) and not link.startswith("data:"):
                yield f"{path}: the page loads {link} from elsewhere"
    texts = [section.text.lower() for page in pages.values() for section in page.sections]
    for words in MUST_FIND:
        if not any(words in text for text in texts):
            yield f"the search does not find {words}"


def leads_somewhere(link: str, path: str, pages: Mapping[str, Page], files: set[str]) -> bool:
    place, _, anchor = unquote(link).partition("#")
    place = place.partition("?")[0]
    to = os.path.normpath(PurePosixPath(path).parent / place).replace(os.sep, "/") if place else path
    if to not in files:
        return False
    return not anchor or to not in pages or anchor in pages[to].anchors
