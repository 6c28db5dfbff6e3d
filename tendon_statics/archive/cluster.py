"""One function over many things, on the processes of this machine or on a cluster of dask."""

from __future__ import annotations

import asyncio
import logging
import multiprocessing
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from itertools import islice
from multiprocessing import forkserver
from typing import Any, Generic, TypeVar

from ..recordings.errors import one_line
from ..recordings.libraries import needed
from . import PURPOSE, local_worker
from .errors import ArchiveError

WAITING = 256
"""Calls that wait or run at once at most, so that nothing grows with their number"""

CONNECT = 10.0
"""s to reach a scheduler"""

LOADED = ('distributed', 'pyarrow.parquet', local_worker.__name__)
"""Modules that every worker needs"""

T = TypeVar('T')
R = TypeVar('R')


def begin_workers(*modules: str) -> None:
    """Begin the process that the workers of this machine are forked from.

    It loads what they need, and these modules, while the program itself still gets ready; a worker
    is then there at once, and none loads anything on its own.
    """
    multiprocessing.get_context('forkserver').set_forkserver_preload([*LOADED, *modules])
    forkserver.ensure_running()


@contextmanager
def connected(workers: int | None = None, scheduler: str | None = None) -> Iterator[Any]:
    """Give a client of a scheduler, or of a cluster of processes here, which ends with it.

    Parameters
    ----------
    workers : int
        Processes here; None: one a core.
    scheduler : str
        Address of the scheduler of a cluster that is there, ``tcp://host:8786``.

    Raises
    ------
    ArchiveError
        If the scheduler cannot be reached.
    RecordingError
        If distributed is missing.
    """
    dask, distributed = needed('dask', 'distributed', purpose=PURPOSE)
    if scheduler is not None:
        try:
            client = distributed.Client(scheduler, timeout=CONNECT)
        except (OSError, ValueError) as error:
            raise ArchiveError(
                f'the scheduler {scheduler} cannot be reached: {one_line(error)}'
            ) from None
        with client:
            yield client
        return
    with dask.config.set({'distributed.worker.multiprocessing-method': 'forkserver'}):
        cluster = distributed.LocalCluster(
            n_workers=workers or len(os.sched_getaffinity(0)),
            threads_per_worker=1,
            processes=True,
            # Not a fixed one, which others may have.
            dashboard_address='127.0.0.1:0',
            scheduler_kwargs={'dashboard': False},  # Its pages take longer to load than all else.
            silence_logs='CRITICAL',
            preload=[local_worker.__name__],
        )
    client = distributed.Client(cluster)
    try:
        yield client
    finally:
        # What an interruption cuts off is no news, and workers that are slow to end are killed.
        logging.getLogger('asyncio').setLevel(logging.CRITICAL)
        for ending in (client, cluster):
            with suppress(TimeoutError, asyncio.TimeoutError):
                ending.close()


class Results(Generic[T, R]):
    """What a function makes of things, one after the other as they are done.

    A call whose worker dies is made again on another. One whose worker has died again and again
    is made once more with no other beside it, since it may have been another that killed them;
    if the worker dies then, the thing is lost.
    """

    def __init__(
        self,
        client: Any,
        function: Callable[[T], R],
        things: Sequence[T],
        lost: Callable[[T], R],
    ) -> None:
        self._client = client
        self._function = function
        self._things = things
        self._lost = lost
        """What stands for the result of a thing that is lost"""

    def __len__(self) -> int:
        return len(self._things)

    def __iter__(self) -> Iterator[R]:
        """Give the results, in any order.

        Raises
        ------
        ArchiveError
            If workers or scheduler are gone or cannot run the function.
        """
        suspects: list[T] = []
        for thing, future in self._done(self._things, WAITING):
            if _has_killed(future):
                suspects.append(thing)
            else:
                yield _result(future)
        for thing, future in self._done(suspects, 1):
            yield self._lost(thing) if _has_killed(future) else _result(future)

    def _done(self, things: Sequence[T], waiting: int) -> Iterator[tuple[T, Any]]:
        """Give each thing with the future that is done, never more than some at once."""
        (distributed,) = needed('distributed', purpose=PURPOSE)
        left = iter(things)
        sent: dict[str, T] = {}

        def send(thing: T) -> Any:
            future = self._client.submit(self._function, thing, pure=False)
            sent[future.key] = thing
            return future

        running = distributed.as_completed([send(thing) for thing in islice(left, waiting)])
        for future in running:
            running.update([send(thing) for thing in islice(left, 1)])
            yield sent.pop(future.key), future


def _has_killed(future: Any) -> bool:
    (distributed,) = needed('distributed', purpose=PURPOSE)
    return future.status == 'error' and isinstance(
        future.exception(), distributed.scheduler.KilledWorker
    )


def _result(future: Any) -> Any:
    try:
        return future.result()
    except ArchiveError:
        raise
    except Exception as error:
        raise ArchiveError(
            f'the workers cannot go on: {type(error).__name__}: {one_line(error)}; started again '
            'it goes on with what is missing'
        ) from None
