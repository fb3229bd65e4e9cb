"""Cross-checks with tools that are too large for everybody: collected where the tool is installed."""

from importlib.util import find_spec

collect_ignore = [] if find_spec("rerun") else ["test_rerun.py"]
