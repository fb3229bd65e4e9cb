"""The arm language: text to a checked program, and text to tidy text."""

from handeye.al.compiler import compile_text
from handeye.al.extensions import extensions
from handeye.al.formatter import format_text
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.sewing import read_script, sewn, sewn_of

__all__ = [
    "INSTRUCTIONS",
    "compile_text",
    "extensions",
    "format_text",
    "read_script",
    "sewn",
    "sewn_of",
]
