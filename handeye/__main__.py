"""Entry point of the commands `handeye` and `python -m handeye`."""

import os
import signal

ALLOCATIONS = 100_000
"""Object allocations between two garbage collections. With Python's default of 700, collections take a tenth of the
time of a short command.
"""


def main() -> None:
    """Run the command line. Ctrl-C ends the program even while modules are being imported, and is ignored once the
    command has finished.
    """
    _hear(signal.SIGINT)  # before anything is imported
    import atexit
    import gc

    from handeye.core.signals import ENDING

    for number in ENDING:
        if _hear(number):
            atexit.register(signal.signal, number, signal.SIG_IGN)
    # without this, importing MuJoCo would load an OpenGL library; `cell.opengl` chooses the library instead
    os.environ["MUJOCO_GL"] = "disable"
    gc.set_threshold(ALLOCATIONS)
    import handeye.core.host_time  # noqa: F401 - a command's time counts from here
    from handeye.cli import main as run

    run()


def _hear(number: int) -> bool:
    """Make a signal end the program immediately. Returns False if the signal is ignored, as after `nohup`."""
    if signal.getsignal(number) == signal.SIG_IGN:
        return False
    signal.signal(number, lambda *_: os._exit(130))
    return True


if __name__ == "__main__":
    main()
