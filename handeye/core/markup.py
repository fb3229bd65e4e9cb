"""Markup for pages; plain text is escaped."""

from html import escape


class Markup(str):
    """Escaped markup; a plain `str` is text."""

    __slots__ = ()


Content = str | float | None


def markup(content: Content) -> Markup:
    """Content as markup, escaped if it is text."""
    return content if isinstance(content, Markup) else Markup(escape("" if content is None else str(content)))
