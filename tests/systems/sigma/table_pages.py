"""The maker of the tables on the pages about SUPERSIGMA, for tests."""

from importlib.util import module_from_spec, spec_from_file_location
from types import ModuleType

from mal_bench import ROOT


def maker() -> ModuleType:
    """The program that makes the tables."""
    spec = spec_from_file_location("make_sigma_tables", ROOT / "docs/make_sigma_tables.py")
    assert spec is not None
    assert spec.loader is not None
    made = module_from_spec(spec)
    spec.loader.exec_module(made)
    return made
