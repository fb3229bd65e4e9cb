"""Markup for pages. A plain text is data: the one function here that makes markup of it escapes it."""

from html import escape


class Markup(str):
    """Markup that is ready for a page; a plain `str` is text, and is escaped."""

    __slots__ = ()


Content = str | float | None
"""Text, a number, or nothing."""


def markup(content: Content) -> Markup:
    """Content as markup."""
    return content if isinstance(content, Markup) else Markup(escape("" if content is None else str(content)))
