"""Runs trials on dask workers. The workers are processes of this computer, or belong to a cluster that is given by the
address of its scheduler.
"""

from collections.abc import Generator, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from typing import Any, Final

from handeye.core.errors import MissingExtra, Refused
from handeye.core.versions import code_digest
from handeye.trials.sweep import Case, Engine, GuardedWork
from handeye.trials.workers import TRIES, Answer

HOST: Final = "127.0.0.1"  # Workers here listen on this computer alone


def dask_workers(count: int, scheduler: str | None) -> Engine:
    """Return an engine. If `scheduler` is an address, the engine uses the workers of the scheduler at this address. If
    `scheduler` is None, the engine starts `count` workers on this computer.
    """
    return lambda work, cases: _answers(work, cases, count, scheduler)


def _answers(
    work: GuardedWork[Any], cases: Sequence[Case], count: int, scheduler: str | None
) -> Generator[Answer[Case, list[Any]], None, None]:
    """Yield the answers for all cases in the order in which the cases end. Raises InvalidInput if dask or its
    workers cannot be used.

    If a worker is killed, the scheduler repeats the trial once without reporting it.
    """
    try:
        from distributed import KilledWorker, as_completed
    except ImportError:
        raise MissingExtra("--engine dask", "distributed", "cluster") from None
    if not cases:
        return
    with _client(count, scheduler) as client:
        there = client.scatter(work, broadcast=True)  # sent once to each worker, and not with each trial
        code = code_digest()
        given = {client.submit(_tried, there, code, case, pure=False): case for case in cases}
        for done in as_completed([*given], loop=client.loop):
            case = given.pop(done)
            try:
                yield Answer(item=case, value=done.result())
            except KilledWorker:
                yield Answer(item=case, killed=TRIES)
            done.release()


def _tried(work: GuardedWork[Any], code: str, case: Case) -> list[Any]:
    """Execute a case on a worker. Raises InvalidInput if the worker has another version of handeye."""
    if code_digest() != code:
        raise Refused(
            "a worker has a different version of handeye from this computer; install the same version on all computers"
        )
    return work(case)


@contextmanager
def _client(count: int, scheduler: str | None) -> Iterator[Any]:
    from distributed import Client

    with ExitStack() as closing:
        address = closing.enter_context(_cluster(count)) if scheduler is None else scheduler
        try:
            client = Client(address, timeout="10s", set_as_default=False)
        except (OSError, ValueError, TimeoutError):
            raise Refused(f"no dask scheduler answers at {address}") from None
        yield closing.enter_context(client)


@contextmanager
def _cluster(count: int) -> Iterator[str]:
    """Start workers on this computer, and yield the address of their scheduler."""
    import dask
    from distributed import LocalCluster

    with dask.config.set({"distributed.scheduler.allowed-failures": TRIES - 1}):
        cluster = LocalCluster(
            n_workers=count, threads_per_worker=1, host=HOST, dashboard_address=None, silence_logs="CRITICAL"
        )
        try:
            yield cluster.scheduler_address
        finally:
            with suppress(TimeoutError):  # the work is done; on a busy computer, the processes end slowly
                cluster.close()
