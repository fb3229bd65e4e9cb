"""Cross-checks with tools that are too large for everybody: collected where the tool is installed."""

from importlib.util import find_spec

_TOOLS = {
    "test_dask.py": ("distributed",),
    "test_rerun.py": ("rerun",),
    "test_toolbox.py": ("roboticstoolbox",),
    "test_parquet.py": ("pyarrow", "pandas", "duckdb"),
}
collect_ignore = [test for test, tools in _TOOLS.items() if not all(map(find_spec, tools))]
