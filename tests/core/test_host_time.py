"""Seconds of this computer: from when handeye was loaded, whatever the process was before."""

import os
import subprocess
import sys
import time

import pytest

from handeye.core.host_time import HostTimer

TOLD = "from handeye.core.host_time import HostTimer as H; t = H.of_command(); print(t.wall_s, t.cpu_s)"
BEFORE_S = 0.2


def test_the_time_of_a_command_counts_from_its_import() -> None:
    timer, before = HostTimer.of_command(), HostTimer()
    assert timer.wall_s > before.wall_s
    assert timer.cpu_s > before.cpu_s


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="no process becomes another program there")
def test_what_a_process_did_before_it_became_handeye_is_not_counted() -> None:
    work = f"import os, sys, time\nwhile time.process_time() < {BEFORE_S}: pass\n"
    busy = f"{work}os.execv(sys.executable, [sys.executable, '-c', {TOLD!r}])"
    began = time.monotonic()
    told = subprocess.run([sys.executable, "-c", busy], capture_output=True, text=True, check=True).stdout
    wall, cpu = map(float, told.split())
    assert time.monotonic() - began > BEFORE_S
    assert max(wall, cpu) < BEFORE_S / 2
