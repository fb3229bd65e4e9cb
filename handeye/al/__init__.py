"""The arm language: compiles a script to a checked program, and formats a script."""

from handeye.al.compiler import LANGUAGE, compile_text
from handeye.al.extensions import extensions
from handeye.al.formatter import format_text
from handeye.al.includes import read_script, sewn, sewn_of
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.planning_messages import planning_diagnostics
from handeye.program.language import Language

AL = Language(name=LANGUAGE, read=read_script, compile=compile_text, phrase=planning_diagnostics)

__all__ = [
    "AL",
    "INSTRUCTIONS",
    "compile_text",
    "extensions",
    "format_text",
    "read_script",
    "sewn",
    "sewn_of",
]
