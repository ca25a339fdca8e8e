"""Marking happens in another process, which alone holds the key."""

from __future__ import annotations

import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from autograder import ask, check
from autograder.student import marker_client


def run(root: Path, code: str) -> str:
    """What a fresh interpreter prints that works in the course's notebooks, as a kernel does."""
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)],
        cwd=root / "notebooks",
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.stderr == ""
    return done.stdout


def test_the_key_and_the_solutions_never_enter_the_kernel(own_orchard: Path):
    printed = run(
        own_orchard,
        """
        import gc, sys
        import sympy as sp
        from autograder import ask, check, progress, submit
        w, l = sp.symbols("w l")
        asked = [ask("Q1").respond([True, True]), ask("Q5").respond([1, 3, 2])]
        asked += [check("Q2", 12), check("Q3", w + l), check("Q4", max), progress(), submit()]
        assert all(asked)
        print([name for name in sys.modules if name.partition(".")[0] == "solutions"])
        keys = {"Answer", "Marker", "Expected", "Statement", "Alternative"}
        kinds = {kind.__name__ for object_ in gc.get_objects() for kind in type(object_).__mro__}
        print(sorted(keys & kinds))
        """,
    )
    assert printed == "[]\n[]\n"


def test_marking_starts_again_when_its_process_has_died(orchard: Path):
    assert check("Q2", 12).mark.status == "right"
    client = marker_client._client
    assert client is not None
    client._process.kill()
    client._process.wait()
    assert check("Q2", 12).mark.status == "right"


def test_an_interrupt_does_not_mix_up_the_next_reply(
    orchard: Path, monkeypatch: pytest.MonkeyPatch
):
    check("Q2", 12)
    read = marker_client.wire.read_message

    def interrupted(*args: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(marker_client.wire, "read_message", interrupted)
    with pytest.raises(KeyboardInterrupt):
        check("Q2", 13)
    monkeypatch.setattr(marker_client.wire, "read_message", read)
    assert ask("Q1").respond([False, True]).mark.question == "Q1"


def test_a_reference_that_prints_does_not_disturb_marking(own_orchard: Path):
    source = own_orchard / "orchard_reference.py"
    source.write_text(
        source.read_text().replace("    return most", "    print('hello'); return most")
    )
    assert check("Q4", max).mark.status == "right"


def test_a_broken_key_is_one_sentence(own_orchard: Path, capsys: pytest.CaptureFixture[str]):
    (own_orchard / "orchard_reference.py").write_text("")
    assert check("Q4", max) is None
    said = capsys.readouterr().out
    assert said.count("\n") == 1
    assert "cannot be loaded" in said


def test_importing_the_course_takes_less_than_half_a_second_beyond_numpy(own_orchard: Path):
    # The processor's time: the clock on the wall also measures what else the machine does.
    code = """
        import time
        import numpy
        start = time.process_time()
        from autograder import ask, check, progress, submit
        print(time.process_time() - start)
        """
    assert min(float(run(own_orchard, code)) for _ in range(3)) < 0.5


def test_importing_the_course_loads_nothing_slow(own_orchard: Path):
    printed = run(
        own_orchard,
        """
        import sys
        from autograder import ask, check, progress, submit
        ask("Q1").respond([True, True])
        slow = {"anywidget", "ipywidgets", "sympy", "matplotlib", "cv2", "IPython", "nbformat"}
        print(sorted(slow & set(sys.modules)))
        """,
    )
    assert printed == "[]\n"
