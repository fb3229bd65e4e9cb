"""The arm language: text to a checked program, and text to tidy text."""

from handeye.al.compiler import compile_text
from handeye.al.extensions import extensions
from handeye.al.formatter import format_text
from handeye.al.includes import read_script, sewn, sewn_of
from handeye.al.instructions import INSTRUCTIONS

__all__ = [
    "INSTRUCTIONS",
    "compile_text",
    "extensions",
    "format_text",
    "read_script",
    "sewn",
    "sewn_of",
]
