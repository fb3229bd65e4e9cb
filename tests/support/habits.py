"""Habits of translated prose, which this project avoids, and functions that find them in a text."""

import ast
import io
import re
import tokenize
from collections.abc import Iterator

WORK = "(?:run|script|program|sweep|batch|trial|test|line|statement|instruction)s?"
HABITS = {
    "so many": r"so many\b(?! \w+ that)",
    "so much more": r"so much (?:more|less|larger|smaller|\w+er)\b",
    "somebody, nobody": r"(?:some|no|any|every)body\b",
    "is told": r"(?:is|are|was|were|be|been|being) (?:\w+ )?told\b|told apart\b",
    "tells of": r"tells? of\b",
    "comes to": r"(?:come|comes|came|coming) to (?!rest\b)",
    "comes along": r"(?:come|comes|came|coming) along\b",
    "otherwise, for differently": r"(?<![.;:,(] )(?<!\band )(?<!\bor )(?<!\bunless )(?<!\bwould )"
    r"(?<!\bNone )(?<!Input )(?-i:otherwise)\b",
    "a thing": r"(?<!same )thing\b",
    "ways part": r"ways part\b",
    "looks on": r"look(?:s|ed|ing)? on\b(?! (?:the|a|an)\b)",
    "as it was drawn": r"as (?:it|they) (?:is|are|was|were) drawn\b",
    "goes by": r"(?:go|goes|went|gone|going) by\b",
    "people are": r"people (?:are|see|do|did|give|read|choose|copy|draw)\b|people's\b|for people\b(?! who)",
    "hands on": r"hands on\b|handed on\b|to hand on\b",
    "stands beside, stands in": r"st(?:and|ands|ood) beside\b"
    r"|st(?:and|ands|ood) in (?:a|an|the|this|its|one) (?:text|file|table|list|page|script|trace)\b",
    "is known of": r"(?:is|are|was|were) known of\b",
    "at that, after a comma": r"at that(?=[.,;:)])",
    "anew": r"anew\b(?!:)",
    "but for": r"but for\b",
    "whoever": r"whoever\b",
    "Who presses it": r"(?<!\w )(?-i:Who [a-z]+s)\b(?![^.]*\?)",
    "carries out a run": rf"carr(?:y|ies|ied|ying) out (?:(?:a|the|each|every|one|its|another) )?{WORK}\b"
    rf"|{WORK} (?:is|are|was|were|be) (?:\w+ )?carried out\b",
    "seconds of the host": r"seconds of the host\b",
    "is lacking": r"(?:is|are|was|were) lacking\b",
    "is not there": r"(?:is|are|was|were) not there\b",
}
"""The patterns of the habits, by name. CONTRIBUTING.md says what to write instead."""

PATTERNS = {name: re.compile(rf"(?<![\w-])(?:{habit})", re.IGNORECASE) for name, habit in HABITS.items()}
ANY = re.compile("|".join(f"(?:{pattern.pattern})" for pattern in PATTERNS.values()), re.IGNORECASE)
CODE = re.compile(r"`[^`\n]*`|\{[^{}]*\}|\b[A-Z]{2,}\b|https?://\S+|\]\([^)]*\)")
FENCE = re.compile(r"^ *```+ *(\w*).*?^ *```+ *$", re.MULTILINE | re.DOTALL)
PERIOD = ("al", "trig", "asm", "period")
"""Fenced blocks that are not searched: listings, whose comments may be of 1973."""


def habits(text: str) -> Iterator[str]:
    """The habits in a text, without its code, its capitals (messages of 1973 are in capitals) and its quotations."""
    flat = " ".join(CODE.sub(lambda code: "" if code[0].startswith("](") else "_", text).split())
    if ANY.search(flat):
        yield from (
            f"{name}: …{flat[max(0, found.start() - 40) : found.end() + 30]}…"
            for name, pattern in PATTERNS.items()
            for found in pattern.finditer(flat)
        )


def prose_of_python(source: str) -> Iterator[tuple[int, str]]:
    """Yield the prose in a Python source, by line: texts, docstrings, and comments. Comments on successive lines are
    joined.
    """
    inside: set[ast.AST] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.JoinedStr):
            inside.update(child for child in ast.walk(node) if child is not node)
            if node not in inside:
                parts = [str(part.value) if isinstance(part, ast.Constant) else "_" for part in node.values]
                yield node.lineno, "".join(parts)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in inside:
            yield node.lineno, node.value
    begun, last, words = 0, 0, ""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            line = token.start[0]
            if line != last + 1:
                yield begun, words
                begun, words = line, ""
            last, words = line, f"{words} {token.string.lstrip('#: ')}"
    yield begun, words


def prose_of_page(source: str) -> Iterator[tuple[int, str]]:
    """The paragraphs of a Markdown page, by line, without its quotations and its listings."""
    shown = FENCE.sub(
        lambda block: "\n" * block[0].count("\n") if block[1].lower() in PERIOD else block[0], source
    )
    line = 1
    for paragraph in re.split(r"(\n\s*\n)", shown):
        yield line, "\n".join(row for row in paragraph.splitlines() if not row.lstrip().startswith(">"))
        line += paragraph.count("\n")
