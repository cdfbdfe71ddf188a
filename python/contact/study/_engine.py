"""Who does the tasks of a study: threads or processes of this machine, or a cluster of Dask."""
from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor, wait
from multiprocessing import get_context
from typing import Any, Callable

from ..errors import ContactError
from ._task import Done, Task, build, refused, solve_task

#: Tasks that wait for each worker, so that none is idle
_AHEAD = 2
#: How long workers may take to tell what they are [s]
_PATIENCE = 10.0
#: How often a task may end with its worker, alone, before it is given up; how often Dask tries one that fails
_LIVES, _RETRIES = 2, 4


class Engine:
    """Executes tasks; results are returned in the order of completion.

    Parameters
    ----------
    workers
        Number of simultaneous tasks; None: the number of processors available to this process.
    kind
        ``"threads"`` or ``"processes"`` of this machine.
    scheduler
        Address of a scheduler of Dask, such as ``"tcp://10.0.0.1:8786"``, or a ``distributed.Client``; then `workers` and `kind`
        are those of the cluster.
    """

    def __init__(self, workers: int | None = None, kind: str = "threads", scheduler: Any = None) -> None:
        if kind not in ("threads", "processes"):
            raise ValueError(f"engine = {kind!r} is none of threads, processes")
        if workers is not None and (not isinstance(workers, int) or workers < 1):
            raise ValueError(f"workers = {workers!r} is no number of 1 or more")
        self._client: Any = None
        self._own_client = False
        self._kind = kind
        if scheduler is not None:
            self._client = _client_of(scheduler)
            self._own_client = isinstance(scheduler, str)
        self._workers = workers or (len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)

    @property
    def workers(self) -> int:
        """Current number of workers."""
        if self._client is not None:
            return max(1, int(sum(self._client.nthreads().values())))
        return self._workers

    @property
    def dashboard(self) -> str:
        """Address of the dashboard of a cluster, "" without one."""
        return str(self._client.dashboard_link or "") if self._client is not None else ""

    def run(self, tasks: Callable[[], Task | None], stop: Callable[[], bool] = lambda: False) -> Iterator[Done]:
        """Execute tasks until there are none.

        A task whose worker dies is done again when nothing else is under way, in halves if it dies again; a single point that ends
        its worker again and again is refused.

        Parameters
        ----------
        tasks
            Returns the next task, None when there is none left.
        stop
            Returns True to start no further task.
        """
        self._check_builds()
        executor = self._start()
        pending: dict[Future[Done], tuple[Task, int]] = {}
        # what ended with its worker, most often beside the task that is to blame
        suspects: list[tuple[Task, int]] = []
        try:
            while True:
                alone = bool(suspects)
                while len(pending) < (1 if alone else self.workers * _AHEAD) and not stop():
                    if alone:
                        task, lives = suspects.pop()
                    else:
                        following = tasks()
                        if following is None:
                            break
                        task, lives = following, _LIVES
                    pending[executor.submit(solve_task, task)] = (task, lives)
                if not pending:
                    return
                is_sure = alone and len(pending) == 1
                ready, _ = wait(pending, return_when=FIRST_COMPLETED)
                is_broken = False
                for future in ready:
                    task, lives = pending.pop(future)
                    error = future.exception()
                    if error is None:
                        yield future.result()
                    elif not _is_death(error):
                        raise error
                    else:
                        is_broken = True
                        if not is_sure:
                            suspects.append((task, lives))
                        elif len(task) > 1:
                            suspects.extend((part, _LIVES) for part in task.halves())
                        elif lives > 1:
                            suspects.append((task, lives - 1))
                        else:
                            yield refused(task, "the worker ended while it computed this case, several times")
                if is_broken and self._client is None:
                    # a pool that lost a process is of no use, and neither is what it still had to do
                    suspects.extend(pending.values())
                    pending.clear()
                    executor.shutdown(wait=False)
                    executor = self._start()
        finally:
            for future in pending:
                future.cancel()
            executor.shutdown(wait=self._client is None)

    def _check_builds(self) -> None:
        """Refuse workers of a cluster that compute with something else; those that come later refuse their tasks themselves"""
        if self._client is None:
            return
        import distributed
        try:
            # as client.run, which has no limit
            told = self._client.sync(self._client._run, build, on_error="return", callback_timeout=_PATIENCE)
        except distributed.TimeoutError:
            # one of them stands still
            return
        others = [f"{address} ({found})" for address, found in sorted(told.items()) if found != build()]
        if others:
            raise ContactError(f"workers of the cluster are of another build than the study ({build()}), install the same there: "
                               + ", ".join(others))

    def close(self) -> None:
        """Leave the cluster."""
        if self._client is not None and self._own_client:
            self._client.close()

    def _start(self) -> Executor:
        """Whoever takes tasks"""
        if self._client is not None:
            return _Cluster(self._client)
        if self._kind == "processes":
            return ProcessPoolExecutor(self._workers, mp_context=get_context("spawn"))
        return ThreadPoolExecutor(self._workers, thread_name_prefix="study")


class _Cluster(Executor):
    """The workers of a client of Dask as an executor.

    That of distributed itself fails where a result is lost between its end and its transfer, with the worker that has it: it looks
    at the state after the result has been computed again.
    """

    def __init__(self, client: Any) -> None:
        self._client = client
        self._asked: dict[Future[Any], Any] = {}

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        told: Future[Any] = Future()
        asked = self._client.submit(fn, *args, pure=False, retries=_RETRIES, **kwargs)
        self._asked[told] = asked

        async def hand_over() -> None:
            value, failure = None, None
            try:
                value, = await self._client.gather([asked], asynchronous=True)
            except BaseException as error:  # what cancels a task is no Exception
                failure = error
            self._asked.pop(told, None)
            if not told.set_running_or_notify_cancel():
                return
            if failure is None:
                told.set_result(value)
            else:
                told.set_exception(failure)

        self._client.loop.add_callback(hand_over)
        return told

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        left = list(self._asked.values())
        self._asked.clear()
        if left:
            self._client.cancel(left)


def _client_of(scheduler: Any) -> Any:
    """A client of a cluster"""
    if not isinstance(scheduler, str):
        return scheduler
    try:
        import distributed
    except ImportError as reason:
        raise ContactError("studies on a cluster need Dask: pip install 'contact-mechanics[study]'") from reason
    try:
        client: Any = distributed
        # not for everything else that this process does with Dask
        return client.Client(scheduler, timeout="10s", set_as_default=False)
    except ValueError as reason:
        raise ContactError(f"{scheduler} is no address of a scheduler, such as tcp://10.0.0.1:8786: {reason}") from reason
    except OSError as reason:
        raise ContactError(f"no scheduler of Dask answers at {scheduler}: {reason}") from reason


def _is_death(error: BaseException) -> bool:
    """Did the worker end, and not the task?"""
    return type(error).__name__ in ("BrokenProcessPool", "KilledWorker", "CancelledError", "FutureCancelledError")
