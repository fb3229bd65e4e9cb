"""Identifies the kind of processor, which determines how the last digits of results are rounded."""

import ctypes
import os
import platform
import re
from functools import cache
from pathlib import Path
from typing import Final

_SETTINGS: Final = ("GLIBC_TUNABLES", "OPENBLAS_CORETYPE", "NPY_DISABLE_CPU_FEATURES")
"""Environment variables that influence the choice of processor instructions."""


@cache
def processor() -> str:
    """Describe the processor: architecture, model, linear-algebra kernels, and settings that influence the choice
    of instructions.
    """
    told = [f"{platform.machine()} {_model()}".strip(), _kernels()]
    told += [f"{name}={value}" for name in _SETTINGS if (value := os.environ.get(name))]
    return ", ".join(filter(None, told))


def _model() -> str:
    """Return the model name that the processor reports, or "" if the processor reports no name."""
    try:
        found = re.search(
            r"^model name\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(errors="replace"), re.MULTILINE
        )
    except OSError:
        return platform.processor()
    return " ".join(found[1].split()) if found else platform.processor()


def _kernels() -> str:
    """Return the name of the kernels that NumPy's OpenBLAS has selected, or "" if this name is unknown."""
    import numpy

    for file in (Path(numpy.__file__).parents[1] / "numpy.libs").glob("*openblas*"):
        try:
            ask = ctypes.CDLL(str(file)).scipy_openblas_get_corename64_
        except (OSError, AttributeError):
            continue
        ask.restype = ctypes.c_char_p
        return f"OpenBLAS for {(ask() or b'').decode(errors='replace')}"
    return ""
