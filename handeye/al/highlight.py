"""The Pygments lexer for arm programs, used by rich, notebooks and the documentation."""

from typing import ClassVar

from pygments.lexer import RegexLexer, bygroups, default, words
from pygments.token import Comment, Error, Keyword, Name, Number, Punctuation, String, Whitespace

from handeye.al.instructions import FREE_TEXT, JUMPS, MODIFIERS, OPERAND_WORDS, OTHERS

_NAME = r"[A-Za-z_]\w*"
_PARAMETER = rf"\{{{_NAME}\}}"


def _ops(ops: list[str]) -> words:
    return words(ops, prefix=r"(?i:", suffix=r")\b")


class ArmLexer(RegexLexer):
    """The lexer of the arm language of 1973. The lexer's words come from the table of instructions."""

    name = "Arm language (WAVE)"
    aliases: ClassVar = ["armal", "wave"]
    filenames: ClassVar = ["*.al"]
    mimetypes: ClassVar = ["text/x-armal"]
    tokens: ClassVar = {
        "root": [
            (r"\s+", Whitespace),
            (r";.*", Comment.Single),
            (rf"({_NAME})([ \t]*)(:)", bygroups(Name.Label, Whitespace, Punctuation)),
            (
                rf"(?i:(DEFINE))\b([ \t]*)({_NAME})?",
                bygroups(Keyword.Declaration, Whitespace, Name.Function),
                "operands",
            ),
            (_ops(FREE_TEXT), Keyword, "free"),
            (_ops(JUMPS), Keyword, "jump"),
            (_ops(MODIFIERS), Keyword.Type, "operands"),
            (_ops(OTHERS), Keyword, "operands"),
            (_NAME, Name.Function, "operands"),
            (r"\S+", Error),
        ],
        "operands": [
            (r"[ \t]+", Whitespace),
            (words(OPERAND_WORDS, prefix=r"(?i:", suffix=r")\b"), Keyword.Pseudo),
            (_NAME, Name.Variable),
            (r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?(?![\w.])", Number.Float),
            (r'"(?=[^"\n]*")', String.Double, "string"),
            (r"[][,]", Punctuation),
            (r";.*", Comment.Single, "#pop"),
            (r"\n", Whitespace, "#pop"),
            (r"\S", Error),
        ],
        "jump": [
            (r"[ \t]+", Whitespace),
            (rf"({_NAME})(?=[ \t]*(?:;|$))", Name.Label, "#pop"),
            (_NAME, Name.Variable),
            (r",", Punctuation),
            default(("#pop", "operands")),
        ],
        "free": [
            (r"[ \t]+", Whitespace),
            (r'"(?=[^"\n]*")', String.Double, ("#pop", "string")),
            (_PARAMETER, String.Interpol),
            (r'[^\s;"{]([^\n;"{]*[^\s;"{])?|\{', String),
            default("#pop"),
        ],
        "string": [
            (_PARAMETER, String.Interpol),
            (r'[^"{]+|\{', String.Double),
            (r'"', String.Double, "#pop"),
        ],
    }
