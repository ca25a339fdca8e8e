"""A notebook from anybody is read or refused, and nothing in it can harm the grader."""

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.exchange.responses import RECEIPT
from autograder.intake.notebook_reader import Notebook, Unreadable, read_notebook
from tests.intake.handed_in import notebook, read

_json = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3)
    | st.dictionaries(
        st.sampled_from(
            ["cells", "cell_type", "code", "source", "input", "outputs", "data", RECEIPT,
             "question", "response", "worksheets", "nbformat", "responses"]
        ),
        inner | st.sampled_from(["code", "Q1.1"]),
        max_size=5,
    ),
    max_leaves=30,
)  # fmt: skip


def _reads_or_refuses(data: bytes) -> None:
    try:
        found = read_notebook(data, "it")
    except Unreadable as reason:
        assert str(reason).endswith(".")  # noqa: PT017 -- both outcomes are fine
    else:
        assert all(isinstance(cell, str) for cell in found.cells)
        json.dumps(found.receipts, allow_nan=False).encode("utf-8")


def test_only_code_cells_are_read_in_their_order(tmp_path):
    cells = [
        {"cell_type": "markdown", "source": "# no"},
        {"cell_type": "code", "source": ["a = 1\n", "b = 2"]},
        {"cell_type": "raw", "source": "no"},
        {"cell_type": "code", "source": "c = 3"},
    ]
    path = tmp_path / "3_ransac.ipynb"
    path.write_text(json.dumps({"cells": cells, "nbformat": 4}))
    assert read(path).notebooks["ransac"].cells == ["a = 1\nb = 2", "c = 3"]


def test_receipts_are_the_only_outputs_that_are_read():
    def shown(data: object) -> dict[str, object]:
        return {"output_type": "display_data", "data": data}

    receipt = {RECEIPT: {"question": "Q1.1", "response": [True, False]}, "text/html": "score: 100"}
    outputs = [shown({"text/plain": "100 points"}), shown(receipt), shown("junk"), 7]
    cell = {"cell_type": "code", "source": 'ask("Q1.1")', "outputs": outputs}
    read = read_notebook(json.dumps({"cells": [cell]}).encode())
    assert read == Notebook(['ask("Q1.1")'], {"Q1.1": [True, False]}, [])


def test_a_receipt_with_broken_text_or_too_much_of_it_is_cleaned_or_dropped():
    def cell(response: str) -> str:
        receipt = f'{{"{RECEIPT}": {{"question": "Q1", "response": {response}}}}}'
        return f'{{"cell_type": "code", "source": "", "outputs": [{{"data": {receipt}}}]}}'

    surrogate = read_notebook(
        f'{{"cells": [{cell(chr(34) + chr(92) + "ud800" + chr(34))}]}}'.encode()
    )
    assert surrogate.receipts == {"Q1": "?"}
    infinite = read_notebook(f'{{"cells": [{cell("[NaN, 1e999]")}]}}'.encode())
    assert infinite.receipts == {"Q1": [None, None]}
    nested = read_notebook(f'{{"cells": [{cell("[" * 50 + "]" * 50)}]}}'.encode())
    assert nested.receipts == {}
    long = read_notebook(f'{{"cells": [{cell(chr(34) + "x" * 30_000 + chr(34))}]}}'.encode())
    assert long.receipts == {}


def test_the_old_format_with_worksheets_is_read_and_noted():
    old = {"nbformat": 3, "worksheets": [{"cells": [{"cell_type": "code", "input": ["x = 1"]}]}]}
    read = read_notebook(json.dumps(old).encode(), "3_ransac.ipynb")
    assert read.cells == ["x = 1"]
    assert read.notes == ["3_ransac.ipynb is in an old notebook format (nbformat 3)."]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-32"])
def test_other_encodings_and_byte_order_marks_are_read(encoding):
    text = json.dumps({"cells": [{"cell_type": "code", "source": "α = 1"}]}, ensure_ascii=False)
    assert read_notebook(text.encode(encoding)).cells == ["α = 1"]


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "is empty"),
        (b" \n", "is empty"),
        (b"\x89PNG\r\n\x1a\n\xff\xfe\x00", "is not text"),
        (b"[1, 2]", "holds a list of JSON"),
        (b"null", "holds nothing of JSON"),
        (b'"text"', "holds a text of JSON"),
        (b"{}", "has no list of cells"),
        (notebook("x = 1")[:-30], "is cut off"),
        (notebook("x = 1")[:40], "is cut off"),
        (b'{"cells": [}', "is damaged|is cut off"),
        (b'{"cells": oops}' + b" " * 50, "is damaged"),
        (b"[" * 100_000, "holds data that does not belong in a notebook"),
        (b'{"cells": [' + b"9" * 10_000 + b"]}", "holds data that does not belong in a notebook"),
        (notebook(*["x"] * 3000), "more than 2000 code cells"),
        (notebook("x" * 3_000_000), "more than 2 million characters"),
        (b'{"cells": [' + b"[" * 5_000_000, "holds data that does not belong in a notebook"),
    ],
    ids=lambda value: str(value)[:30],  # some are too long for the name of a test
)
def test_what_is_no_notebook_is_refused_with_a_sentence(data, reason):
    with pytest.raises(Unreadable, match=reason) as caught:
        read_notebook(data, "3_ransac.ipynb")
    assert str(caught.value).startswith("3_ransac.ipynb ")
    assert str(caught.value).endswith(".")


def test_sixty_megabytes_of_stored_outputs_do_not_hide_the_code(tmp_path):
    output = {"output_type": "stream", "text": "x" * 60_000_000}
    cell = {"cell_type": "code", "source": "k = 74", "outputs": [output]}
    path = tmp_path / "3_ransac.ipynb"
    path.write_text(json.dumps({"cells": [cell]}))
    assert read(path).notebooks["ransac"].cells == ["k = 74"]


def test_a_notebook_made_to_exhaust_memory_is_refused_and_the_grader_stays_small():
    import resource

    bomb = b'{"cells": [' + b"[]," * 20_000_000 + b"[]]}"
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(Unreadable, match="too large to be read"):
        read_notebook(bomb, "3_ransac.ipynb")
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 300_000  # kB


@settings(max_examples=200, deadline=None)
@given(st.binary(max_size=200))
def test_any_bytes_are_read_as_a_notebook_or_refused(data):
    _reads_or_refuses(data)


@settings(max_examples=300, deadline=None)
@given(_json)
def test_any_json_is_read_as_a_notebook_or_refused(value):
    _reads_or_refuses(json.dumps(value).encode())
    _reads_or_refuses(json.dumps({"cells": [{"cell_type": "code", "outputs": [value]}]}).encode())
