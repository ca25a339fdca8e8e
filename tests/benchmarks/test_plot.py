from benchmarks.plot import write_plot
from benchmarks.report import OURS, Curve, Row, Section


def test_a_picture_is_drawn_with_and_without_curves(tmp_path):
    rows = [Row("g", "t", OURS, 1.0, 1.0), Row("g", "t", "peer", 5.0, 5.0)]
    curves = [Curve("panel", name, "points", "seconds", (1.0, 10.0), (0.1, 1.0)) for name in "ab"]
    for name, section in {
        "both.png": Section("A", "", rows, curves),
        "ratios.png": Section("A", "", rows),
    }.items():
        write_plot([section], tmp_path / name)
        assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")


def test_qualities_without_a_time_are_left_out_of_the_ratios(tmp_path):
    rows = [Row("g", "t", "peer", extra={"mAP": 0.5})]
    write_plot([Section("A", "", rows)], tmp_path / "empty.png")
    assert (tmp_path / "empty.png").exists()
