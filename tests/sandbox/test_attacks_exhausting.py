"""Attempts to use everything up: memory, processes, files, output."""

import pytest
from attacks import LIMITS
from msgspec.structs import replace

from autograder.sandbox.session import Session

pytestmark = pytest.mark.usefixtures("after_each_a_good_submission_gets_its_marks")


@pytest.mark.parametrize(
    "code",
    [
        "x = bytearray(4 * 10**9)",
        "import numpy as np\nx = np.ones(10**9)",
        "x = []\nwhile True: x.append(' ' * 10**6)",
        "x = {}\nwhile True: x[len(x)] = [0] * 10**6",
    ],
)
def test_a_memory_bomb_is_an_error_in_its_cell(session, code):
    report = session.run(["a = 1", code, "b = 2"], ["a", "b"])
    assert report["errors"][1] in ("MemoryError", "_ArrayMemoryError", "killed", "timeout")
    assert report["understood"] == {"a": "1", "b": "2"}


def test_memory_in_many_processes_is_counted_together(session):
    code = (
        "import os, time\nfor _ in range(20):\n    if os.fork() == 0:\n"
        "        x = bytearray(100 * 10**6); time.sleep(30); os._exit(0)\ntime.sleep(30)"
    )
    report = session.run([code, "b = 2"], ["b"])
    assert report["errors"][0] in ("killed", "timeout", "MemoryError", "BlockingIOError")
    assert report["understood"] == {"b": "2"}


@pytest.mark.parametrize(
    "code",
    [
        "mmap.mmap(-1, 4096)",
        "mmap.mmap(-1, 4096, flags=mmap.MAP_SHARED | mmap.MAP_ANONYMOUS | 0x4000)",
        "mmap.mmap(os.open('/dev/zero', os.O_RDONLY), 4096, prot=mmap.PROT_READ)",
        "os.memfd_create('m')",
        "open('/dev/shm/m', 'w')",
    ],
)
def test_there_is_no_memory_that_no_process_is_charged_for(lab, code):
    """Shared pages that nobody has mapped at the moment are in no process's count."""
    assert lab.error(f"import mmap, os\n{code}") in ("PermissionError", "FileNotFoundError")
    private = "import mmap\nmine = mmap.mmap(-1, 4096, flags=mmap.MAP_PRIVATE)\nfound = len(mine)"
    assert lab.value(private) == "4096"


def test_a_fork_bomb_runs_into_its_limit(sandbox):
    code = "import os\nwhile True:\n    try: os.fork()\n    except OSError: pass"
    # The time of all its processes adds up, until this machine comes round to ending them.
    patient = replace(LIMITS, notebook_seconds=120)
    with Session(sandbox._take_host, patient, 1) as session:
        report = session.run([code, "b = 2"], ["b"])
    assert report["errors"][0] in ("timeout", "killed")
    assert report["understood"] == {"b": "2"}


def test_a_thread_bomb_runs_into_its_limit(lab):
    code = "import threading, time\nfor _ in range(10**6):\n"
    code += "    threading.Thread(target=time.sleep, args=(60,), daemon=True).start()"
    assert lab.error(code) in ("RuntimeError", "MemoryError", "killed")


def test_a_huge_file_is_an_error(lab):
    code = "with open('big', 'wb') as file:\n    for _ in range(10**4): file.write(bytes(10**6))"
    assert lab.error(code) in ("OSError", "killed")


def test_many_large_files_are_an_error(lab):
    code = "for n in range(1000):\n    open(f'{n}', 'wb').write(bytes(10**6))"
    assert lab.error(code) in ("OSError", "killed")


@pytest.mark.parametrize("keep", ["file", "mapped(file)"])
def test_files_without_a_name_count_too(lab, keep):
    code = (
        "import ctypes, os, time\nlibc = ctypes.CDLL(None)\nlibc.prctl(4, 0, 0, 0, 0)\n"
        "def mapped(file):\n"
        "    libc.mmap(None, ctypes.c_size_t(4 * 10**6), 3, 1, file.fileno(), ctypes.c_long(0))\n"
        "    file.close()\n"
        "kept = []\nfor _ in range(5):\n"
        "    file = open('big', 'wb+')\n    file.write(bytes(4 * 10**6))\n    file.flush()\n"
        f"    os.unlink('big')\n    kept.append({keep})\n"
        "time.sleep(2)"
    )
    assert lab.error(code) in ("OSError", "killed")


def test_many_files_are_stopped(lab):
    code = "import time\nfor n in range(10**6):\n    open(f'{n}', 'wb').close()"
    assert lab.error(code) in ("OSError", "killed", "timeout")


def test_four_hundred_megabytes_of_output_go_nowhere(lab):
    code = "text = 'x' * 10**6\nfor _ in range(200): print(text)\n"
    code += "import sys\nfor _ in range(200): sys.stderr.write(text)\nfound = 'done'"
    assert lab.value(code) == "done"


def test_output_written_past_python_goes_nowhere_either(lab):
    code = "import os\nfor _ in range(100): os.write(1, bytes(10**6)); os.write(2, bytes(10**6))"
    assert lab.error(code) is None


def test_a_daemon_does_not_outlive_its_notebook(lab):
    code = (
        "import os, time\n"
        "if os.fork() == 0:\n    os.setsid()\n    if os.fork() == 0:\n"
        "        while True:\n            time.sleep(0.01)\n"
        "            try: open('still-here', 'w').close()\n            except OSError: pass\n"
        "    os._exit(0)\n"
    )
    lab.report(code)
    assert (
        lab.value("import os, time\ntime.sleep(0.2)\nfound = 'still-here' in os.listdir()")
        == "False"
    )
