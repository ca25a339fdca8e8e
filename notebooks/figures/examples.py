"""Pictures of the examples worked by hand in chapter 1, with the student's own results."""

import numpy as np

from notebooks.figures.style import (
    BLUE,
    GRAY,
    GREEN,
    LIGHT,
    ORANGE,
    StudentFunction,
    attempt,
    figure,
    not_written,
    note,
    quiet,
    show,
)


def nearest_words(
    descriptors: np.ndarray, words: np.ndarray, assign_words: StudentFunction
) -> None:
    """Draw (N, 2) descriptors and (K, 2) words, each descriptor tied to the word it was given."""
    fig = figure(6, 3.4)
    axes = fig.subplots()
    axes.set_aspect("equal")
    axes.set_xlabel("descriptor, entry 1")
    axes.set_ylabel("descriptor, entry 2")
    axes.grid(color=LIGHT, linewidth=0.5)
    quiet(axes)
    given = attempt(assign_words, descriptors, words)
    if given is None:
        note(axes, not_written(assign_words))
    else:
        for descriptor, word in zip(descriptors, np.asarray(given).tolist(), strict=True):
            axes.plot(*np.array([descriptor, words[word]]).T, color=GREEN, linewidth=2)
    axes.plot(*words.T, "s", color=ORANGE, markersize=11, mec="black", label="words")
    axes.plot(*descriptors.T, "o", color=BLUE, markersize=8, label="descriptors")
    for number, (x, y) in enumerate(words):
        axes.text(x, y - 0.7, f"word {number}", ha="center")
    axes.set_ylim(-1.2, descriptors[:, 1].max() + 0.5)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    show(fig, f"Descriptors tied to their nearest words: {'not yet' if given is None else given}.")


def way_down(
    descriptor: np.ndarray, levels: list[np.ndarray], descend_tree: StudentFunction
) -> None:
    """Draw a tree of two levels over its centres and where a descriptor (2,) ends.

    `levels` holds (k, 2) centres, and the (k * k, 2) below them, row by row.
    """
    fig = figure(8, 2.8)
    axes = fig.subplots()
    axes.set_axis_off()
    branching = len(levels[0])
    given = attempt(descend_tree, descriptor, levels)
    if given is None:
        note(axes, not_written(descend_tree))
    on_way = {(1, given)} | ({(0, given // branching)} if given is not None else set())
    middle = float(levels[0][:, 0].mean())
    for level, centers in enumerate(levels):
        for row, (x, y) in enumerate(centers):
            parent = middle if level == 0 else levels[0][row // branching, 0]
            chosen = (level, row) in on_way
            color = GREEN if chosen else LIGHT
            axes.plot([parent, x], [2 - level, 1 - level], color=color, lw=4 if chosen else 1.5)
            axes.plot(x, 1 - level, "s", color=ORANGE, markersize=13, mec="black", zorder=3)
            label = f"row {row}\n({x:g}, {y:g})"
            if level == len(levels) - 1:
                axes.text(x, 0.8 - level, label, ha="center", va="top")
            else:
                axes.text(x + 0.5, 1.05 - level, label, va="center")
        axes.text(-4, 1 - level, f"levels[{level}]", ha="center", va="center", color=GRAY)
    axes.plot(middle, 2, "ko", markersize=12)
    x, y = descriptor
    axes.plot(x, 2, "*", color=BLUE, markersize=18)
    axes.text(x + 0.4, 2, f"descriptor ({x:g}, {y:g})", va="center")
    axes.set_xlim(-5, 15)
    axes.set_ylim(-0.75, 2.3)
    show(fig, f"A tree of two levels. The descriptor arrives at word {given}.")


def occurrences(
    words_by_image: list[np.ndarray], word_count: int, build_inverted_file: StudentFunction
) -> None:
    """Draw which image has which word (circles), and what the inverted file lists (dots)."""
    fig = figure(6, 2.6)
    axes = fig.subplots()
    for image, words in enumerate(words_by_image):
        axes.plot(words, [image] * len(words), "o", color="white", mec=GRAY, markersize=20, mew=2)
    given = attempt(build_inverted_file, words_by_image, word_count)
    if given is None:
        note(axes, not_written(build_inverted_file))
    for word, images in enumerate(given or []):
        axes.plot([word] * len(images), list(images), "o", color=GREEN, markersize=11)
    axes.set_xticks(range(word_count), [f"word {word}" for word in range(word_count)])
    axes.set_yticks(range(len(words_by_image)), [f"image {i}" for i in range(len(words_by_image))])
    axes.set_xlim(-0.6, word_count - 0.4)
    axes.set_ylim(len(words_by_image) - 0.4, -0.6)
    axes.grid(color=LIGHT)
    axes.set_axisbelow(True)
    axes.set_title("circle: the image has the word; dot: your file lists it", fontsize=10)
    quiet(axes)
    show(fig, f"Which image has which word, and the inverted file: {given}.")
