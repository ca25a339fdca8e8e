"""The student bundle: all that students need, nothing of the key, and checks that are right."""

from __future__ import annotations

import json
import math
import os
import pickle
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from packaging.requirements import Requirement

from autograder.course import Course, load_course
from autograder.course.loading import load_object
from autograder.course.right_work import right_work_of
from autograder.errors import CourseError, UsageError
from autograder.kinds.expression.answer import ExpressionAnswer
from autograder.kinds.function.answer import FunctionAnswer
from autograder.marking.snapshots import SnapshotMarker
from autograder.questions.json_arrays import pack, unpack
from autograder.questions.key_formulas import evaluate_formula
from autograder.questions.registry import kind_of
from autograder.release.bundle import release
from autograder.release.leaks import leaks
from autograder.sandbox.inside.evaluate import evaluate
from solutions.lines.line_fitting import Line, fit_line
from tests.classroom import SECRETS, copy_course, make_course, notebook

REPOSITORY = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def course() -> Course:
    return load_course(REPOSITORY)


@pytest.fixture(scope="module")
def bundle(course: Course, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The bundle of the course itself."""
    folder = tmp_path_factory.mktemp("release") / "bundle"
    made = release(course, folder)
    assert made.blind == ()
    return folder


@pytest.fixture(scope="module")
def orchard(tmp_path_factory: pytest.TempPathFactory) -> Course:
    return make_course(tmp_path_factory.mktemp("orchard") / "course")


def everything(folder: Path) -> str:
    return "\n".join(
        path.read_text(encoding="utf-8", errors="replace")
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    )


def test_no_word_of_a_small_course_s_key_is_in_its_bundle(orchard: Course, tmp_path: Path):
    release(orchard, tmp_path / "bundle")
    text = everything(tmp_path / "bundle")
    for secret in SECRETS:
        assert secret not in text
    assert "Rows times trees in a row." in text  # hints are for students


def test_nothing_of_the_real_key_is_in_the_real_bundle(course: Course, bundle: Path):
    # Written again without the release's own search: whole texts, as they stand in the key.
    text = everything(bundle)
    escaped = json.dumps(text)
    for id, answer in course.key.items():
        question = course.question(id)
        for secret in kind_of(question).secrets(question, answer):
            if len(secret) >= 16:
                assert secret not in text
                assert json.dumps(secret)[1:-1] not in escaped
    assert not (bundle / "solutions").exists()
    assert not (bundle / "notebooks/source").exists()
    assert not list(bundle.rglob("*answers*.toml"))


def test_the_notebooks_are_the_untouched_ones(course: Course, bundle: Path):
    for path in sorted((bundle / "notebooks").glob("*.ipynb")):
        cells = json.loads(path.read_text())["cells"]
        code = [cell for cell in cells if cell["cell_type"] == "code"]
        assert code
        assert all(cell["outputs"] == [] for cell in code)
        assert not any(".respond(" in "".join(cell["source"]) for cell in code)
    names = {path.name for path in (bundle / "notebooks").glob("*.ipynb")}
    assert names == {path.name for path in (REPOSITORY / "notebooks").glob("*.ipynb")}


def test_a_leak_stops_the_release(orchard: Course, tmp_path: Path):
    leaky = copy_course(orchard, tmp_path / "course")
    (leaky.root / "data").mkdir()
    (leaky.root / "data/notes.md").write_text(
        "Mind: Cones grow\n  on conifers, the secret of the orchard."
    )
    with pytest.raises(CourseError, match=r"Nothing was released: data/notes\.md"):
        release(leaky, tmp_path / "bundle")
    assert not (tmp_path / "bundle").exists()


def test_a_reference_that_was_copied_into_the_data_is_found(orchard: Course, tmp_path: Path):
    (tmp_path / "bundle/data").mkdir(parents=True)
    (tmp_path / "bundle/data/x.py").write_text(
        "def f(weights):\n"
        "  most = weights[0]\n"
        "  for weight in weights:  # in another layout, with other comments\n"
        "      most = max( most, weight )\n"
    )
    assert any("Q4" in said for said in leaks(orchard, tmp_path / "bundle"))


def test_what_is_not_on_the_list_stays_here(orchard: Course, tmp_path: Path):
    cluttered = copy_course(orchard, tmp_path / "course")
    (cluttered.root / "notebooks/responses").mkdir()
    (cluttered.root / "notebooks/responses/orchard.json").write_text("{}")
    (cluttered.root / "notebooks/mine.txt").write_text("kept to myself")
    (cluttered.root / "grades").mkdir()
    (cluttered.root / "grades/grades.csv").write_text("kept to myself")
    (cluttered.root / "data").mkdir()
    (cluttered.root / "data/key.pkl").write_text("kept to myself")
    (cluttered.root / "data/.env").write_text("kept to myself")
    (cluttered.root / "data/link.csv").symlink_to(cluttered.root / "grades/grades.csv")
    made = release(cluttered, tmp_path / "bundle")
    assert "kept to myself" not in everything(tmp_path / "bundle")
    reasons = {str(entry.path): entry.reason for entry in made.left_out}
    assert reasons.keys() == {"notebooks/mine.txt", "data/key.pkl", "data/.env", "data/link.csv"}
    assert "move it to data" in reasons["notebooks/mine.txt"]
    assert "link" in reasons["data/link.csv"]
    assert "pickle" in reasons["data/key.pkl"]
    assert "hidden" in reasons["data/.env"]


@pytest.mark.parametrize("name", ["scan.bag", "table.parquet", "notes", "film.MP4", "a/b.jsonl"])
def test_data_go_along_whatever_their_ending(orchard: Course, tmp_path: Path, name: str):
    course = copy_course(orchard, tmp_path / "course")
    path = course.root / "data" / name
    path.parent.mkdir(parents=True)
    path.write_bytes(b"\x00\xff apples")
    made = release(course, tmp_path / "bundle")
    assert (tmp_path / "bundle/data" / name).read_bytes() == b"\x00\xff apples"
    assert made.left_out == ()


def test_a_pickle_is_known_by_what_it_holds(orchard: Course, tmp_path: Path):
    course = copy_course(orchard, tmp_path / "course")
    (course.root / "data").mkdir()
    (course.root / "data/model.bin").write_bytes(pickle.dumps({"apples": 3}))
    made = release(course, tmp_path / "bundle")
    assert [str(entry.path) for entry in made.left_out] == ["data/model.bin"]


def test_an_answer_is_found_in_a_file_of_any_ending(orchard: Course, tmp_path: Path):
    course = copy_course(orchard, tmp_path / "course")
    (course.root / "data").mkdir()
    secret = b"Cones grow on conifers, the secret of the orchard."
    (course.root / "data/scan.bag").write_bytes(b"\xff\x00" + secret + b"\x00\xff")
    with pytest.raises(CourseError, match=r"data/scan\.bag"):
        release(course, tmp_path / "bundle")


def test_a_course_without_a_pyproject_gives_a_bundle_that_starts(orchard: Course, tmp_path: Path):
    course = copy_course(orchard, tmp_path / "course")
    (course.root / "pyproject.toml").unlink(missing_ok=True)
    release(course, tmp_path / "bundle")
    project = tomllib.loads((tmp_path / "bundle/pyproject.toml").read_text())["project"]
    names = {Requirement(entry).name for entry in project["dependencies"]}
    assert {"anywidget", "numpy", "sympy", "filelock"} <= names
    assert project["optional-dependencies"]["lab"]
    assert "progress" not in run_in(tmp_path / "bundle", "from autograder import ask; ask('Q1')")


def test_the_readme_names_the_course_s_own_functions(course: Course, bundle: Path):
    readme = (bundle / "README.md").read_text()
    named = re.findall(r'(?:ask|check)\("(Q[\w.]+)"(?:, (\w+))?\)', readme)
    assert len(named) >= 3
    for id, name in named:
        assert (course.question(id).name or "") == name


def test_a_folder_that_holds_something_is_never_written_to(orchard: Course, tmp_path: Path):
    (tmp_path / "bundle").mkdir()
    (tmp_path / "bundle/mine").write_text("mine")
    with pytest.raises(UsageError, match="not empty"):
        release(orchard, tmp_path / "bundle")
    assert (tmp_path / "bundle/mine").read_text() == "mine"


def test_students_install_what_notebooks_need_and_no_more(bundle: Path):
    table = tomllib.loads((bundle / "pyproject.toml").read_text())
    names = {entry.partition(">")[0] for entry in table["project"]["dependencies"]}
    for needed in ("numpy", "sympy", "matplotlib", "anywidget", "filelock"):
        assert needed in names
    for unwanted in ("nbval", "jupytext", "jupyterlab", "ipykernel", "course-autograder"):
        assert unwanted not in names
    lab = table["project"]["optional-dependencies"]["lab"]
    assert any(entry.startswith("jupyterlab>") for entry in lab)
    assert "scripts" not in table["project"]


COLAB = {"python_version": "3.12", "sys_platform": "linux", "platform_machine": "x86_64"}


def test_a_hosted_kernel_is_not_replaced(bundle: Path):
    """Colab brings IPython 7.34 and ipykernel 6.17, and restarts its kernel for no student."""
    table = tomllib.loads((bundle / "pyproject.toml").read_text())
    for entry in table["project"]["dependencies"]:
        requirement = Requirement(entry)
        theirs = {"ipython": "7.34.0", "ipykernel": "6.17.1", "numpy": "2.0.2"}
        marker = requirement.marker
        if requirement.name in theirs and (not marker or marker.evaluate(COLAB)):
            assert requirement.specifier.contains(theirs[requirement.name]), entry


# The checks in the bundle


def function_ids() -> list[tuple[str, str]]:
    """Every function question with each of its known mistakes."""
    return [
        (id, mistake.function)
        for id, answer in load_course(REPOSITORY).key.items()
        if isinstance(answer, FunctionAnswer)
        for mistake in answer.alternatives
    ]


@pytest.fixture(scope="module")
def marker(bundle: Path) -> SnapshotMarker:
    return SnapshotMarker(load_course(bundle))


def test_every_reference_is_right_in_the_bundle(course: Course, marker: SnapshotMarker):
    for id, answer in course.key.items():
        if isinstance(answer, FunctionAnswer):
            reference = load_object(answer.reference, course.root)
            mark = marker.mark(id, evaluate(reference, marker.probe(id)))
            assert (mark.status, mark.credit) == ("right", 1.0)
            assert "after you hand in" in mark.feedback


@pytest.mark.parametrize(("id", "mistake"), function_ids())
def test_every_known_mistake_is_wrong_in_the_bundle(
    course: Course, marker: SnapshotMarker, id: str, mistake: str
):
    with np.errstate(all="ignore"):
        reply = evaluate(load_object(mistake, course.root), marker.probe(id))
    mark = marker.mark(id, reply)
    assert mark.status == "wrong"
    assert "expected is" in mark.feedback


def test_expressions_are_right_or_wrong_as_the_key_says(course: Course, marker: SnapshotMarker):
    checked = 0
    for id, answer in course.key.items():
        if isinstance(answer, ExpressionAnswer):
            points = marker.probe(id)["points"]
            count = len(next(iter(points.values())))
            for entry in answer.alternatives:
                values = np.broadcast_to(evaluate_formula(entry.expression, points), (count,))
                mark = marker.mark(id, {"state": "given", "values": values.astype(complex)})
                assert mark.status == ("wrong" if entry.is_mistake else "right"), (id, entry.name)
                checked += 1
    assert checked > 10


def test_choices_and_numbers_are_recorded(course: Course, marker: SnapshotMarker):
    for id, question in course.questions.items():
        if question.kind in ("true_false", "order"):
            assert marker.mark(id, [True]).status == "recorded"
        if question.kind == "number":
            assert marker.mark(id, {"state": "given", "value": 1}).status == "recorded"


def test_a_hint_shows_the_failing_example(marker: SnapshotMarker):
    reply = evaluate(lambda p, w, s: 3, marker.probe("Q3.3"))
    said = marker.mark("Q3.3", reply).feedback
    assert "required_iterations(0.99, 0.5, 2) gives 3; expected is 17." in said


@pytest.mark.parametrize(
    "response",
    [
        lambda *a, **k: None,
        lambda *a, **k: "\x1b[31m",
        lambda *a, **k: [[[[]]]],
        lambda *a, **k: 1 / 0,
        lambda *a, **k: float("nan"),
        lambda *a, **k: object(),
    ],
)
def test_anything_a_function_may_return_gets_a_plain_sentence(
    marker: SnapshotMarker, response: object
):
    for id in ("Q2.3", "Q3.3"):
        mark = marker.mark(id, evaluate(response, marker.probe(id)))
        assert mark.status == "wrong"
        assert mark.feedback.isprintable()


def in_degrees(points, weights=None):
    r, alpha = fit_line(points, weights)
    return Line(r, math.degrees(alpha))


def in_degrees_and_exchanged(points, weights=None):
    r, alpha = fit_line(points, weights)
    return math.degrees(alpha), r


@pytest.mark.parametrize(
    ("response", "name"),
    [
        (in_degrees, "degrees (second result)"),
        (in_degrees_and_exchanged, "other order, and degrees (second result)"),
    ],
)
def test_a_bundle_names_a_wrong_function_by_its_examples(
    marker: SnapshotMarker, response: object, name: str
):
    mark = marker.mark("Q2.3", evaluate(response, marker.probe("Q2.3")))
    assert (mark.status, mark.alternative, mark.credit) == ("wrong", name, 0)
    assert mark.feedback.startswith("It looks as if ")


def test_a_bundle_names_a_wrong_formula_by_its_values(marker: SnapshotMarker):
    alpha, x_c, y_c = sp.symbols("alpha x_c y_c", real=True)
    right = x_c * sp.cos(alpha) + y_c * sp.sin(alpha)
    for factor, name in ((-1, "wrong sign"), (2, "twice"), (1, None)):
        mark = marker.mark("Q2.2b", evaluate(factor * right, marker.probe("Q2.2b")))
        assert mark.alternative == name


@pytest.mark.parametrize(("id", "mistake"), function_ids())
def test_a_bundle_names_every_public_mistake_of_a_function_as_the_key_does(
    course: Course, marker: SnapshotMarker, id: str, mistake: str
):
    (entry,) = [e for e in course.key[id].alternatives if getattr(e, "function", "") == mistake]
    with np.errstate(all="ignore"):
        mark = marker.mark(id, evaluate(load_object(mistake, course.root), marker.probe(id)))
    assert entry.in_bundle
    assert mark.alternative == entry.name
    assert mark.feedback.startswith(entry.feedback)


def test_a_bundle_names_every_public_mistake_of_a_formula(course: Course, marker: SnapshotMarker):
    named = 0
    for id, answer in course.key.items():
        for entry in answer.alternatives if isinstance(answer, ExpressionAnswer) else ():
            if not entry.in_bundle:
                continue
            points = marker.probe(id)["points"]
            values = np.broadcast_to(evaluate_formula(entry.expression, points), (12,))
            mark = marker.mark(id, {"state": "given", "values": values.astype(complex)})
            # A sign lost with arctan and with atan2 is one mistake: only the feedback counts.
            assert (mark.feedback.startswith(entry.feedback), mark.status) == (True, "wrong")
            named += 1
    assert named > 40


def test_the_hill_is_named_and_the_period_said(marker: SnapshotMarker):
    S_xx, S_yy, S_xy = sp.symbols("S_xx S_yy S_xy", real=True)
    valley = sp.atan2(-2 * S_xy, S_yy - S_xx) / 2
    for turned, words in ((sp.pi, "Right at"), (sp.pi / 2, "on the hill, for every set of points")):
        said = marker.mark("Q2.2f2", evaluate(valley + turned, marker.probe("Q2.2f2"))).feedback
        assert words in said
    assert "or that plus a multiple of π" in said
    plain = sp.atan(-2 * S_xy / (S_yy - S_xx)) / 2
    said = marker.mark("Q2.2f2", evaluate(plain, marker.probe("Q2.2f2"))).feedback
    assert "stationary angle, but not always the valley" in said
    assert re.search(r"It is right at \d+ of the 12 points of this check\.", said)


def test_a_formula_that_holds_what_was_to_be_solved_for_is_told(marker: SnapshotMarker):
    points = marker.probe("Q2.2b")["points"]
    mark = marker.mark("Q2.2b", {"state": "given", "values": points["r"].astype(complex)})
    assert "still depends on r" in mark.feedback
    assert mark.alternative == "depends on r"


def lever_only(points, sigma):
    """A wrong covariance that nobody foresaw: only the lever's part, and its sign."""
    return sigma**2 * np.array([[9.0, -2.0], [-2.0, 0.7]])


def no_images(image_words, word_count):
    return [[0] for _ in range(word_count)]


def test_what_is_far_off_is_wrong_and_not_left_open(marker: SnapshotMarker):
    for id, response in (("Q2.4", lever_only), ("Q1.5", no_images)):
        mark = marker.mark(id, evaluate(response, marker.probe(id)))
        assert mark.status == "wrong"
        assert "Recorded" not in mark.feedback


def test_an_example_of_each_kind_of_input_that_fails_is_shown(marker: SnapshotMarker):
    reply = evaluate(lambda p, w, s: round(math.log(1 - p) / math.log(1 - w)), marker.probe("Q3.3"))
    said = marker.mark("Q3.3", reply).feedback
    assert said.count("; expected is ") == 3


def test_an_iteration_cannot_be_run_in_part(course: Course, marker: SnapshotMarker):
    given = {"state": "given", "value": 12.34}
    for id in ("Q3.2.1", "Q3.2.5"):
        mark = marker.mark(id, given)
        assert mark.status == "recorded"
        assert "a whole number is asked for" in mark.feedback
        assert "round up" in mark.feedback
        whole = marker.mark(id, {"state": "given", "value": 12})
        assert whole.feedback == "Recorded. It will be marked after you hand in."
    assert "from 0 to 1" in marker.mark("Q3.2.4", given).feedback


def test_an_exception_in_a_bundle_comes_with_its_message(course: Course, marker: SnapshotMarker):
    def fails(p, w, s):
        raise KeyError("no such share")

    reply = evaluate(fails, marker.probe("Q3.3"))
    assert reply["told"]["message"] == "'no such share'"


def test_a_bundle_gives_right_work_in_other_clothes_no_name(course: Course, marker: SnapshotMarker):
    for id in ("Q1.5", "Q2.3", "Q2.4", "Q3.3", "Q3.4", "Q3.5"):
        for style, function in right_work_of(course, course.question(id)).items():
            mark = marker.mark(id, evaluate(function, marker.probe(id)))
            assert mark.alternative is None, f"{id} {style}: {mark.feedback}"
            assert mark.status in ("right", "recorded"), f"{id} {style}: {mark.feedback}"


def test_a_question_may_opt_out_of_being_checked(orchard: Course, tmp_path: Path):
    changed = copy_course(orchard, tmp_path / "course")
    path = changed.root / "solutions/answers/orchard.toml"
    path.write_text(path.read_text().replace('["Q4"]\n', '["Q4"]\nsnapshot = false\n'))
    release(load_course(changed.root), tmp_path / "bundle")
    marker = SnapshotMarker(load_course(tmp_path / "bundle"))
    assert marker.mark("Q4", evaluate(max, marker.probe("Q4"))).status == "recorded"
    assert "expected" not in (tmp_path / "bundle/notebooks/snapshots/orchard.json").read_text()

    def stub(weights):
        raise NotImplementedError

    assert marker.mark("Q4", evaluate(stub, marker.probe("Q4"))).status == "not attempted"


def test_no_hidden_input_that_is_always_the_same_is_shown(orchard: Course, tmp_path: Path):
    changed = copy_course(orchard, tmp_path / "course")
    path = changed.root / "orchard_reference.py"
    path.write_text(
        path.read_text().replace(
            "    return [\n", '    return [\n        {"name": "fixed", "args": [[777.25, 3.0]]},\n'
        )
    )
    # In a process of its own: the module of this name is loaded here already.
    code = (
        "import sys; from pathlib import Path; from autograder.course import load_course;"
        "from autograder.release.bundle import release;"
        "release(load_course(Path(sys.argv[1])), Path(sys.argv[2]))"
    )
    subprocess.run(
        [sys.executable, "-c", code, str(changed.root), str(tmp_path / "bundle")], check=True
    )
    text = (tmp_path / "bundle/notebooks/snapshots/orchard.json").read_text()
    assert "777.25" not in text
    assert "251.5" in text or "120.0" in text


def test_plain_data_survive_packing():
    value = {
        "a": np.array([[1.5, np.inf]]),
        "b": np.array([], dtype=np.int32),
        "c": np.array([1 + 2j]),
        "d": [1, "x", None, True, {"rng": 3}],
    }
    found = unpack(json.loads(json.dumps(pack(value))))
    for name in "abc":
        np.testing.assert_array_equal(found[name], value[name])
    assert found["d"] == value["d"]


def test_a_damaged_snapshot_is_said(orchard: Course, tmp_path: Path):
    release(orchard, tmp_path / "bundle")
    (tmp_path / "bundle/notebooks/snapshots/orchard.json").write_text("{")
    with pytest.raises(CourseError, match="is damaged"):
        SnapshotMarker(load_course(tmp_path / "bundle"))


# Practice


def test_a_practised_chapter_brings_its_key_and_no_other(course: Course, tmp_path: Path):
    made = release(course, tmp_path / "bundle", ["line_fitting"])
    practice = {str(path) for path in made.files if path.parts[0] == "practice"}
    assert "practice/solutions/answers/line_fitting.toml" in practice
    assert not any("ransac" in name for name in practice)
    keyed = load_course(tmp_path / "bundle/practice")
    assert keyed.key.keys() == {q.id for q in course.chapter("line_fitting").questions}


def test_a_chapter_whose_key_answers_another_one_is_not_practised_alone(
    course: Course, tmp_path: Path
):
    with pytest.raises(UsageError, match="practise line_fitting too"):
        release(course, tmp_path / "bundle", ["ransac"])
    assert not (tmp_path / "bundle").exists()


def test_practice_gives_full_feedback_in_the_bundle(course: Course, tmp_path: Path):
    release(course, tmp_path / "bundle", ["ransac", "line_fitting"])
    code = (
        "from autograder import ask, check\n"
        "print(check('Q3.2.1', 14))\n"
        "print(check('Q3.2.1', 74))\n"
        "print(ask('Q1.1').respond([True, True, True, True]))\n"
    )
    said = run_in(tmp_path / "bundle", code)
    assert "A line needs two inliers" in said
    assert "2 of 2 points" in said
    assert "Q1.1 recorded" in said


def test_an_unknown_chapter_is_refused(course: Course, tmp_path: Path):
    with pytest.raises(UsageError, match="no chapter 'cooking'"):
        release(course, tmp_path / "bundle", ["cooking"])


# In use


def run_in(bundle: Path, code: str) -> str:
    """What a kernel in the bundle's notebooks would print."""
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith("AUTOGRADER")
    }
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=bundle / "notebooks",
        env={**environment, "PYTHONPATH": str(bundle)},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout


def test_what_is_submitted_there_is_marked_here_as_it_was_meant(orchard: Course, tmp_path: Path):
    """All right, by the bundle's own code: the grader agrees in every point."""
    from autograder.grading.submission import grade_contents
    from autograder.intake.submissions import Submission, read_submission
    from autograder.marking.marker import Marker
    from autograder.sandbox.launcher import Sandbox

    release(orchard, tmp_path / "bundle")
    cells = [
        "from autograder import ask, check, progress, submit",
        'ask("Q1").respond([False, True])',
        'trees = 3 * 4\ncheck("Q2", trees)',
        "import sympy as sp\nw, l = sp.symbols('w l')",
        "hedge = 2 * w + 2 * l\nprint(check('Q3', hedge))",
        "def heaviest(weights):\n    return max(weights)\nprint(check('Q4', heaviest))",
        "print(submit())",
    ]
    (tmp_path / "bundle/notebooks/3_orchard.ipynb").write_text(notebook(cells[:-1]))
    said = run_in(tmp_path / "bundle", "\n".join(cells))
    assert "Q3 right" in said
    assert "Q4 right" in said
    assert "All 4 questions are answered" in said
    contents = read_submission(
        Submission("ada", tmp_path / "bundle/notebooks/submission.zip"), orchard.settings
    )
    with Sandbox(orchard, "none") as sandbox:
        marks = grade_contents(contents, Marker(orchard, 1), sandbox)
    assert [mark.status for mark in marks] == ["right"] * 4
