"""Runs of a sweep side by side: in threads, or as tasks of a Dask cluster."""

import concurrent.futures
import itertools
import math
import os
import queue
import threading
import time

import numpy as np

TASK_COST = 3e-3  # s; what Dask's scheduler spends on an empty task
LEAST_SHARE = 100  # of that time a task simulates at least as much
SCHEDULED_AT_ONCE = 10_000  # tasks that the scheduler holds: beyond it, tasks are longer


def in_threads(function, items, jobs, keep):
    """Calls keep(number, function(item, progress)) for each item, in this thread and as they finish. The first error ends the runs that
    `progress` is given to."""
    numbers, finished, stopped = itertools.count(), queue.SimpleQueue(), threading.Event()

    def progress(_):
        if stopped.is_set():
            raise concurrent.futures.CancelledError

    def work():
        while not stopped.is_set() and (number := next(numbers)) < len(items):
            try:
                finished.put((number, function(items[number], progress), None))
            except BaseException as error:
                finished.put((number, None, error))

    # Not a ThreadPoolExecutor: Python waits for its threads at exit, and so for a sweep in a daemon thread.
    threads = [threading.Thread(target=work, daemon=True) for _ in range(min(jobs or os.cpu_count(), len(items)))]
    try:
        for thread in threads:
            thread.start()
        for _ in items:
            number, value, error = finished.get()
            if error is not None:
                raise error
            keep(number, value)
    finally:
        stopped.set()
        for thread in threads:
            if thread.ident is not None:
                thread.join()


class Rows(dict):
    """The records of a run, as in a Result, that can be sent to another process."""

    def __init__(self, result):
        super().__init__({name: np.array(result[name]) for name in result})
        self.time = np.array(result.time)
        self.units = result.units

    def __reduce__(self):
        return _rows, (dict(self), self.time, self.units)


def _rows(records, times, units):
    rows = Rows.__new__(Rows)
    rows.update(records)
    rows.time, rows.units = times, units
    return rows


def on_dask(client, function, items, keep):
    """Calls keep(number, function(item)) for each item, computed by the workers of `client`, a dask.distributed.Client, as they finish.
    The first item is computed here, to find how many of the others make a task long enough. The first error ends all tasks."""
    import distributed

    start = time.perf_counter()
    keep(0, function(items[0]))
    seconds = max(time.perf_counter() - start, 1e-6)
    rest = len(items) - 1
    size = max(math.ceil(LEAST_SHARE * TASK_COST / seconds), math.ceil(rest / SCHEDULED_AT_ONCE), 1)
    groups = [items[first : first + size] for first in range(1, len(items), size)]
    tasks = client.map(_group, groups, function=function, pure=False)
    first_of = {task.key: 1 + number * size for number, task in enumerate(tasks)}
    try:
        for task, values in distributed.as_completed(tasks, with_results=True):
            for number, value in enumerate(values, first_of[task.key]):
                keep(number, value)
    finally:
        client.cancel(tasks)


def _group(items, function):
    return [function(item) for item in items]
