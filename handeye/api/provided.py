"""Files included with handeye."""

from pathlib import Path
from typing import Final

from handeye.core.resources import demo as demo_folder
from handeye.core.resources import plans

scripts: Final[Path] = plans()
"""Folder of the included scripts and their taught files, for example `handeye.scripts / "water_pump.al"`."""
demo: Final[Path] = demo_folder()
"""Folder of a recorded run that is included with handeye: `handeye.open(handeye.demo)`. The trace of this run holds
only a few servo periods of each second.
"""
