"""Landlock governs neither the modes nor the times nor the owners of files: the filter must."""

import pytest
from attacks import Lab

from autograder.course import Course
from autograder.sandbox.launcher import Sandbox, SandboxError

CHANGES = {
    "chmod": "os.chmod('f', 0o777)",
    "chmod of a folder": "os.chmod('.', 0o777)",
    "chmod of an open file": "os.fchmod(os.open('f', os.O_RDONLY), 0o777)",
    "chmod by a descriptor's path": "os.chmod('/proc/self/fd/%d' % os.open('f', os.O_PATH), 0o777)",
    "lchmod": "os.chmod('f', 0o777, follow_symlinks=False)",
    "utime": "os.utime('f', (1, 1))",
    "utime of a link": "os.utime('f', (1, 1), follow_symlinks=False)",
    "utime of an open file": "os.utime(os.open('f', os.O_RDONLY), (1, 1))",
    "chown": "os.chown('f', os.getuid(), os.getgid())",
    "lchown": "os.lchown('f', os.getuid(), os.getgid())",
    "chown of an open file": "os.fchown(os.open('f', os.O_RDONLY), os.getuid(), os.getgid())",
    "truncate": "os.truncate('f', 0)",
    "setxattr": "os.setxattr('f', 'user.a', b'x')",
    "removexattr": "os.removexattr('f', 'user.a')",
    "acl": "os.setxattr('f', 'system.posix_acl_access', b'x')",
}


@pytest.fixture(scope="module")
def reduced_lab(course: Course):
    try:
        sandbox = Sandbox(course, isolation="reduced", seed=1).__enter__()
    except SandboxError as error:
        pytest.skip(f"there is no Landlock on this machine: {error}")
    yield Lab(sandbox)
    sandbox.stop()


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_not_even_the_students_own_file_can_be_changed_in_the_reduced_tier(reduced_lab, change):
    """On their own files, since only there would nothing else than the filter keep them."""
    code = f"""
import os
open('f', 'w').write('abc')
def state():
    return [(s.st_mode, s.st_mtime_ns, s.st_size, s.st_uid) for s in map(os.stat, ('f', '.'))]
before = state()
try:
    {change}
    found = 'kept'
except (PermissionError, NotImplementedError):
    found = 'kept'
except OSError as error:
    found = str(error)
if state() != before:
    found = 'changed'
"""
    assert reduced_lab.value(code) == "kept"


@pytest.mark.parametrize("change", ["setxattr", "chown", "truncate", "acl"])
def test_what_honest_work_never_does_is_refused(reduced_lab, change):
    code = f"""
import os
open('f', 'w').write('abc')
try:
    {CHANGES[change]}
    found = 'done'
except PermissionError:
    found = 'refused'
"""
    assert reduced_lab.value(code) == "refused"


@pytest.mark.parametrize("copy", ["copy", "copy2", "copytree", "move"])
def test_honest_work_copies_its_files(lab, copy):
    code = f"""
import os, shutil
os.mkdir('from')
open('from/f', 'w').write('abc')
shutil.{copy}('from' if {copy!r} == 'copytree' else 'from/f', 'to')
found = open('to/f' if {copy!r} == 'copytree' else 'to').read()
"""
    assert lab.value(code) == "abc"


def test_files_can_still_be_written_emptied_and_moved(reduced_lab):
    code = """
import os, shutil, tempfile, pathlib
with open('f', 'w') as file:
    file.write('abc')
    file.truncate(1)
open('f', 'w').write('abcd')
os.rename('f', 'g')
shutil.copyfile('g', 'h')
pathlib.Path('new').touch()
with tempfile.TemporaryDirectory() as folder:
    pathlib.Path(folder, 'x').write_text('y')
found = open('h').read() + str(sorted(os.listdir('.'))[-1])
"""
    assert reduced_lab.value(code).startswith("abcd")


def test_each_kind_of_isolation_tries_to_change_files_and_to_call_the_kernel(course):
    from autograder.sandbox.tiers import tiers

    for tier in tiers(course):
        works = tier.try_out()
        tier.stop_unused()
        if tier.results:
            assert works, tier.problem
            assert tier.results["change_a_file"]
            assert tier.results["call_the_kernel"]
