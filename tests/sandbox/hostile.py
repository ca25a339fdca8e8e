"""A grammar of hostile submissions: system calls, return values, files, names and timing.

`submission` draws one by a seed. What is drawn is small and ends soon by itself or by a limit; the
only oracle are the invariants in `test_generated_submissions`.
"""

from __future__ import annotations

import random

NUMBERS = ("0", "-1", "1", "2**16", "2**31", "2**63", "2**64 - 1", "10**30", "0.5", "float('nan')")
TEXTS = ("''", "'\\0'", "'\\u202e'", "'\\ud800'", "'~'", "'__class__'", "'x' * 10**5", "'<script>'")
SHAPES = ("(2**28, 0)", "(0, 0)", "(2**20, 0, 3)", "(1,) * 32", "(3,)", "()", "(2**12, 2**8)")
TYPES = ("float", "bool", "complex", "'U3'", "object", "'M8[s]'", "'i1'", "'f2'", "np.longdouble")
PATHS = (
    "'/'",
    "'..'",
    "'/proc/self/mem'",
    "'/proc/1/environ'",
    "'/dev/shm/x'",
    "'/tmp/x'",
    "CANARY",
    "os.path.dirname(CANARY)",
    "np.__file__",
    "autograder.__file__",
    "'f'",
    "'a' * 255",
    "'responses/x.json'",
)
MODES = ("'w'", "'r'", "'a'", "'rb+'")
BYTES = ("b'x' * 100", "bytes(12)", "b'\\xff' * 16")
ATTRIBUTES = ("'fork'", "'exit'", "'array'", "'x'", "'monotonic'")
ENDS = ("os.setsid(); time.sleep(30)", "os._exit(0)", "time.sleep(1)")
SIGNALS = ("0", "9", "11", "15", "19", "14", "27")
PROCESSES = ("0", "-1", "1", "os.getppid()", "os.getpid()", "GRADER")


def submission(seed: int) -> tuple[list[str], list[str]]:
    """The cells of a submission, and the calls of its functions' names."""
    rng = random.Random(seed)
    cells = [
        "import ctypes, gc, os, signal, socket, sys, threading, time\nimport numpy as np\n"
        "import autograder\nlibc = ctypes.CDLL(None)",
        *(_cell(rng) for _ in range(rng.randint(0, 2))),
        "def work(x):\n" + _indented(_body(rng)),
        f"value = {_value(rng, 3)}",
    ]
    return cells, ["work", "value"]


def _cell(rng: random.Random) -> str:
    guard = rng.random() < 0.7
    body = _action(rng)
    return f"try:\n{_indented(body)}\nexcept BaseException:\n    pass" if guard else body


def _body(rng: random.Random) -> str:
    lines = [_action(rng) for _ in range(rng.randint(0, 2))]
    guarded = [f"try:\n{_indented(line)}\nexcept BaseException:\n    pass" for line in lines]
    return "\n".join([*guarded, f"return {_value(rng, 3)}"])


def _value(rng: random.Random, depth: int) -> str:
    inner = lambda: _value(rng, depth - 1)  # noqa: E731
    leaves = (
        lambda: rng.choice(NUMBERS),
        lambda: rng.choice(TEXTS),
        lambda: f"np.zeros({rng.choice(SHAPES)}, {rng.choice(TYPES)})",
        lambda: "None",
        lambda: "object()",
        lambda: "type('T', (float,), {'__eq__': lambda *a: True, '__reduce__': 1})(1)",
        lambda: "(lambda: 0)",
        lambda: f"open({rng.choice(PATHS)}).read()",
        lambda: "repr(locals())",
    )
    if depth == 0 or rng.random() < 0.4:
        return rng.choice(leaves)()
    return rng.choice(
        (
            lambda: f"[{inner()}, {inner()}]",
            lambda: f"{{{rng.choice(TEXTS)}: {inner()}}}",
            lambda: f"[{inner()}] * {rng.choice(('0', '3', '10**4', '10**5'))}",
            lambda: f"({inner()},) * 2",
            lambda: f"type('L', (list,), {{}})([{inner()}])",
            lambda: f"np.array([{inner()}, {inner()}], dtype=object)",
            lambda: f"(lambda l: l.append(l) or l)([{inner()}])",
        )
    )()


def _action(rng: random.Random) -> str:
    number, path, signal = rng.choice(NUMBERS), rng.choice(PATHS), rng.choice(SIGNALS)
    many = rng.choice(("10**5", "10**7", "10**9"))
    return rng.choice(
        (
            # any call to the kernel with any arguments, in a fork that may die of it
            f"if os.fork() == 0:\n    for n in {[rng.randrange(470) for _ in range(12)]}:\n"
            f"        libc.syscall(n, {_arguments(rng)})\n    os._exit(0)",
            f"open({path}, {rng.choice(MODES)}).write('x' * 10)",
            f"os.{rng.choice(('remove', 'mkdir', 'rmdir', 'listdir', 'chdir', 'unlink'))}({path})",
            f"os.{rng.choice(('symlink', 'link', 'rename'))}({path}, {rng.choice(PATHS)})",
            f"os.chmod({path}, {rng.choice(('0', '0o777', '0o4755'))})",
            f"os.utime({path}, (1, 1))",
            f"os.truncate({path}, {rng.choice(('0', '2**20', '2**40'))})",
            f"os.kill({rng.choice(PROCESSES)}, {signal})",
            f"signal.signal({rng.choice(('14', '27', '15', '24', '2'))}, signal.SIG_IGN)",
            f"signal.setitimer(signal.ITIMER_REAL, {rng.choice(('0', '0.01', '1e9'))})",
            f"time.sleep({rng.choice(('0', '0.05', '30'))})",
            "while True: pass" if rng.random() < 0.3 else "sum(range(10**5))",
            "threading.Thread(target=time.sleep, args=(30,), daemon=True).start()",
            f"for _ in range({rng.choice(('1', '5', '40'))}):\n    if os.fork() == 0:\n"
            f"        {rng.choice(ENDS)}",
            f"held = {rng.choice(('bytearray', 'np.ones'))}({many})",
            "pair = [socket.socketpair() for _ in range(50)]\nfor a, b in pair:\n"
            "    a.setblocking(False); a.send(b'x' * 2**18)",
            f"os.write({rng.randrange(12)}, {rng.choice(BYTES)})",
            f"os.close({rng.randrange(12)})",
            f"os.dup2({rng.randrange(12)}, {rng.randrange(12)})",
            "sys.stdout.write('x' * 10**6)",
            f"sys.setrecursionlimit({rng.choice(('10', '10**6'))})",
            f"setattr({rng.choice(('np', 'os', 'gc', 'sys', 'time', 'autograder'))}, "
            f"{rng.choice(ATTRIBUTES)}, None)",
            "gc.get_objects()[-1]",
            rng.choice(("os._exit(0)", "sys.exit()", "ctypes.string_at(1)", "1 / 0")),
            f"globals()[{rng.choice(TEXTS)}] = {number}",
            f"for name in range({rng.choice(('3', '700'))}):\n    open(str(name), 'w').write('y')",
        )
    )


def _arguments(rng: random.Random) -> str:
    return ", ".join(
        rng.choice(("0", "-1", "1", "CANARY.encode()", "b'f'", "2**31 - 1", "4096", "b'user.a'"))
        for _ in range(6)
    )


def _indented(text: str) -> str:
    return "\n".join("    " + line for line in text.splitlines())
