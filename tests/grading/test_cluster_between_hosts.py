"""A cluster of several machines: certificates on the way, and hosts with their own addresses."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import pytest
from cluster_class import Lab, make_class, marks, start, stored, wait_until

pytest.importorskip("distributed", reason="Dask is not installed: uv run --extra cluster pytest")
pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(sys.platform != "linux", reason="the sandbox is Linux's"),
]

STUDENTS = 4


@pytest.fixture(scope="module")
def root(tmp_path_factory) -> Path:
    root = tmp_path_factory.mktemp("hosts")
    make_class(root, STUDENTS, 0)
    return root


@pytest.fixture(scope="module")
def local(root) -> list[tuple[object, ...]]:
    process = start(root, "threads", "--jobs", "1")
    said, _ = process.communicate(timeout=300)
    assert process.returncode == 0, said
    return marks(root / "threads/gradebook.db")


@pytest.fixture(scope="module")
def certificates(tmp_path_factory) -> dict[str, str]:
    """Dask's settings for TLS, with a certificate that this test made and signed itself."""
    if shutil.which("openssl") is None:
        pytest.skip("openssl is not installed, so no certificate can be made")
    folder = tmp_path_factory.mktemp("certificates")
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2",
         "-subj", "/CN=lab", "-keyout", "lab.key", "-out", "lab.pem"],
        cwd=folder, check=True, capture_output=True,
    )  # fmt: skip
    settings = {"DASK_DISTRIBUTED__COMM__TLS__CA_FILE": str(folder / "lab.pem")}
    for who in ("SCHEDULER", "WORKER", "CLIENT"):
        settings[f"DASK_DISTRIBUTED__COMM__TLS__{who}__CERT"] = str(folder / "lab.pem")
        settings[f"DASK_DISTRIBUTED__COMM__TLS__{who}__KEY"] = str(folder / "lab.key")
    return settings


def test_over_tls_the_marks_are_the_same_and_nobody_gets_in_without_a_certificate(
    root, local, tmp_path, certificates
):
    (tmp_path / "course").symlink_to(root / "course")
    lab = Lab(tmp_path, scheme="tls", **certificates)
    try:
        lab.scheduler("--protocol", "tls")
        lab.worker("one")
        process = start(root, "tls", "--cluster", lab.address, **certificates)
        said, _ = process.communicate(timeout=300)
        assert process.returncode == 0, said
        assert marks(root / "tls/gradebook.db") == local
        for address in (lab.address, lab.address.replace("tls://", "tcp://")):
            process = start(root, "stranger", "--cluster", address)
            said, _ = process.communicate(timeout=120)
            assert process.returncode == 1
            assert f"No Dask scheduler can be reached at {address}" in said
            assert "Traceback" not in said
            assert not (root / "stranger/grades.csv").exists()
    finally:
        lab.stop()


_numbers = count()


class Network:
    """Network namespaces on a bridge: hosts as far as addresses and connections go."""

    def __init__(self) -> None:
        # Another name for each: a host ends only with its last process.
        self.name = f"ag{os.getpid() % 100000}x{next(_numbers)}"
        self.coordinator = "10.213.77.1"
        self._ip("link", "add", self.name, "type", "bridge")
        self._ip("address", "add", f"{self.coordinator}/24", "dev", self.name)
        self._ip("link", "set", self.name, "up")
        self.hosts: list[str] = []

    def host(self) -> tuple[str, list[str]]:
        """Another host: its address, and what stands before a command that is to run there."""
        number = len(self.hosts) + 2
        host, here, there = (f"{self.name}{letter}{number}" for letter in "nhp")
        self._ip("netns", "add", host)
        self.hosts.append(host)
        self._ip("link", "add", here, "type", "veth", "peer", "name", there, "netns", host)
        self._ip("link", "set", here, "master", self.name, "up")
        address = f"10.213.77.{number}"
        self._ip("-n", host, "address", "add", f"{address}/24", "dev", there)
        for device in ("lo", there):
            self._ip("-n", host, "link", "set", device, "up")
        return address, ["ip", "netns", "exec", host]

    def cut(self, number: int) -> None:
        """From now on no packet reaches the host with this number, and nobody is told."""
        self._ip("link", "set", f"{self.name}h{number + 2}", "down")

    def mend(self, number: int) -> None:
        """Undo `cut`."""
        self._ip("link", "set", f"{self.name}h{number + 2}", "up")

    def close(self) -> None:
        for host in self.hosts:
            subprocess.run(["ip", "netns", "delete", host], check=False)
        subprocess.run(["ip", "link", "delete", self.name], check=False)

    def _ip(self, *words: str) -> None:
        subprocess.run(["ip", *words], check=True, capture_output=True)


@pytest.fixture
def network() -> Iterator[Network]:
    if shutil.which("ip") is None:
        pytest.skip("iproute2 is not installed, so there are no other hosts")
    try:
        network = Network()
    except subprocess.CalledProcessError as error:
        pytest.skip(f"no network may be made here: {error.stderr.decode().strip()}")
    try:
        try:
            network.host()
        except subprocess.CalledProcessError as error:
            pytest.skip(f"no host may be made here: {error.stderr.decode().strip()}")
        yield network
    finally:
        network.close()


def test_workers_on_other_hosts_grade_and_the_coordinator_alone_writes(
    root, local, tmp_path, network
):
    (tmp_path / "course").symlink_to(root / "course")
    address, on_scheduler = "10.213.77.2", ["ip", "netns", "exec", network.hosts[0]]
    lab = Lab(tmp_path, host=address)
    try:
        lab.scheduler(on=on_scheduler)
        for name in ("one", "two"):
            _, on_host = network.host()
            lab.worker(name, on=on_host)
        process = start(root, "hosts", "--cluster", lab.address)
        said, _ = process.communicate(timeout=300)
        assert process.returncode == 0, said
        assert marks(root / "hosts/gradebook.db") == local
    finally:
        lab.stop()


SOON = {"DASK_DISTRIBUTED__COMM__TIMEOUTS__TCP": "15s"}  # until a dead connection is given up


def test_a_worker_behind_a_network_that_hangs_costs_nobody_a_mark(root, local, tmp_path, network):
    (tmp_path / "course").symlink_to(root / "course")
    lab = Lab(tmp_path, host="10.213.77.2", **SOON)
    try:
        lab.scheduler(on=["ip", "netns", "exec", network.hosts[0]])
        lab.worker("cut off", on=network.host()[1])
        process = start(root, "cut", "--cluster", lab.address, **SOON)
        wait_until(lambda: stored(root / "cut/gradebook.db") >= 1 or process.poll() is not None)
        network.cut(1)
        lab.worker("reached", on=network.host()[1])
        said, _ = process.communicate(timeout=300)
        assert process.returncode == 0, said
        assert marks(root / "cut/gradebook.db") == local
    finally:
        lab.stop()


def test_a_scheduler_behind_a_network_that_hangs_ends_the_run_which_goes_on_later(
    root, local, tmp_path, network
):
    (tmp_path / "course").symlink_to(root / "course")
    lab = Lab(tmp_path, host="10.213.77.2", **SOON)
    try:
        lab.scheduler(on=["ip", "netns", "exec", network.hosts[0]])
        lab.worker("one", on=network.host()[1])
        process = start(root, "lost", "--cluster", lab.address, **SOON)
        wait_until(lambda: stored(root / "lost/gradebook.db") >= 1 or process.poll() is not None)
        network.cut(0)
        said, _ = process.communicate(timeout=300)
        assert process.returncode == 1, said
        assert "Traceback" not in said
        assert lab.address in said
        assert 1 <= stored(root / "lost/gradebook.db") < STUDENTS
        network.mend(0)
        lab.worker("two", on=network.host()[1])  # a worker without its scheduler ends
        again = start(root, "lost", "--cluster", lab.address, **SOON)
        said, _ = again.communicate(timeout=300)
        assert again.returncode == 0, said
        assert marks(root / "lost/gradebook.db") == local
    finally:
        lab.stop()
