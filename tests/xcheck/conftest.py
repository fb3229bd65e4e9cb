"""Cross-checks with tools that are too large for everybody: collected where the tool is installed."""

from importlib.util import find_spec

_TOOLS = {"rerun": "test_rerun.py", "roboticstoolbox": "test_toolbox.py"}
collect_ignore = [test for tool, test in _TOOLS.items() if not find_spec(tool)]
