"""Connects to a Dask scheduler, or starts one with its workers here."""

from __future__ import annotations

import asyncio
import importlib.util
import logging
import os
from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress

import dask.config
from distributed import Client, LocalCluster
from distributed.scheduler import DEFAULT_EXTENSIONS
from distributed.security import Security

from autograder.errors import AutograderError
from autograder.grading.dask_address import ClusterAddress
from autograder.grading.dask_memory import BRIEF, NoSpans

DEATHS = 3  # of its workers, until Dask gives a task back
_CONNECT_SECONDS = 20
_CLOSE_SECONDS = 5
_LOCAL = {
    "distributed.scheduler.allowed-failures": DEATHS - 1,
    "distributed.scheduler.worker-ttl": "60s",
    # On a busy machine a nanny needs long to start a worker again; it is not to be given up.
    "distributed.deploy.lost-worker-timeout": "10m",
    "distributed.worker.profile.enabled": False,
    "distributed.worker.preload": ["autograder.grading.dask_worker"],
}


class ClusterError(AutograderError):
    """The cluster cannot be used, or has gone; the sentence says what to do."""


@contextmanager
def connect(address: ClusterAddress) -> Iterator[Client]:
    """A client of the scheduler at an address, or of workers that live as long as the context.

    Raises:
        ClusterError: if there is no scheduler, or workers cannot be started.
    """
    # What goes wrong is said in one sentence here; Dask would say it at length beside it.
    for name in list(logging.root.manager.loggerDict):
        if name.partition(".")[0] == "distributed":  # each has a level of its own
            logging.getLogger(name).setLevel(logging.CRITICAL)
    with (
        dask.config.set(BRIEF),
        _local(address.local) if address.local else _remote(address.text) as client,
    ):
        try:
            yield client
        finally:
            with suppress(Exception):
                client.close(timeout=_CLOSE_SECONDS)


@contextmanager
def gone_in_one_sentence(address: ClusterAddress) -> Iterator[None]:
    """Turn what Dask raises when the scheduler has gone into a sentence."""
    try:
        yield
    except (OSError, CancelledError, asyncio.CancelledError, RuntimeError) as error:
        raise gone(address) from error


def gone(address: ClusterAddress) -> ClusterError:
    """What is said when the scheduler does not answer any more."""
    return ClusterError(
        f"The scheduler at {address.text} has gone. What was graded is kept; when the scheduler "
        "runs again, run this command again to go on."
    )


@contextmanager
def _remote(address: str) -> Iterator[Client]:
    is_encrypted = address.startswith(("tls://", "wss://"))
    # Dask would notice too, but leave half a client behind, which keeps the process from ending.
    if is_encrypted and Security().get_connection_args("client").get("ssl_context") is None:
        raise ClusterError(
            f"No Dask scheduler can be reached at {address}: Dask has no certificate here; name it "
            "in Dask's settings (distributed.comm.tls), the same as on the scheduler."
        )
    try:
        client = Client(address, timeout=_CONNECT_SECONDS, name="autograder", set_as_default=False)
    except (
        OSError,
        ValueError,
        TypeError,
        AssertionError,  # by a setting of Dask's that is out of range
    ) as error:
        reason = str(error).partition("\n")[0][:200] or type(error).__name__
        raise ClusterError(
            f"No Dask scheduler can be reached at {address} ({reason}); start one with "
            "`dask scheduler`, or check the address and, for tls://, Dask's security settings."
        ) from None
    yield client


@contextmanager
def _local(workers: int) -> Iterator[Client]:
    # Workers are started as `python -c ...`, which would import from the current folder first, and
    # that may be a submission's.
    os.environ["PYTHONSAFEPATH"] = "1"
    os.environ.setdefault("DASK_LOGGING__DISTRIBUTED", "critical")  # for the workers
    dashboard = "127.0.0.1:0" if importlib.util.find_spec("bokeh") else None
    with dask.config.set(_LOCAL):
        try:
            cluster = LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                processes=True,
                host="127.0.0.1",
                dashboard_address=dashboard,
                memory_limit=0,  # the sandbox limits what submissions take
                scheduler_kwargs={"extensions": {**DEFAULT_EXTENSIONS, "spans": NoSpans}},
                silence_logs=logging.CRITICAL,
            )
        except (OSError, RuntimeError, TimeoutError) as error:
            raise ClusterError(f"No workers can be started here ({error}).") from None
        try:
            yield Client(cluster, name="autograder", set_as_default=False)
        finally:
            with suppress(Exception):
                cluster.close(timeout=_CLOSE_SECONDS)
