"""The process that marks for a notebook: ``python -m autograder.marking.marker_process``.

It holds the key where the solutions are at hand, and answers messages on standard input:
``{"do": "probe", "question": id, "variant": n}`` with what the kernel has to evaluate (the variant
is None for the student's own), ``{"do": "mark", ..., "response": ..., "understood": ...}`` with the
mark, ``{"do": "reading", "question": id, "seed": n}`` with functions to read, and
``{"do": "mark_reading", ..., "chosen": n, "returned": n}`` with what is said of the answers.
Otherwise the key does not leave this process, and nothing of the student's runs in it.
"""

from __future__ import annotations

import json
import os
import secrets
import sys
from dataclasses import replace

from autograder.course import load_course
from autograder.errors import AutograderError
from autograder.exchange import wire
from autograder.exchange.identity import VARIANTS
from autograder.exchange.messages import Message
from autograder.language import follow_environment
from autograder.marking.marker import Marker
from autograder.questions.registry import kind_of


def main() -> None:
    """Serve until standard input closes."""
    requests, replies = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    # A reference that prints must not disturb the channel.
    os.dup2(2, 1)
    follow_environment()
    variants = json.loads(os.environ.get(VARIANTS, "{}"))
    marker = Marker(load_course().with_variants(variants), seed=secrets.randbits(32))

    while True:
        try:
            message = wire.read_stream(requests)
        except EOFError:
            return
        replies.write(wire.encode(_answer(marker, message)))
        replies.flush()


def _answer(marker: Marker, message: Message) -> Message:
    id = message["question"]
    try:
        if message["do"] == "reading":
            return {"shown": marker.reading(id, message["seed"]).shown()}
        if message["do"] == "mark_reading":
            reading = marker.reading(id, message["seed"])
            return {"verdict": reading.mark(message["chosen"], message["returned"])}
        if message["variant"] is not None:
            marker = marker.of_variant(id, message["variant"])
        if message["do"] == "probe":
            drawn = marker.drawn(id)
            public = kind_of(marker.course.question(id)).public_cases(drawn)
            return {"probe": {**drawn.probe, **({"tell": public} if public else {})}}
        mark = marker.mark(id, message["response"], message["understood"])
        # The evidence may quote the key, and what is told to a kernel its student can read.
        return {"mark": replace(mark, evidence="").to_dict()}
    except AutograderError as error:
        return {"error": str(error)}


if __name__ == "__main__":
    main()
