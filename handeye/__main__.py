"""The way in: `handeye`, and `python -m handeye`."""

import gc
import os
import signal
from typing import Final, NoReturn

ALLOCATIONS: Final = 100_000
"""Objects between two collections of garbage: with Python's 700, they take a tenth of the time of a short command."""


def main() -> NoReturn:
    """Run the command line; Ctrl-C ends it even while it is still being imported."""
    # MuJoCo, as it is imported, would load the OpenGL named here, or try windows; `cell.opengl` looks for its own
    os.environ["MUJOCO_GL"] = "disable"
    gc.set_threshold(ALLOCATIONS)
    heard = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if heard:  # not raised: modules written in C make an ImportError of it
        signal.signal(signal.SIGINT, lambda *_: os._exit(130))
    import handeye.core.host_time  # noqa: F401 - a command's time counts from here
    from handeye.cli import main as run

    if heard:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    run()


if __name__ == "__main__":
    main()
