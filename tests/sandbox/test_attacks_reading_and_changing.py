"""Attempts to read what must not be read and to change what is not the student's own."""

import os
import socket
import subprocess
import sys

import pytest
from attacks import SECRET, tree

pytestmark = pytest.mark.usefixtures("after_each_a_good_submission_gets_its_marks")

REFUSED = {
    "PermissionError",
    "FileNotFoundError",
    "ProcessLookupError",
    "NotADirectoryError",
    "ModuleNotFoundError",
    "OSError",
}


# --- reading


@pytest.mark.parametrize(
    "path",
    [
        "solutions/answers/kitchen.toml",
        "solutions/answers/secret.toml",
        "solutions/kitchen.py",
        "solutions/fast/kitchen.py",
        "grades/gradebook.db",
        "notebooks/1_kitchen.ipynb",
        "notebooks/responses/kitchen.json",
    ],
)
def test_the_answers_cannot_be_read_by_their_path(lab, course, path):
    assert lab.error(f"open({str(course.root / path)!r}).read()") in REFUSED
    for start in ("..", "../..", "/course", "/course/autograder/.."):
        assert lab.error(f"open({start + '/' + path!r}).read()") in REFUSED


def test_the_answers_cannot_be_imported(lab, course):
    assert lab.error("import solutions.kitchen") in REFUSED
    code = f"import sys; sys.path.insert(0, {str(course.root)!r})\nimport solutions.kitchen"
    assert lab.error(code) in REFUSED


def test_the_answers_are_in_no_folder_that_can_be_walked(lab, course):
    code = (
        "import os\n"
        f"tops = ['/', '/tmp', {str(course.root)!r}, os.getcwd(), os.environ['HOME']]\n"
        "found = [n for t in tops for f, ds, ns in os.walk(t, followlinks=True)\n"
        "         for n in ds + ns if n in ('solutions', 'answers', 'gradebook.db')][:9]"
    )
    assert lab.value(code) == "[]"


@pytest.mark.parametrize(
    "path", ["/root", "/home", "/etc/passwd", "/etc/shadow", "/proc/1/environ", "/proc/1/cmdline",
             "/proc/1/mem", "/proc/self/environ", "/proc/self/maps", "/proc/net/tcp", "/sys",
             "/var", "/dev/mem", "/dev/tty", "/proc/sys/kernel/core_pattern"],
)  # fmt: skip
def test_the_machine_cannot_be_read(lab, path):
    code = f"import os\nos.listdir({path!r}) if os.path.isdir({path!r}) else open({path!r}).read()"
    assert lab.error(code) in REFUSED


def test_the_environment_and_arguments_tell_nothing(lab, course, monkeypatch):
    code = "import os, sys\nfound = str(dict(os.environ)) + str(sys.argv)"
    monkeypatch.setenv("CANVAS_TOKEN", SECRET)
    code += f"\nfound = {SECRET!r} in found, {str(course.root)!r} in found, len(found) < 4000"
    assert lab.value(code) == "(False, False, True)"


def test_no_other_process_can_be_read_or_traced(lab):
    code = """
import ctypes, os
libc = ctypes.CDLL(None, use_errno=True)
found = []
for process in (1, os.getppid(), {grader}):
    found.append(libc.ptrace(16, process, 0, 0))  # PTRACE_ATTACH
    buffer = ctypes.create_string_buffer(8)
    class Piece(ctypes.Structure):
        _fields_ = [("base", ctypes.c_void_p), ("size", ctypes.c_size_t)]
    mine = Piece(ctypes.addressof(buffer), 8)
    theirs = Piece(ctypes.addressof(buffer), 8)
    found.append(libc.process_vm_readv(process, ctypes.byref(mine), 1, ctypes.byref(theirs), 1, 0))
found = set(found)
"""
    assert lab.value(code.format(grader=os.getpid())) == "{-1}"


def test_no_descriptor_is_inherited_but_the_channel_and_nothing(lab):
    code = """
import os, stat
found = []
for number in range(1024):
    try:
        found.append(os.fstat(number).st_mode)
    except OSError:
        pass
nothing = os.stat("/dev/null").st_mode
found = ["socket" if stat.S_ISSOCK(mode) else mode == nothing or mode for mode in found]
"""
    assert lab.value(code) == "[True, True, True, 'socket']"


@pytest.mark.parametrize("kind", ["SOCK_STREAM", "SOCK_DGRAM"])
@pytest.mark.parametrize("family", ["AF_INET", "AF_INET6", "AF_UNIX", "AF_NETLINK"])
def test_no_socket_can_be_made(lab, family, kind):
    assert lab.error(f"import socket\nsocket.socket(socket.{family}, socket.{kind})") in REFUSED


def test_no_name_can_be_looked_up(lab):
    code = "import socket\nsocket.getaddrinfo('example.org', 80)"
    assert lab.error(code) in {"gaierror", "PermissionError", "OSError"}


def test_a_listening_grader_hears_nothing(lab):
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        listener.listen()
        listener.settimeout(0.2)
        port = listener.getsockname()[1]
        lab.error(f"import urllib.request\nurllib.request.urlopen('http://127.0.0.1:{port}')")
        with pytest.raises(TimeoutError):
            listener.accept()


def test_nothing_of_another_submission_is_left(lab):
    places = ["/tmp", "/dev/shm", "/scratch", ".", "..", "../tmp", "/var/tmp", "../responses"]
    lab.report(
        "import os, tempfile\n"
        f"for place in {places} + [tempfile.gettempdir(), os.environ['HOME']]:\n"
        "    try:\n"
        "        open(os.path.join(place, 'left-behind'), 'w').write('answers')\n"
        "        os.makedirs(os.path.join(place, 'deep', 'left-behind'))\n"
        "        os.chmod(os.path.join(place, 'deep'), 0)\n"
        "    except OSError: pass\n"
    )
    code = (
        "import os, tempfile\n"
        f"found = [p for p in {places} + [tempfile.gettempdir(), os.environ['HOME']]\n"
        "    if os.path.exists(os.path.join(p, 'left-behind'))\n"
        "    or os.path.exists(os.path.join(p, 'deep'))]"
    )
    assert lab.value(code) == "[]"


@pytest.mark.parametrize(
    "code",
    [
        "for _ in range(400):\n    os.mkdir('d' * 200); os.chdir('d' * 200)",
        "for _ in range(3000):\n    os.mkdir('d'); os.chdir('d')",
        "os.makedirs('../tmp/a/b/c'); os.chmod('../tmp/a/b/c', 0); os.chmod('../tmp/a/b', 0)",
        "os.makedirs('a/b'); os.symlink('..', 'a/up'); os.symlink('/', 'a/b/top')\n"
        "os.chmod('a/b', 0o500); os.chmod('a', 0o500)",
        "os.chmod('../..', 0); os.chmod('..', 0); os.chmod('.', 0)",
    ],
)
def test_folders_that_are_hard_to_remove_are_swept_away(lab, code):
    assert lab.error("pass") is None
    host = lab.sandbox._host
    # Without a file system of its own, folders that cannot be looked into end the notebook.
    assert lab.error(f"import os\n{code}") in (None, "killed", "PermissionError")
    assert lab.value("import os\nfound = os.listdir('../tmp'), os.path.exists('a')") == (
        "([], False)"
    )
    assert lab.sandbox._host is host  # no new sandbox was needed


def test_hidden_inputs_come_after_what_is_understood_was_said(session):
    """What a function is asked with cannot show up in what a student is shown."""
    cells = ["seen = []", "def f(x):\n    seen.append(x)\n    raise ValueError(f'asked {x}')"]
    report = session.run(cells, ["seen"])
    assert report["understood"] == {"seen": "[]"}
    probe = {"inside": "autograder.kinds.function.inside.evaluate", "cases": [{"args": [SECRET]}]}
    reply = session.evaluate("f", probe)
    assert reply == {"state": "given", "outcomes": [{"raised": "ValueError"}]}


def test_an_exceptions_own_name_cannot_carry_a_hidden_input(session):
    cells = ["def f(x):\n    raise type('Asked' + x, (Exception,), {})()"]
    session.run(cells, [])
    probe = {
        "inside": "autograder.kinds.function.inside.evaluate",
        "cases": [{"args": [SECRET.replace("-", "_")]}],
    }
    assert session.evaluate("f", probe)["outcomes"] == [{"raised": "Exception"}]


# --- changing


@pytest.mark.parametrize("what", ["numpy.__file__", "IPython.__file__", "autograder.__file__",
                                  "data.__file__", "sys.executable", "os.__file__"])  # fmt: skip
def test_installed_files_cannot_be_changed(lab, what):
    start = "import os, sys, numpy, IPython, autograder, data\n"
    assert lab.error(start + f"open({what}, 'a').write('#')") in REFUSED
    assert lab.error(start + f"os.unlink({what})") in REFUSED
    assert lab.error(start + f"os.rename({what}, 'stolen')") in REFUSED
    folder = f"os.path.dirname({what})"
    assert lab.error(start + f"open({folder} + '/sitecustomize.py', 'w')") in REFUSED


def test_the_course_is_not_changed_through_links_or_paths(lab, course):
    before = tree(course.root)
    code = f"""
import os, shutil
targets = [{str(course.root)!r}, "/course", "../data", "figures.py", "questions"]
for target in targets:
    for action in (
        lambda: open(os.path.join(target, "__init__.py"), "w").write("evil"),
        lambda: open(target, "w").write("evil"),
        lambda: shutil.rmtree(target),
        lambda: os.rename(target, target + ".old"),
        lambda: os.chmod(target, 0o777),
        lambda: os.link(target, "hard"),
    ):
        try: action()
        except OSError: pass
"""
    lab.report(code)
    assert tree(course.root) == before


def test_what_is_patched_is_patched_for_oneself_only(lab):
    code = """
import builtins, json, math, numpy, sympy, sys
from autograder.sandbox.inside import evaluate
from autograder.exchange import wire
numpy.allclose = numpy.isclose = lambda *a, **k: True
builtins.abs = builtins.sum = builtins.len = lambda *a: 0
sympy.simplify = lambda e: 0
evaluate.evaluate = lambda response, probe: {"state": "given", "value": 74}
wire.encode = lambda value: b""
json.dumps = lambda *a, **k: "{}"
math.ceil = math.log = None
sys.modules["numpy"] = None
"""
    # Its own process cannot even answer any more: it hangs or ends, as Python's version has it.
    assert lab.error(code) in ("timeout", "killed")


@pytest.mark.parametrize("target", ["-1", "0", "1", "os.getppid()", "{grader}", "-{grader}"])
def test_no_process_outside_can_be_signalled(lab, target):
    bystander = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    try:
        code = f"import os, signal\nos.kill({target.format(grader=os.getpid())}, signal.SIGKILL)"
        assert lab.error(code) in REFUSED
        code = f"import ctypes\nfound = ctypes.CDLL(None).syscall(62, {bystander.pid}, 9)"
        assert lab.value(code) == "-1"
        assert bystander.poll() is None
    finally:
        bystander.kill()
        bystander.wait()


def test_no_signal_gets_out_through_a_descriptors_owner():
    """By the filter alone, as on kernels whose Landlock does not confine signals."""
    code = """
import fcntl, os, signal, socket, subprocess, sys, time
from autograder.sandbox import lockdown, seccomp
victim = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
attacker = os.fork()
if attacker == 0:
    lockdown.confine(None, seccomp.build_filter(refuse_thread_signals=True))
    here, there = socket.socketpair()
    for command, value in ((fcntl.F_SETSIG, 9), (fcntl.F_SETOWN, victim.pid)):
        try:
            fcntl.fcntl(here, command, value)
        except PermissionError:
            pass
    fcntl.fcntl(here, fcntl.F_SETFL, os.O_ASYNC)
    there.send(b"x")
    os._exit(0)
os.waitpid(attacker, 0)
try:
    print(victim.wait(0.3))
except subprocess.TimeoutExpired:
    print("alive")
victim.kill()
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout == "alive\n"


@pytest.mark.parametrize(
    "call",
    [
        'libc.mount(b"none", b".", b"tmpfs", 0, None)',
        "libc.umount2(b'/usr', 2)",
        "libc.unshare(0x10000000)",  # a user namespace
        "libc.unshare(0x00020000)",
        'libc.chroot(b".")',
        'libc.pivot_root(b".", b".")',
        "libc.setns(0, 0)",
        "libc.syscall(56, 0x10000000 | 17, 0, 0, 0, 0)",  # clone with a new user namespace
        "libc.syscall(435, 0, 0)",  # clone3
        "libc.syscall(272 + 0x40000000, 0x10000000)",  # by its x32 number
        "libc.setuid(0)",
        "libc.reboot(0)",
        "libc.setpriority(0, 1, 19)",
        "libc.personality(0)",
        "libc.syscall(425, 1, 0)",  # io_uring_setup
        "libc.syscall(319, b'm', 0)",  # memfd_create
        "libc.shmget(0, 4096, 0o1666)",
        'libc.mknod(b"dev", 0o60666, 1)',
        "libc.prctl(38, 0, 0, 0, 0)",  # no_new_privs off
        "libc.prctl(4, 0, 0, 0, 0)",  # out of the zygote's sight
        "libc.fcntl(0, 0x5412)",
        'libc.ioctl(0, 0x5412, b"x")',  # typing into a terminal
        "libc.fcntl(os.pipe()[0], 8, os.getpid())",  # F_SETOWN
        "libc.fcntl(os.pipe()[0], 10, 9)",  # F_SETSIG
        "libc.fcntl(os.pipe()[0], 15, (ctypes.c_int * 2)(1, os.getpid()))",  # F_SETOWN_EX
        "libc.ioctl(line.fileno(), 0x8901, pid)",  # FIOSETOWN
        "libc.ioctl(line.fileno(), 0x8902, pid)",  # SIOCSPGRP
        "libc.syscall(275, pipe[0], None, pipe[1], None, 0, 0)",  # splice
        "libc.syscall(206, 1, (ctypes.c_long * 1)())",  # io_setup
    ],
)
@pytest.mark.skipif(os.uname().machine != "x86_64", reason="the numbers are those of x86_64")
def test_the_kernel_refuses(lab, call):
    code = (
        "import ctypes, os, socket\nlibc = ctypes.CDLL(None, use_errno=True)\n"
        "pipe, pid = os.pipe(), ctypes.byref(ctypes.c_int(os.getpid()))\n"
        f"line, other = socket.socketpair()\nfound = {call}"
    )
    assert lab.value(code) == "-1"


def test_no_capability_and_no_new_one(lab):
    code = (
        "import ctypes, os\n"
        "found = ctypes.CDLL(None).prctl(39, 0, 0, 0, 0), os.getuid() != 0, os.geteuid() != 0"
    )
    no_new_privileges, *_ = lab.value(code)[1:-1].split(", ")
    assert no_new_privileges == "1"
    if os.geteuid() == 0:
        assert lab.value(code) == "(1, True, True)"


def test_limits_cannot_be_raised(lab):
    code = "import resource as r\nr.setrlimit(r.RLIMIT_NPROC, (10**6, 10**6))"
    assert lab.error(code) in {"ValueError", "PermissionError"}
    code = "import os, resource as r\nr.prlimit(os.getppid(), r.RLIMIT_CPU, (1, 1))"
    assert lab.error(code) in REFUSED


def test_no_program_can_be_started(lab):
    for program in ("/bin/sh", "/usr/bin/python3", sys.executable):
        assert lab.error(f"import os\nos.execv({program!r}, ['x'])") in REFUSED
    assert lab.error("import subprocess\nsubprocess.run(['ls'])") in REFUSED
    code = (
        "import os\nopen('mine', 'w').write('#!/bin/sh\\n'); os.chmod('mine', 0o755)\n"
        "os.execv('./mine', ['mine'])"
    )
    assert lab.error(code) in REFUSED
