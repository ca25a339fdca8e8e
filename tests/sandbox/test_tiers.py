"""Which isolation is taken: what does not hold is noticed, named, and not used."""

from pathlib import Path

import pytest

from autograder.cli import main
from autograder.sandbox import bubblewrap, landlock, tiers, zygote_start
from autograder.sandbox.doctor import run_doctor
from autograder.sandbox.host import Host
from autograder.sandbox.launcher import SandboxError
from autograder.sandbox.zygote_start import HostError
from tests.classroom import make_course

needs_landlock = pytest.mark.skipif(landlock.version() == 0, reason="no Landlock here")


@pytest.fixture
def nothing_tried_yet(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tiers, "_best", {})


@pytest.fixture
def leaky(monkeypatch: pytest.MonkeyPatch) -> None:
    """Isolation in which everything may be read."""
    start = zygote_start._start

    def start_leaky(place, prefix, set_up, environment):
        return start(place, prefix, {**set_up, "readable": ["/"]}, environment)

    monkeypatch.setattr(zygote_start, "_start", start_leaky)


@pytest.fixture
def refusing_bubblewrap(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A bubblewrap that may not do what it should, as in many containers."""
    program = tmp_path / "bwrap"
    program.write_text(
        "#!/bin/sh\necho 'bwrap: No permissions to create new namespace' >&2\nexit 1"
    )
    program.chmod(0o755)
    monkeypatch.setattr(bubblewrap, "find_bubblewrap", lambda: str(program))


@needs_landlock
def test_a_leak_fails_the_trial_and_is_named(course, leaky):
    tier = tiers.Tier("reduced", False, course)
    assert not tier.try_out()
    assert {name for name, held in tier.results.items() if not held} == {"read_a_file"}
    assert tier.problem == "it does not hold that no file outside can be read"
    assert tier.take_started() is None  # nothing of it is left to be used


@needs_landlock
def test_where_bubblewrap_may_not_work_the_reduced_kind_is_taken(
    course, nothing_tried_yet, refusing_bubblewrap
):
    tier = tiers.best_tier(course)
    tier.stop_unused()
    assert tier.name == "reduced"
    assert "Landlock, seccomp" in tier.text
    assert "missing: a file system and a list of processes of its own" in tier.text


@needs_landlock
def test_a_trial_that_did_not_come_to_an_end_is_made_again(course, nothing_tried_yet, monkeypatch):
    """A machine that stood still for a while has not lost its isolation."""
    tried, start = [], tiers.Tier.start

    def late_at_first(self: tiers.Tier) -> Host:
        tried.append(self.name)
        if len(tried) == 1:
            raise HostError("The sandbox does not answer.")
        return start(self)

    monkeypatch.setattr(tiers.Tier, "start", late_at_first)
    tier = tiers.best_tier(course, "reduced")
    tier.stop_unused()
    assert tried == ["reduced", "reduced"]
    assert tier.problem == ""


@needs_landlock
def test_a_leak_is_not_tried_a_second_time(course, nothing_tried_yet, leaky, monkeypatch):
    tried, start = [], tiers.Tier.start
    monkeypatch.setattr(tiers.Tier, "start", lambda self: [tried.append(1), start(self)][1])
    with pytest.raises(SandboxError, match="no file outside can be read"):
        tiers.best_tier(course, "reduced")
    assert tried == [1]


def test_where_nothing_holds_the_reasons_and_the_remedy_are_given(
    course, nothing_tried_yet, refusing_bubblewrap, leaky
):
    with pytest.raises(SandboxError) as refusal:
        tiers.best_tier(course)
    said = str(refusal.value)
    assert "No permissions to create new namespace" in said
    assert "Allow user namespaces" in said
    assert "--no-sandbox" in said


def test_isolation_that_was_asked_for_by_name_is_not_replaced(
    course, nothing_tried_yet, refusing_bubblewrap
):
    with pytest.raises(SandboxError, match="bubblewrap: The sandbox did not start"):
        tiers.best_tier(course, "bubblewrap")


def test_the_doctor_tells_each_attempt_and_what_grading_will_use(course):
    findings = run_doctor(course)
    assert [finding.name for finding in findings[:3]] == ["bubblewrap", "Landlock", "seccomp"]
    assert findings[-1].name == "grading"
    assert findings[-1].holds
    tried = {finding.name: finding for finding in findings[3:-1]}
    kinds = {name.partition(":")[0] for name in tried if ":" in name}
    assert kinds  # one works, or grading would not
    for kind in kinds:
        for trial in tiers.TRIALS:
            assert tried[f"{kind}: {trial.replace('_', ' ')}"].holds


@needs_landlock
def test_the_doctor_names_what_does_not_hold(course, refusing_bubblewrap, leaky):
    findings = {finding.name: finding for finding in run_doctor(course)}
    leak = findings["reduced: read a file"]
    assert not leak.holds
    assert leak.text == "It does not hold that no file outside can be read."
    assert findings["reduced: start a program"].holds
    assert not findings["bubblewrap"].holds
    assert "No permissions" in findings["bubblewrap"].text
    assert not findings["grading"].holds


def test_the_command_doctor_prints_its_findings(tmp_path, capsys):
    make_course(tmp_path)
    assert main(["--course", str(tmp_path), "doctor"]) == 0
    assert "Grading uses" in capsys.readouterr().out


def test_the_command_doctor_fails_where_grading_would_refuse(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(tiers, "tiers", lambda course: [])
    make_course(tmp_path)
    assert main(["--course", str(tmp_path), "doctor"]) == 1
    assert "refuses" in capsys.readouterr().out
