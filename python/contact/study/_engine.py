"""Execution of the tasks of a study: by threads or processes of this machine, or by a Dask cluster."""
from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor, wait
from multiprocessing import get_context
from typing import Any, Callable

from ..errors import ContactError
from ._task import Done, Task, build, refused, solve_task

#: Number of queued tasks per worker, so that none is idle
_AHEAD = 2
#: Time limit for workers to report their build [s]
_PATIENCE = 10.0
#: Number of deaths of its worker after which a task that runs alone is refused; number of retries of Dask
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

        A task whose worker dies is repeated with no other task running, and divided in halves if the worker dies again; a single
        point that repeatedly kills its worker is refused.

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
        # tasks whose worker died, most of them while another task was the cause
        suspects: list[tuple[Task, int]] = []
        try:
            while True:
                one_by_one = bool(suspects)
                while len(pending) < (1 if one_by_one else self.workers * _AHEAD) and not stop():
                    if one_by_one:
                        task, lives = suspects.pop()
                    else:
                        following = tasks()
                        if following is None:
                            break
                        task, lives = following, _LIVES
                    pending[executor.submit(solve_task, task)] = (task, lives)
                if not pending:
                    return
                is_sure = one_by_one and len(pending) == 1
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
                            yield refused(task, "the worker died several times while it computed this case")
                if is_broken and self._client is None:
                    # a pool that lost a process is unusable, and its pending tasks are lost
                    suspects.extend(pending.values())
                    pending.clear()
                    executor.shutdown(wait=False)
                    executor = self._start()
        finally:
            for future in pending:
                future.cancel()
            executor.shutdown(wait=self._client is None)

    def _check_builds(self) -> None:
        """Refuse workers of a cluster with another build; workers that join later refuse their tasks themselves"""
        if self._client is None:
            return
        import distributed
        from distributed.comm.core import CommClosedError
        try:
            # as client.run, but with a time limit
            builds = self._client.sync(self._client._run, build, on_error="return", callback_timeout=_PATIENCE)
        except distributed.TimeoutError:
            # a worker does not respond
            return
        # a worker that ends while it is asked has not told its build
        others = [f"{address} ({found})" for address, found in sorted(builds.items())
                  if found != build() and not isinstance(found, CommClosedError)]
        if others:
            raise ContactError(f"workers of the cluster are of another build than the study ({build()}), install the same there: "
                               + ", ".join(others))

    def close(self) -> None:
        """Disconnect from the cluster."""
        if self._client is not None and self._own_client:
            self._client.close()

    def _start(self) -> Executor:
        """A new executor"""
        if self._client is not None:
            return _Cluster(self._client)
        if self._kind == "processes":
            return ProcessPoolExecutor(self._workers, mp_context=get_context("spawn"))
        return ThreadPoolExecutor(self._workers, thread_name_prefix="study")


class _Cluster(Executor):
    """Executor for the workers of a Dask client.

    The executor of distributed fails if a result is lost with its worker after the computation and before the transfer, because it
    checks the state only after the result has been recomputed.
    """

    def __init__(self, client: Any) -> None:
        self._client = client
        self._remote: dict[Future[Any], Any] = {}

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        local: Future[Any] = Future()
        remote = self._client.submit(fn, *args, pure=False, retries=_RETRIES, **kwargs)
        self._remote[local] = remote

        async def hand_over() -> None:
            value, failure = None, None
            try:
                value, = await self._client.gather([remote], asynchronous=True)
            except BaseException as error:  # a cancellation is not an Exception
                failure = error
            self._remote.pop(local, None)
            if not local.set_running_or_notify_cancel():
                return
            if failure is None:
                local.set_result(value)
            else:
                local.set_exception(failure)

        self._client.loop.add_callback(hand_over)
        return local

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        left = list(self._remote.values())
        self._remote.clear()
        if left:
            self._client.cancel(left)


def _client_of(scheduler: Any) -> Any:
    """A client of a Dask cluster"""
    if not isinstance(scheduler, str):
        return scheduler
    try:
        import distributed
    except ImportError as reason:
        raise ContactError("studies on a cluster need Dask: pip install 'contact-mechanics[study]'") from reason
    try:
        client: Any = distributed
        # other uses of Dask in this process keep their client
        return client.Client(scheduler, timeout="10s", set_as_default=False)
    except ValueError as reason:
        raise ContactError(f"{scheduler} is not the address of a scheduler, such as tcp://10.0.0.1:8786: {reason}") from reason
    except OSError as reason:
        raise ContactError(f"no scheduler of Dask answers at {scheduler}: {reason}") from reason


def _is_death(error: BaseException) -> bool:
    """Was the error caused by the end of the worker, not by the task?"""
    return type(error).__name__ in ("BrokenProcessPool", "KilledWorker", "CancelledError", "FutureCancelledError")
