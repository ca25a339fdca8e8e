"""Right functions of chapter 1 in many styles, and slips that make them wrong.

`STYLES` are right cells, by question. `SLIPS` names what a slip breaks that prompt or docstring
promise, the place of the style in which it is made, and what is exchanged there (old, new, ...).
"""

# ruff: noqa: E501 (students' lines are as long as they are)

STYLES = {
    "Q1.3": [
        """
def assign_words(descriptors, words):
    return np.linalg.norm(descriptors[:, None] - words[None], axis=2).argmin(axis=1)
""",
        """
def assign_words(descriptors, words):
    nearest = []
    for descriptor in descriptors:
        best, where = math.inf, 0
        for i, word in enumerate(words):
            d = math.dist(descriptor, word)
            if d < best:
                best, where = d, i
        nearest.append(where)
    return nearest
""",
        """
def assign_words(descriptors, words):
    best = np.full(len(descriptors), np.inf)
    index = np.zeros(len(descriptors), dtype=int)
    for k in range(0, len(words)):
        d = ((descriptors - words[k]) ** 2).sum(axis=1)
        index[d < best] = k
        best = np.minimum(best, d)
    return index
""",
        """
def assign_words(descriptors, words):
    X, W = np.asarray(descriptors, float), np.asarray(words, float)
    score = X @ W.T - (W ** 2).sum(axis=1) / 2
    return np.argmax(score, axis=1)
""",
        """
def assign_words(descriptors, words):
    def nearest(x):
        return min(range(len(words)), key=lambda k: sum((a - b) ** 2 for a, b in zip(x, words[k])))
    return np.array([nearest(x) for x in descriptors], dtype=np.int32)
""",
        """
def assign_words(descriptors, words):
    diff = descriptors[:, np.newaxis, :] - words
    squares = np.einsum("nkd,nkd->nk", diff, diff)
    return np.argsort(squares, axis=1, kind="stable")[:, 0]
""",
        """
import cv2
def assign_words(descriptors, words):
    if len(descriptors) == 0:
        return np.array([], dtype=int)
    matches = cv2.BFMatcher(cv2.NORM_L2).match(np.float32(descriptors), np.float32(words))
    return np.array([m.trainIdx for m in matches])
""",
    ],
    "Q1.4": [
        """
def descend_tree(descriptor, levels):
    k, node = len(levels[0]), 0
    for level in levels:
        first = k * node
        children = level[first:first + k]
        node = first + int(np.argmin(np.linalg.norm(children - descriptor, axis=1)))
    return node
""",
        """
def descend_tree(descriptor, levels):
    k = len(levels[0])
    def below(depth, node):
        if depth == len(levels):
            return node
        return below(depth + 1, min(range(k * node, k * node + k), key=lambda i: math.dist(levels[depth][i], descriptor)))
    return below(0, 0)
""",
        """
def descend_tree(descriptor, levels):
    k, d = levels[0].shape
    node = 0
    for level in levels:
        group = level.reshape(-1, k, d)[node]
        node = node * k + ((group - descriptor) ** 2).sum(axis=1).argmin()
    return node
""",
        """
def descend_tree(descriptor, levels):
    branching = len(levels[0])
    path = []
    for level in levels:
        start = 0
        for step in path:
            start = (start + step) * branching
        best = None
        for child in range(branching):
            d = 0.0
            for a, b in zip(level[start + child], descriptor):
                d += (a - b) ** 2
            if best is None or d < best[0]:
                best = (d, child)
        path.append(best[1])
    word = 0
    for step in path:
        word = word * branching + step
    return word
""",
        """
def descend_tree(descriptor, levels):
    k = len(levels[0])
    allowed = np.ones(k, bool)
    for level in levels:
        d = np.sum((level - descriptor) ** 2, axis=1)
        if len(allowed) != len(level):
            allowed = np.repeat(allowed, k)
        d[~allowed] = np.inf
        node = np.argmin(d)
        allowed = np.arange(len(level)) == node
    return node
""",
        """
def descend_tree(descriptor, levels):
    k = levels[0].shape[0]
    node = np.int64(0)
    depth = 0
    while depth < len(levels):
        children = np.split(levels[depth], len(levels[depth]) // k)[node]
        offset = np.argmax(children @ descriptor - (children * children).sum(axis=-1) / 2)
        node = k * node + offset
        depth += 1
    return int(node)
""",
    ],
    "Q1.5": [
        """
def build_inverted_file(words_by_image, word_count):
    lists = [[] for _ in range(word_count)]
    for image, words in enumerate(words_by_image):
        for word in set(words.tolist()):
            lists[word].append(image)
    return lists
""",
        """
def build_inverted_file(words_by_image, word_count):
    lists = [[] for _ in range(word_count)]
    for i in range(len(words_by_image)):
        for w in words_by_image[i]:
            if i not in lists[w]:
                lists[w].append(i)
    return lists
""",
        """
def build_inverted_file(words_by_image, word_count):
    return [[i for i, words in enumerate(words_by_image) if w in words] for w in range(word_count)]
""",
        """
def build_inverted_file(words_by_image, word_count):
    has = np.zeros((len(words_by_image), word_count), bool)
    for row, words in zip(has, words_by_image):
        row[words] = True
    return [list(np.flatnonzero(column)) for column in has.T]
""",
        """
from collections import defaultdict
def build_inverted_file(words_by_image, word_count):
    images = defaultdict(set)
    for i, words in enumerate(words_by_image):
        for w in words:
            images[int(w)].add(i)
    return [sorted(images[w]) for w in range(word_count)]
""",
        """
def build_inverted_file(words_by_image, word_count):
    lists = [[] for _ in range(word_count)]
    for image in reversed(range(len(words_by_image))):
        for word in np.unique(words_by_image[image]):
            lists[word] += [image]
    return lists
""",
        """
def build_inverted_file(words_by_image, word_count):
    lists = []
    for _ in range(word_count):
        lists.append([])
    for image, words in enumerate(words_by_image):
        counts = np.bincount(words, minlength=word_count)
        for word, count in enumerate(counts):
            if count > 0:
                lists[word].append(image)
    return lists
""",
    ],
    "Q1.6": [
        """
def count_votes(query_words, inverted_file, image_count):
    votes = np.zeros(image_count, dtype=int)
    for word in query_words:
        np.add.at(votes, np.array(inverted_file[word], dtype=int), 1)
    return votes
""",
        """
def count_votes(query_words, inverted_file, image_count):
    voted = [image for word in query_words for image in inverted_file[word]]
    return np.bincount(np.array(voted, dtype=int), minlength=image_count)
""",
        """
from collections import Counter
def count_votes(query_words, inverted_file, image_count):
    votes = Counter()
    for word in query_words:
        votes.update(inverted_file[word])
    return np.array([votes[i] for i in range(image_count)])
""",
        """
def count_votes(query_words, inverted_file, image_count):
    return [sum(i in inverted_file[w] for w in query_words) for i in range(image_count)]
""",
        """
def count_votes(query_words, inverted_file, image_count):
    table = np.zeros((len(inverted_file), image_count), int)
    for word, images in enumerate(inverted_file):
        table[word, images] = 1
    return np.bincount(query_words, minlength=len(inverted_file)) @ table
""",
        """
def count_votes(query_words, inverted_file, image_count):
    votes = np.zeros(image_count, dtype=np.int64)
    words, counts = np.unique(query_words, return_counts=True)
    for word, count in zip(words, counts):
        for image in inverted_file[word]:
            votes[image] += count
    return votes
""",
    ],
    "Q1.7": [
        """
def idf_weights(histograms):
    M = len(histograms)
    weights = []
    for column in np.transpose(histograms):
        images = sum(1 for count in column if count > 0)
        weights.append(math.log(M / images) if images else 0.0)
    return np.array(weights)
""",
        """
def idf_weights(histograms):
    M = histograms.shape[0]
    M_i = np.count_nonzero(histograms, axis=0)
    ratio = np.ones(len(M_i))
    np.divide(M, M_i, out=ratio, where=M_i > 0)
    return np.log(ratio)
""",
        """
def idf_weights(histograms):
    with np.errstate(divide="ignore"):
        w = -np.log((histograms > 0).mean(axis=0))
    w[np.isinf(w)] = 0
    return w
""",
        """
def idf_weights(histograms):
    has = (np.asarray(histograms) > 0).astype(float)
    M = has.shape[0]
    M_i = has.sum(axis=0)
    return np.where(M_i == 0, 0, np.log(M) - np.log(np.maximum(M_i, 1)))
""",
        """
def idf_weights(histograms):
    M, K = histograms.shape
    weights = np.zeros(K)
    for i in range(K):
        M_i = (histograms[:, i] >= 1).sum()
        if M_i != 0:
            weights[i] = np.log(M / M_i)
    return weights
""",
        """
def idf_weights(histograms):
    M_i = np.ma.masked_equal(np.minimum(histograms, 1).sum(axis=0), 0)
    return np.ma.log(len(histograms) / M_i).filled(0.0)
""",
        """
def idf_weights(histograms):
    rows, columns = np.nonzero(histograms)
    M_i = np.bincount(columns, minlength=histograms.shape[1])
    M_i[M_i == 0] = len(histograms)
    return np.log(len(histograms) / M_i)
""",
    ],
    "Q1.8": [
        """
def l1_scores(query, histograms, weights):
    q = query * weights
    h = histograms * weights
    scores = np.full(len(h), 2.0)
    if q.sum() == 0:
        return scores
    q = q / q.sum()
    sums = h.sum(axis=1)
    full = sums > 0
    scores[full] = np.abs(h[full] / sums[full, None] - q).sum(axis=1)
    return scores
""",
        """
def l1_scores(query, histograms, weights):
    def bag(h):
        weighted = [a * b for a, b in zip(h, weights)]
        total = sum(weighted)
        return [x / total for x in weighted] if total > 0 else None
    q = bag(query)
    scores = []
    for h in histograms:
        b = bag(h)
        scores.append(2.0 if q is None or b is None else sum(abs(x - y) for x, y in zip(q, b)))
    return np.array(scores)
""",
        """
def l1_scores(query, histograms, weights):
    def normalised(h):
        h = np.atleast_2d(h) * weights
        total = h.sum(axis=1, keepdims=True)
        return h / np.where(total > 0, total, 1)
    return 2 - 2 * np.minimum(normalised(query), normalised(histograms)).sum(axis=1)
""",
        """
def l1_scores(query, histograms, weights):
    with np.errstate(divide="ignore", invalid="ignore"):
        q = query * weights / np.sum(query * weights)
        h = (histograms * weights) / (histograms @ weights)[:, None]
    return np.nan_to_num(abs(h - q).sum(axis=1), nan=2.0)
""",
        """
def l1_scores(query, histograms, weights):
    q_total = query @ weights
    scores = []
    for row in histograms:
        total = row @ weights
        if q_total == 0 or total == 0:
            scores.append(2)
            continue
        score = 0
        for i in range(len(weights)):
            score += abs(query[i] * weights[i] / q_total - row[i] * weights[i] / total)
        scores.append(score)
    return scores
""",
        """
def l1_scores(query, histograms, weights):
    bags = np.vstack([query, histograms]) * weights
    total = bags.sum(axis=1)
    empty = total == 0
    total[empty] = 1.0
    bags /= total[:, np.newaxis]
    scores = np.linalg.norm(bags[1:] - bags[0], ord=1, axis=1)
    return np.where(empty[1:] | empty[0], 2.0, scores)
""",
    ],
}

SLIPS = {
    "Q1.3": [
        ("one index for each descriptor", 0, ".argmin(axis=1)", ".argmin(axis=0)"),
        ("the distance is over the coordinates", 0, "axis=2", "axis=1"),
        ("the nearest, not the farthest", 0, "argmin", "argmax"),
        ("the index, not the distance", 0, "argmin", "min"),
        ("Euclidean, not the sum of absolute differences", 0, "axis=2", "axis=2, ord=1"),
        ("Euclidean, not the largest difference", 0, "axis=2", "axis=2, ord=np.inf"),
        ("words count from 0", 0, ".argmin(axis=1)", ".argmin(axis=1) + 1"),
        ("the index, not the centre", 0, "return np", "return words[np", "(axis=1)", "(axis=1)]"),
        (
            "floats, not whole numbers",
            0,
            "descriptors[:, None]",
            "descriptors.astype(int)[:, None]",
        ),
        (
            "floats, not bytes",
            0,
            "descriptors[:, None]",
            "descriptors.astype(np.uint8)[:, None].astype(float)",
        ),
        ("all coordinates", 0, "[:, None] - words[None]", "[:, None, :2] - words[None, :, :2]"),
        (
            "Euclidean: no descriptor is normalised",
            0,
            "descriptors[:, None]",
            "(descriptors / np.linalg.norm(descriptors, axis=1, keepdims=True))[:, None]",
        ),
        ("the first of equal distances", 1, "d < best", "d <= best"),
        ("any distance may be the smallest", 1, "math.inf, 0", "1.0, 0"),
        ("no descriptors give an empty array", 1, "return nearest", "return np.stack(nearest)"),
        ("word 0 is a word", 2, "range(0, len(words))", "range(1, len(words))"),
        ("the last word is a word", 2, "range(0, len(words))", "range(len(words) - 1)"),
        ("the first of equal distances", 2, "d < best", "d <= best"),
        ("a smaller distance replaces the best", 2, "        best = np.minimum(best, d)\n", ""),
        ("differences are squared", 2, ") ** 2).sum", ")).sum"),
        ("Euclidean, not the dot product", 3, " - (W ** 2).sum(axis=1) / 2", ""),
        ("half the squared length", 3, "(axis=1) / 2", "(axis=1)"),
        ("differences are squared", 4, "(a - b) ** 2", "(a - b)"),
        ("the last of equal distances", 5, 'kind="stable")[:, 0]', 'kind="stable")[:, -1]'),
        ("as many words as wanted", 4, "range(len(words))", "range(2)"),
    ],
    "Q1.4": [
        ("the children of row i begin at k i", 0, "first = k * node", "first = node"),
        ("argmin counts from the first child", 0, "node = first + int", "node = int"),
        ("all k children", 0, "first + k]", "first + k - 1]"),
        ("k is the number of children", 0, "k, node = len(levels[0]), 0", "k, node = 2, 0"),
        (
            "k is not the number of levels",
            0,
            "k, node = len(levels[0]), 0",
            "k, node = len(levels), 0",
        ),
        ("down to the last level", 0, "in levels:", "in levels[:-1]:"),
        ("from the first level", 0, "in levels:", "in levels[1:]:"),
        ("as deep as the tree is", 0, "in levels:", "in levels[:2]:"),
        ("as deep as the tree is", 0, "in levels:", "in levels[:3]:"),
        ("Euclidean distance", 0, "axis=1)", "axis=1, ord=1)"),
        ("Euclidean distance", 0, "axis=1)", "axis=1, ord=np.inf)"),
        ("the nearest", 0, "argmin", "argmax"),
        ("rows count from 0", 0, "return node", "return node + 1"),
        (
            "only children of the node reached",
            0,
            "children = level[first:first + k]",
            "children = level",
            "first + int",
            "int",
        ),
        (
            "the row in the last level, not among all nodes",
            0,
            "return node",
            "return node + sum(map(len, levels[:-1]))",
        ),
        ("any k", 0, "len(levels[0])", "int(len(levels[-1]) ** (1 / len(levels)))"),
        (
            "children of row i, not of row i + 1",
            0,
            "first = k * node",
            "first = min(k * (node + 1), len(level) - k)",
        ),
        ("distance is over all coordinates", 2, ".sum(axis=1).argmin()", "[:, 0].argmin()"),
        ("the first of equal distances", 3, "d < best[0]", "d <= best[0]"),
        ("differences are squared", 3, "(a - b) ** 2", "a - b"),
        ("the whole way counts", 3, "return word", "return path[-1]"),
        ("a number, not the way", 3, "return word", "return path"),
        (
            "the word's digits begin at the top",
            3,
            "in path:\n        word",
            "in path[::-1]:\n        word",
        ),
        ("only children of the node reached", 4, "        d[~allowed] = np.inf\n", ""),
        ("Euclidean distance", 5, " - (children * children).sum(axis=-1) / 2", ""),
    ],
    "Q1.5": [
        ("an image stands in a list once", 0, "set(words.tolist())", "words.tolist()"),
        ("images count from 0", 0, "append(image)", "append(image + 1)"),
        (
            "the images of a word, not the words of an image",
            0,
            "return lists",
            "return [sorted(set(w.tolist())) for w in words_by_image]",
        ),
        (
            "a word of no image has an empty list",
            0,
            "return lists",
            "return [one for one in lists if one]",
        ),
        (
            "word_count lists",
            0,
            "range(word_count)",
            "range(1 + max(max(w, default=0) for w in words_by_image))",
        ),
        ("word_count lists", 0, "range(word_count)", "range(word_count + 1)"),
        ("every image of a word", 0, "lists[word].append(image)", "lists[word] = [image]"),
        (
            "every image of a word",
            0,
            ".append(image)",
            ".append(image) if not lists[word] else None",
        ),
        (
            "an image without features keeps its number",
            0,
            "enumerate(words_by_image)",
            "enumerate(w for w in words_by_image if len(w))",
        ),
        (
            "image 0 is an image",
            0,
            "for word in set",
            "for word in image and set",
            "(words.tolist())",
            "(words.tolist()) or []",
        ),
        (
            "words in any order",
            0,
            "set(words.tolist())",
            "words[np.append(True, words[1:] != words[:-1])[:len(words)]].tolist()",
        ),
        (
            "lists, not a table of how often",
            0,
            "return lists",
            "return np.array([np.bincount(w, minlength=word_count) for w in words_by_image]).T.tolist()",
        ),
        ("a list of lists", 0, "return lists", "return dict(enumerate(lists))"),
        (
            "an image may have no features",
            0,
            "enumerate(words_by_image):",
            "enumerate(words_by_image):\n        words[0]",
        ),
        ("once is enough", 6, "count > 0", "count > 1"),
        (
            "an image stands in the list once, however often it has the word",
            6,
            "lists[word].append(image)",
            "lists[word] += [image] * count",
        ),
        ("a word of every image counts", 6, "if count > 0", "if count == 1"),
        ("the last word is a word", 2, "range(word_count)", "range(word_count - 1)"),
        (
            "the last image is an image",
            1,
            "range(len(words_by_image))",
            "range(len(words_by_image) - 1)",
        ),
    ],
    "Q1.6": [
        ("three times votes three times", 0, "in query_words:", "in set(query_words.tolist()):"),
        ("one vote each", 0, ", 1)", ", 2)"),
        (
            "images, not words, get votes",
            0,
            "np.array(inverted_file[word], dtype=int)",
            "min(word, image_count - 1)",
        ),
        ("more than 127 votes", 0, "dtype=int)\n    for", "dtype=np.int8)\n    for"),
        ("more than 255 votes", 0, "dtype=int)\n    for", "dtype=np.uint8)\n    for"),
        ("votes are counted", 0, "dtype=int)\n    for", "dtype=bool)\n    for"),
        ("all votes, not the winner", 0, "return votes", "return votes.argmax()"),
        ("whole numbers, not shares", 0, "return votes", "return votes / max(len(query_words), 1)"),
        ("every image listed", 0, "inverted_file[word], dtype", "inverted_file[word][:1], dtype"),
        (
            "each vote is one, however many images share it",
            0,
            ", 1)",
            ", 1 / max(len(inverted_file[word]), 1))",
            "dtype=int)\n",
            "dtype=float)\n",
        ),
        ("image_count entries", 0, "np.zeros(image_count", "np.zeros(3"),
        ("image_count entries", 0, "np.zeros(image_count", "np.zeros(len(inverted_file)"),
        ("an image without a vote has 0", 1, ", minlength=image_count", ""),
        ("no query words give zeros", 1, "np.array(voted, dtype=int)", "np.array(voted)"),
        ("the first word votes", 0, "in query_words:", "in query_words[1:]:"),
        ("the last word votes", 0, "in query_words:", "in query_words[:-1]:"),
        ("word 0 is a word", 2, "in query_words:", "in filter(None, query_words):"),
        ("image 0 is an image", 2, "range(image_count)", "range(1, image_count)"),
        ("a sum, not whether", 3, "sum(", "max(", "in query_words)", "in [*query_words])"),
        ("several times count several times", 5, "+= count", "+= 1"),
        ("three times is three, not nine", 5, "+= count", "+= count ** 2"),
        ("votes add up", 5, "+= count", "= count"),
        (
            "only counts that are its own",
            5,
            "for image in inverted_file[word]:",
            "for image in range(len(inverted_file[word])):",
        ),
    ],
    "Q1.7": [
        (
            "images are counted, not features",
            0,
            "sum(1 for count in column if count > 0)",
            "column.sum()",
        ),
        ("a word of no image weighs 0", 0, "if images else 0.0", "if images else math.log(M)"),
        ("a word of no image weighs 0", 0, "if images else 0.0", "if images else math.inf"),
        ("the natural logarithm", 0, "math.log(", "math.log10("),
        ("the natural logarithm", 0, "math.log(", "math.log2("),
        ("the logarithm", 0, "math.log(M / images)", "M / images"),
        ("M through M_i", 0, "M / images", "images / M"),
        ("not M_i + 1", 0, "M / images", "M / (images + 1)"),
        ("nothing is added", 0, "math.log(M / images)", "math.log((M + 1) / (images + 1)) + 1"),
        ("M is the number of images", 0, "len(histograms)", "histograms.shape[1]"),
        ("M is not always 4", 0, "len(histograms)", "4"),
        (
            "an image without features is an image",
            0,
            "len(histograms)",
            "sum(row.any() for row in histograms)",
        ),
        ("not a whole division", 0, "M / images", "M // images"),
        ("once is enough", 0, "count > 0", "count > 1"),
        ("at all, not exactly once", 0, "count > 0", "count == 1"),
        ("columns are words", 0, "np.transpose(histograms)", "histograms"),
        ("a word of no image has no infinite weight", 2, "    w[np.isinf(w)] = 0\n", ""),
        (
            "a word of no image weighs 0",
            3,
            "np.where(M_i == 0, 0, np.log(M) - np.log(np.maximum(M_i, 1)))",
            "np.log(M) - np.log(np.maximum(M_i, 1))",
        ),
        ("ln, not 1 + ln", 4, "np.log(M / M_i)", "1 + np.log(M / M_i)"),
        ("not its square", 4, "np.log(M / M_i)", "np.log(M / M_i) ** 2"),
        ("not normalised", 4, "return weights", "return weights / max(weights.sum(), 1)"),
        ("one number for each word", 4, "weights = np.zeros(K)", "weights = np.zeros((K, 1))"),
    ],
    "Q1.8": [
        (
            "weights first",
            0,
            "    q = query * weights\n    h = histograms * weights",
            "    q = query / max(query.sum(), 1) * weights\n    h = histograms / np.maximum(histograms.sum(axis=1, keepdims=True), 1) * weights",
            "    q = q / q.sum()\n    sums = h.sum(axis=1)\n    full = sums > 0",
            "    sums = np.ones(len(h))\n    full = h.sum(axis=1) > 0",
        ),
        ("the query is weighted", 0, "q = query * weights", "q = query * 1.0"),
        ("the images are weighted", 0, "h = histograms * weights", "h = histograms * 1.0"),
        (
            "weights count",
            0,
            "h = histograms",
            "weights = np.ones(len(weights))\n    q = query * weights\n    h = histograms",
        ),
        ("the query is divided by its sum", 0, "q = q / q.sum()", "q = q"),
        ("the images are divided by their sums", 0, "h[full] / sums[full, None]", "h[full]"),
        ("the sum, not the greatest entry", 0, "sums = h.sum(axis=1)", "sums = h.max(axis=1)"),
        (
            "the sum, not the length",
            0,
            "sums = h.sum(axis=1)",
            "sums = np.sqrt((h**2).sum(axis=1))",
            "q.sum()\n    sums",
            "np.linalg.norm(q)\n    sums",
        ),
        ("each image its own sum", 0, "sums = h.sum(axis=1)", "sums = np.full(len(h), h.sum())"),
        ("absolute differences", 0, "np.abs(", "np.square("),
        ("absolute differences", 0, "np.abs(", "("),
        (
            "L1, not L2",
            0,
            "np.abs(h[full] / sums[full, None] - q).sum(axis=1)",
            "np.linalg.norm(h[full] / sums[full, None] - q, axis=1)",
        ),
        ("a number for each image", 0, ").sum(axis=1)\n    return", ").sum()\n    return"),
        (
            "2 is nothing shared",
            0,
            "    return scores\n    q",
            "    return 2 - scores\n    q",
            "] - q).sum(axis=1)\n    return scores",
            "] - q).sum(axis=1)\n    return 2 - scores",
        ),
        ("the sum, not its half", 0, "- q).sum(axis=1)", "- q).sum(axis=1) / 2"),
        ("an image without a word scores 2", 0, "np.full(len(h), 2.0)", "np.full(len(h), 1.0)"),
        ("an image without a word scores 2", 0, "np.full(len(h), 2.0)", "np.zeros(len(h))"),
        (
            "a query without a word scores 2",
            0,
            "        return scores\n    q",
            "        return np.zeros(len(h))\n    q",
        ),
        (
            "a word of no weight does not count",
            0,
            "sums = h.sum(axis=1)",
            "sums = histograms.sum(axis=1)",
        ),
        (
            "an image of words without weight scores 2",
            0,
            "full = sums > 0",
            "full = histograms.sum(axis=1) > 0",
        ),
        (
            "all words, not the query's only",
            0,
            "np.abs(h[full] / sums[full, None] - q)",
            "np.abs(h[full] / sums[full, None] - q)[:, q > 0]",
        ),
        (
            "in the images' order",
            0,
            "- q).sum(axis=1)\n    return scores",
            "- q).sum(axis=1)\n    return np.sort(scores)",
        ),
        (
            "the scores, not the best",
            0,
            "- q).sum(axis=1)\n    return scores",
            "- q).sum(axis=1)\n    return scores.argmin()",
        ),
        (
            "an image and a query without a word share nothing",
            1,
            "2.0 if q is None or b is None",
            "0.0 if q is None and b is None else 2.0 if q is None or b is None",
        ),
        ("a score, not a share of the minimum", 2, "2 - 2 * np.minimum", "1 - np.minimum"),
        (
            "no image may end in nan",
            3,
            "np.nan_to_num(abs(h - q).sum(axis=1), nan=2.0)",
            "abs(h - q).sum(axis=1)",
        ),
        ("no image may end in 0", 3, "nan=2.0", "nan=0.0"),
        (
            "an image without a word scores 2",
            5,
            "np.where(empty[1:] | empty[0], 2.0, scores)",
            "scores",
        ),
        ("a query without a word scores 2", 5, "empty[1:] | empty[0]", "empty[1:]"),
        ("an image without a word scores 2", 5, "empty[1:] | empty[0]", "empty[1:] & empty[0]"),
    ],
}
