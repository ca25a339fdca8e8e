"""Mutants: which changes are made of what is right, and what `autograder check` says of them."""

import ast
import time

import pytest

from autograder.authoring import job_processes
from autograder.authoring.proof import prove_course
from autograder.authoring.proof_by_mutants import prove_by_mutants, tried_styles
from autograder.mutants.code_edits import edited
from autograder.mutants.formula_edits import edited_formulas

ANSWERS = "solutions/answers/kitchen.toml"


def changes(source: str) -> set[str]:
    """The bodies of all mutants of a function, in one line each."""
    tree = ast.parse(source).body[0]
    assert isinstance(tree, ast.FunctionDef)
    return {" ".join(ast.unparse(mutant.body).split()) for _, mutant in edited(tree)}


@pytest.mark.parametrize(
    ("body", "mutant"),
    [
        ("return a < b", "return a <= b"),
        ("return a >= b", "return a > b"),
        ("return a and b", "return a or b"),
        ("return a[1]", "return a[2]"),
        ("return a[1]", "return a[0]"),
        ("return f(a - b)", "return f(a + b)"),
        ("return f(-a)", "return f(a)"),
        ("return g(a, b)", "return g(b, a)"),
        ("return a, b", "return (b, a)"),
        ("return a, b", "return (a, 2 * b)"),
        ("return Line(a, b)", "return Line(2 * a, b)"),
        ("if a:\n  raise ValueError\n return b", "if a: pass return b"),
        ("if a:\n  return 0\n return b", "if False: return 0 return b"),
        ("for x in a:\n  f(x)", "for x in a: f(x) break"),
        ("for x in a:\n  f(x)", "for x in list(a)[:-1]: f(x)"),
        ("return [x for x in a]", "return [x for x in list(a)[1:]]"),
        ("f(a)\n return b", "pass return b"),
    ],
)
def test_each_operator_makes_its_change(body, mutant):
    assert mutant in changes(f"def f(a, b):\n {body}")


def test_docstrings_annotations_and_messages_are_left_alone():
    source = 'def f(a: list[1], b):\n "1 < 2"\n raise ValueError(f"{a - 1}")'
    assert changes(source) == {"'1 < 2' pass"}
    source = 'def f(a):\n def g(b):\n  "1 < 2"\n  h(b)\n g(a)'
    assert all("1 < 2" in body for body in changes(source))


def test_nothing_is_not_doubled():
    made = changes("def f(a):\n return a, 0, 0.0, False")
    assert "return (2 * a, 0, 0.0, False)" in made
    assert "return (a, 1, 0.0, False)" in made
    assert not any("2 * 0" in body for body in made)


def test_arguments_that_may_be_exchanged_are_not():
    assert not any("max(b, a)" in body for body in changes("def f(a, b):\n return max(a, b)"))


def test_a_formula_loses_terms_factors_signs_and_powers():
    made = {text for _, text in edited_formulas("2*a - b**2", ["a", "b"])}
    assert {"2 * a", "a - b ** 2", "2 * a + b ** 2", "2 * a - b", "2 * b - b ** 2"} <= made


def test_a_mutant_that_no_case_tells_is_shown_with_its_change(toy):
    toy.write_notebooks()
    case = '        {"name": "no weights", "args": [[]]},\n'
    toy.replace("solutions/kitchen.py", case, "")
    found = prove_course(toy.root)
    assert found, "without that case, nothing asks for the mean of no weights"
    assert any("if len(weights) == 0 -> if False" in line for line in found)
    assert all("a mutant earns everything" in line for line in found)
    assert all("It passed two equal weights, many weights" in line for line in found)
    declared = """(solutions/answers/kitchen.toml, line 76):
    {mutant = "if len(weights) == 0 -> if False", why = "..."}"""
    assert any(line.endswith(declared) for line in found), found


@pytest.fixture
def variants(toy):
    """The folder for right work in other clothes; all of it is right."""
    folder = toy.root / "solutions/variants"
    folder.mkdir()
    lines = ["from numpy import mean", "def _share(weights):", "    return 1 / len(weights)"]
    for style in "abcd":
        lines.append(f"def {style}(weights):")
        lines.append("    return sum(w * _share(weights) for w in weights)")
    (folder / "mean_weight.py").write_text("\n".join(lines))
    forms = [
        "2*a + 2*b",
        "2*half",
        "(a + b)*2",
        "[a + b + a + b]",
        "sp.expand(2*(a + b))",
        "a+b+half",
    ]
    (folder / "typed.toml").write_text(f'"Q1.4" = {forms}')
    return folder


def test_right_work_in_other_clothes_is_found_tried_and_counted(toy, variants):
    assert prove_by_mutants(toy.load()) == []
    assert list(tried_styles(toy.load())) == [
        "Q1.4 is tried with right work in 6 other styles.",
        "Q1.5 is tried with right work in 4 other styles.",
    ]


def test_right_work_in_other_clothes_has_to_earn_everything(toy, variants):
    with (variants / "mean_weight.py").open("a") as stream:
        stream.write("\ndef total(weights):\n    return sum(weights)\n")
    toy.replace("solutions/variants/typed.toml", "2*half", "half")
    half, total = prove_by_mutants(toy.load())
    assert half.startswith("Q1.4: the variant half must earn everything, but with seed 1 it gets")
    assert total.startswith("Q1.5: the variant total must earn everything, but with seed 1 it gets")


def test_a_variant_that_never_ends_is_told_and_does_not_hold_up_the_others(toy, variants):
    with (variants / "mean_weight.py").open("a") as stream:
        stream.write("\ndef slow(weights):\n    while True:\n        pass\n")
    (problem,) = prove_by_mutants(toy.load())
    assert "the variant slow must earn everything, but with seed 1 it takes more than" in problem


def test_a_job_that_waits_for_a_processor_is_not_taken_for_one_that_never_ends(toy, monkeypatch):
    def seen(used: float, could_run: bool) -> None:
        monkeypatch.setattr(job_processes, "_looked_at", lambda process: (used, could_run))

    seen(3.0, could_run=True)
    process = job_processes._Process(toy.root)
    try:
        time.sleep(0.05)
        assert process.had() == 0.0
        seen(5.0, could_run=True)
        assert process.had() == 2.0
        seen(5.0, could_run=False)
        time.sleep(0.05)
        assert process.had() >= 2.05
    finally:
        process.end()


def test_too_few_styles_and_files_for_no_question_are_told(toy, variants):
    (variants / "typed.toml").write_text('"Q1.4" = ["2*a + 2*b"]')
    (variants / "median.py").write_text("")
    unknown, few = prove_by_mutants(toy.load())
    assert "median.py has the name of no question's function" in unknown
    assert few == "Q1.4: solutions/variants has right work in 1 other styles; write at least 6."


def test_variants_of_a_question_that_is_not_there_are_an_error(toy, variants):
    toy.write_notebooks()
    (variants / "typed.toml").write_text('"Q9.9" = ["1"]')
    (problem,) = prove_course(toy.root)
    assert (
        problem == "solutions/variants/typed.toml, line 1: it has 'Q9.9', which is not a question."
    )


def test_a_declared_mutant_is_let_pass_and_a_stale_declaration_is_an_error(toy):
    toy.write_notebooks()
    stale = 'equivalent = [{mutant = "return 1 -> return 2", why = "It never was."}]\n'
    toy.replace(ANSWERS, '["Q1.5"]\n', f'["Q1.5"]\n{stale}')
    found = prove_course(toy.root)
    assert found == [
        "Q1.5: there is no mutant 'return 1 -> return 2'; correct or remove it in equivalent "
        "(solutions/answers/kitchen.toml, line 77)."
    ]
