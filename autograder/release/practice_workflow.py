"""The workflow of a student's repository: it grades on every push, by the key for practice.

Only what the bundle holds is used, so nothing can come out that the student does not have: no
hidden input of the real grading is there.
"""

from __future__ import annotations

from pathlib import PurePosixPath

PATH = PurePosixPath(".github/workflows/practice.yml")
TEXT = """\
# Grades what you push by the key for practice in this folder, and shows it with the commit.
name: practice
on: [push]
permissions:
  contents: read
jobs:
  practice:
    runs-on: ubuntu-latest
    timeout-minutes: 20
    steps:
      - uses: actions/checkout@v4
      - uses: astral-sh/setup-uv@v5
      - run: sudo apt-get update -qq && sudo apt-get install -y -qq bubblewrap
      - name: grade
        # The chapters for practice with their key, beside all that the notebooks import.
        run: |
          course="$RUNNER_TEMP/course"
          cp -r . "$course"
          rm -r "$course/notebooks/questions"
          cp -r practice/. "$course"
          uv run python -m autograder --course "$course" grade notebooks --out "$RUNNER_TEMP/grades" --summary github
"""  # noqa: E501
