#!/usr/bin/env python3
"""Puts faults into a copy of the code, one at a time, and says which test catches each.

The faults are in mutants.toml. With NAMEs, those whose name contains one of them are tried,
and all of an area that is one of them.
Exit code: 0 if all is as the table says, 1 if not, 2 if it could not be tried, 130 after Ctrl-C.
"""

import argparse
import queue
import signal
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from pathlib import Path
from typing import TypeVar

from mutant_table import Mutant, TableError, load
from trying import Copy, Outcome, TryingError, Unmutated, tried

T = TypeVar("T")


def main(words: Sequence[str] | None = None) -> int:
    """The command."""
    options = _options(words)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    begun = time.monotonic()
    try:
        chosen = _chosen(load(), options.names)
        if options.list:
            for mutant in chosen:
                print(f"{mutant.area:<12} {mutant.name}")
            return 0
        outcomes = _carried_out(chosen, options.workers)
    except (TableError, TryingError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\nstopped; the copies are deleted", file=sys.stderr)
        return 130
    print(_summary(outcomes, time.monotonic() - begun))
    return 0 if all(outcome.expected for outcome in outcomes) else 1


def _options(words: Sequence[str] | None) -> argparse.Namespace:
    first, _, rest = (__doc__ or "").partition("\n\n")
    parser = argparse.ArgumentParser(description=first, epilog=rest)
    parser.add_argument("names", nargs="*", metavar="NAME", help="a part of the name of a fault, or an area")
    parser.add_argument("--list", action="store_true", help="list the faults and try none")
    parser.add_argument("--workers", type=_count, default=1, metavar="N", help="faults tried at a time (1)")
    return parser.parse_args(words)


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} is no number of workers; it is 1 or more")
    return int(text)


def _chosen(mutants: Sequence[Mutant], names: Sequence[str]) -> list[Mutant]:
    """The faults of these names and areas; all without any."""
    areas = {mutant.area for mutant in mutants}

    def called(mutant: Mutant, name: str) -> bool:
        return mutant.area == name if name in areas else name in mutant.name

    for name in names:
        if not any(called(mutant, name) for mutant in mutants):
            raise TableError(f"no fault is called `{name}`; --list shows them all")
    return [mutant for mutant in mutants if not names or any(called(mutant, name) for name in names)]


def _carried_out(mutants: Sequence[Mutant], workers: int) -> list[Outcome]:
    """Try the faults, each worker in a copy of its own, and tell of each at once."""
    stop, sound = threading.Event(), Unmutated()
    with tempfile.TemporaryDirectory(prefix="mutants-") as folder:
        copies: queue.SimpleQueue[Copy] = queue.SimpleQueue()
        for number in range(min(workers, len(mutants))):
            place = Path(folder) / str(number)
            place.mkdir()
            copies.put(Copy(place, stop))
        with ThreadPoolExecutor(workers) as pool:
            try:
                named = sorted({mutant.caught_by for mutant in mutants if mutant.caught_by})
                if named:
                    print(f"without a fault: {len(named)} tests ...", flush=True)
                    pool.submit(_with, copies, lambda copy: sound.check(copy, named)).result()
                futures = [
                    pool.submit(_with, copies, lambda copy, mutant=mutant: tried(mutant, copy, sound))
                    for mutant in mutants
                ]
                return list(_told(futures))
            finally:
                stop.set()
                pool.shutdown(wait=True, cancel_futures=True)


def _with(copies: queue.SimpleQueue[Copy], act: Callable[[Copy], T]) -> T:
    """Do something with a copy that nobody else has meanwhile."""
    copy = copies.get()
    try:
        return act(copy)
    finally:
        copies.put(copy)


def _told(futures: Sequence[Future[Outcome]]) -> Iterator[Outcome]:
    """Outcomes as they come in, each told in a line."""
    for number, future in enumerate(as_completed(futures), 1):
        outcome = future.result()
        print(f"{number:3}/{len(futures)}  {_line(outcome)}", flush=True)
        yield outcome


def _line(outcome: Outcome) -> str:
    """What came of a fault; what the table does not say in capitals."""
    ending = outcome.ending if outcome.expected else outcome.ending.upper()
    test = "" if outcome.test is None else f" by {outcome.test.partition('[')[0]}"
    return f"{ending}: {outcome.mutant.name}{test} ({outcome.seconds:.1f} s)"


def _summary(outcomes: Sequence[Outcome], seconds: float) -> str:
    """Counts of all endings, by area and in all."""
    areas = dict.fromkeys(outcome.mutant.area for outcome in outcomes)
    rows = [(area, [o for o in outcomes if o.mutant.area == area]) for area in areas]
    rows.append(("all", list(outcomes)))
    lines = [f"  {area:<12} {_counts(of)}" for area, of in rows]
    return "\n".join([f"{len(outcomes)} faults in {seconds:.0f} s", *lines])


def _counts(outcomes: Sequence[Outcome]) -> str:
    counts = Counter(outcome.ending for outcome in outcomes)
    return ", ".join(f"{number} {ending}" for ending, number in counts.most_common())


if __name__ == "__main__":
    sys.exit(main())
