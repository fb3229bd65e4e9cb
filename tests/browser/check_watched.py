"""A run with twenty viewers, for more than a minute, has the same trace as a run without viewers, byte for byte.

Not collected with the tests, for it takes two minutes: `python3 run.py test browser`.
"""

import json
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from handeye.core import resources

VIEWERS = 20
LEAST = 60.0
"""s of this computer's clock for which they look on."""
PACE = ".5x"
"""Of the run, whose working phase takes 41 s by the clock of the cell."""


def handeye(*words: str) -> list[str]:
    """A command line."""
    return [sys.executable, "-m", "handeye", *words]


def viewer(address: str) -> connect:
    """A viewer; the first has control."""
    origin, token = address.split("/?")
    target = f"{origin.replace('http', 'ws')}/live?{token}"
    return connect(target, origin=origin, proxy=None, open_timeout=60)


def watch(address: str, number: int) -> int:
    """Look on until the run has been left; the moments seen. Some of those who look on are a nuisance."""
    seen = 0
    with suppress(ConnectionClosed), viewer(address) as connection:
        for message in connection:
            seen += isinstance(message, bytes)
            if number == 2 and isinstance(message, bytes):
                connection.send("rubbish")
            if number == 3 and seen == 50:
                connection.send("x" * 10_000_000)
            if number == 4 and isinstance(message, bytes):
                connection.send(json.dumps({"do": "say", "line": "back"}))
            if number == 5 and seen == 50:
                break
    return seen


def steered(address: str, *lines: str) -> float:
    """Say lines, and wait for the end of the program; s that the run went by this computer's clock."""
    with viewer(address) as driver, ThreadPoolExecutor(VIEWERS) as pool:
        watching = [pool.submit(watch, address, number) for number in range(1, VIEWERS)]
        begun = time.monotonic()
        for line in lines:
            driver.send(json.dumps({"do": "say", "line": line}))
        while "the program has ended" not in str(driver.recv()):
            pass
        went = time.monotonic() - begun
        driver.send(json.dumps({"do": "say", "line": "quit"}))
        assert min(each.result() for each in watching) >= 50
    return went


def test_the_trace_of_a_run_watched_for_a_minute_is_the_same_to_the_byte(tmp_path: Path) -> None:
    plan = str(tmp_path / "live.plan.json")
    subprocess.run(handeye("plan", str(resources.demo() / "live.al"), "-o", plan), check=True)
    subprocess.run(handeye("run", plan, "--out", str(tmp_path / "alone")), check=True)
    line = handeye("view", plan, "--out", str(tmp_path / "watched"))
    with subprocess.Popen(line, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            went = steered(process.stdout.readline().strip(), f"pace {PACE}", "continue")
            process.stdout.read()
        finally:
            process.terminate()
    assert went > LEAST
    traces = [(tmp_path / name / "trace.mcap").read_bytes() for name in ("alone", "watched")]
    assert traces[0] == traces[1]
