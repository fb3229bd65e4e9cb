"""The kind of processor that a result was computed on: what decides how numbers are rounded in their last places."""

import ctypes
import os
import platform
import re
from functools import cache
from pathlib import Path
from typing import Final

_SETTINGS: Final = ("GLIBC_TUNABLES", "OPENBLAS_CORETYPE", "NPY_DISABLE_CPU_FEATURES")
"""Environment variables that choose instructions by themselves."""


@cache
def processor() -> str:
    """Architecture, model, kernels of the linear algebra, and settings that choose instructions."""
    told = [f"{platform.machine()} {_model()}".strip(), _kernels()]
    told += [f"{name}={value}" for name in _SETTINGS if (value := os.environ.get(name))]
    return ", ".join(filter(None, told))


def _model() -> str:
    """The name that the processor gives of itself, or ""."""
    try:
        found = re.search(
            r"^model name\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(errors="replace"), re.MULTILINE
        )
    except OSError:
        return platform.processor()
    return " ".join(found[1].split()) if found else platform.processor()


def _kernels() -> str:
    """The kernels that NumPy's OpenBLAS has chosen, or ""."""
    import numpy

    for file in (Path(numpy.__file__).parents[1] / "numpy.libs").glob("*openblas*"):
        try:
            ask = ctypes.CDLL(str(file)).scipy_openblas_get_corename64_
        except (OSError, AttributeError):
            continue
        ask.restype = ctypes.c_char_p
        return f"OpenBLAS for {(ask() or b'').decode(errors='replace')}"
    return ""
