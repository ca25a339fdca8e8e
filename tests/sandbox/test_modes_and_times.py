"""Landlock governs neither the modes nor the times nor the owners of files: the filter must."""

import pytest
from small_course import Lab

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
    """On their own files, since only there would nothing else than the filter refuse it."""
    code = f"""
import os
open('f', 'w').write('abc')
try:
    {change}
    found = 'changed'
except (PermissionError, NotImplementedError):
    found = 'refused'
except OSError as error:
    found = str(error)
"""
    assert reduced_lab.value(code) == "refused"


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
