"""Small pieces of text for people: what may be shown on a terminal, and counts with their nouns."""


def printable(text: str) -> str:
    """A text with a sign in the place of each character that would steer a terminal, and not be shown."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text)


def one_line(text: str) -> str:
    """A statement without the blanks that put it in columns, printable throughout."""
    return printable(" ".join(text.split()))


def counted(number: int, noun: str) -> str:
    """`1 step`, `2 steps`"""
    return f"{number} {noun}{'' if number == 1 else 's'}"
