"""`autograder watch` is ended by Ctrl-C, as it says, and then nothing is wrong."""

from autograder.authoring import watch
from autograder.cli import main


def test_ctrl_c_is_how_watching_ends(toy, monkeypatch, capsys):
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(watch, "watch", interrupted)
    assert main(["--course", str(toy.root), "watch"]) == 0
    shown = capsys.readouterr()
    assert shown.out.endswith("Stop with Ctrl-C.\nStopped.\n")
    assert shown.err == ""
