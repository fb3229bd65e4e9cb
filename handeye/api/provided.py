"""Files that come with handeye."""

from pathlib import Path
from typing import Final

from handeye.core.resources import demo as demo_folder
from handeye.core.resources import plans

scripts: Final[Path] = plans()
"""Folder of the scripts that come with handeye, with what is taught for them: `handeye.scripts / "water_pump.al"`."""
demo: Final[Path] = demo_folder()
"""Folder of a run that comes with handeye, thinned to a few servo periods a second: `handeye.open(handeye.demo)`."""
