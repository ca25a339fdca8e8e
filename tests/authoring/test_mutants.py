"""Mutants: which changes are made of what is right, and what `autograder check` says of them."""

import ast

import pytest

from autograder.authoring.proof import prove_course
from autograder.marking.mutants.edits import edited
from autograder.marking.mutants.formula_edits import edited_formulas

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


def test_arguments_that_may_be_exchanged_are_not():
    assert not any("max(b, a)" in body for body in changes("def f(a, b):\n return max(a, b)"))


def test_a_formula_loses_terms_factors_signs_and_powers():
    made = {text for _, text in edited_formulas("2*a - b**2", ["a", "b"])}
    assert {"2 * a", "a - b ** 2", "2 * a + b ** 2", "2 * a - b", "2 * b - b ** 2"} <= made


def test_a_mutant_that_no_case_tells_is_shown_with_its_change(tiny_course):
    tiny_course.write_notebooks()
    case = '        {"name": "no weights", "args": [[]]},\n'
    tiny_course.replace("solutions/kitchen.py", case, "")
    found = prove_course(tiny_course.root)
    assert found, "without that case, nothing asks for the mean of no weights"
    assert any("if len(weights) == 0 -> if False" in line for line in found)
    assert all("a mutant earns everything" in line for line in found)
    assert all("It passed two equal weights, many weights" in line for line in found)


def test_right_work_in_other_clothes_has_to_earn_everything(tiny_course):
    tiny_course.write_notebooks()
    variants = tiny_course.root / "solutions/variants"
    variants.mkdir()
    lines = ["def mean_weight__sum(weights):", "    return sum(weights)"]
    for style in "abc":
        lines.append(f"def mean_weight__{style}(weights):")
        lines.append("    return sum(w / len(weights) for w in weights)")
    (variants / "kitchen.py").write_text("\n".join(lines))
    found = [line for line in prove_course(tiny_course.root) if "Q1.5" in line]
    assert len(found) == 1
    assert "the variant mean_weight__sum must earn everything, but with seed 1" in found[0]


def test_a_declared_mutant_is_let_pass_and_a_stale_declaration_is_an_error(tiny_course):
    tiny_course.write_notebooks()
    stale = 'equivalent = [{mutant = "return 1 -> return 2", why = "It never was."}]\n'
    tiny_course.replace(ANSWERS, '["Q1.5"]\n', f'["Q1.5"]\n{stale}')
    found = prove_course(tiny_course.root)
    assert found == [
        "Q1.5: there is no mutant 'return 1 -> return 2'; correct or remove it in equivalent."
    ]
