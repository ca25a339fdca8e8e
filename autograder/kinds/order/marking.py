"""Cards put in order.

The key is a dependency graph. A response is right if no card stands before one that it depends on,
and otherwise earns credit by how few cards would have to be lifted and put back.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import permutations, product

from autograder.kinds.order.answer import OrderAnswer
from autograder.kinds.order.diagnosis import diagnose_order
from autograder.kinds.order.question import Order
from autograder.kinds.order.response import chosen
from autograder.language import _, n_
from autograder.questions.mark import Mark, Part, not_attempted, status_for, stopped


def is_right(order: Sequence[str], answer: OrderAnswer) -> bool:
    """Whether an order of all card ids needs no card moved."""
    after = transitive_closure(answer.before)
    exchanged = _exchanges(tuple(order), answer.interchangeable)
    return any(fewest_moves(cards, after) == 0 for cards in exchanged)


def mark_order(question: Order, answer: OrderAnswer, response: object) -> Mark:
    """Credit ``max(0, 1 - 2*moves/n)``; the untouched start order is not attempted.

    ``response`` is a list of all card ids.
    """
    cards = chosen(question, response)
    if cards is None:
        return stopped(
            question, "unreadable", _("The stored response does not name every card once.")
        )
    order = tuple(cards)
    if order == question.start:
        return not_attempted(
            question, _("The cards are still in the order in which they were dealt.")
        )
    after = transitive_closure(answer.before)
    # Cards with the same text are interchangeable: read them in the way that is best for the
    # student.
    order = min(
        _exchanges(order, answer.interchangeable), key=lambda cards: fewest_moves(cards, after)
    )
    astray = cards_to_move(order, after)
    moves = len(astray)
    credit = max(0.0, 1 - 2 * moves / len(order))
    mistake = diagnosed = None
    if moves == 0:
        feedback = _("Every step comes after the steps it needs.")
    else:
        mistake = next(
            (
                entry
                for entry in answer.alternatives
                if order.index(entry.first) < order.index(entry.second)
            ),
            None,
        )
        exchanged = _exchanges(order, answer.interchangeable)
        all_found = (
            diagnose_order(cards, answer.order, after, question.texts) for cards in exchanged
        )
        found = next(filter(None, all_found), None)
        # What the author says about two cards explains no more than that one of them is astray.
        if mistake is None or moves > 1:
            diagnosed = found
        feedback = n_(
            "{count} card would have to move.", "{count} cards would have to move.", moves
        ).format(count=moves)
        feedback += f" {diagnosed.sentence}" if diagnosed else ""
        feedback += (
            f" {mistake.feedback}" if mistake else " " + _first_conflict(question, order, after)
        )
    named = diagnosed or mistake
    texts = question.texts
    explanation = "\n".join(f"{n}. {texts[card]}" for n, card in enumerate(answer.order, 1))
    if answer.explanation:
        explanation += f"\n\n{answer.explanation}"
    return Mark(
        question.id,
        status_for(credit),
        credit,
        question.points,
        feedback,
        alternative="right" if moves == 0 else named.name if named else None,
        parts=tuple(
            Part(_("Card {number}").format(number=n), False, "", _where(card, answer, texts))
            if card in astray
            else Part(_("Card {number}").format(number=n), True, "")
            for n, card in enumerate(order, 1)
        ),
        explanation=explanation,
        understood=" › ".join(texts[card] for card in order),
    )


def transitive_closure(before: Iterable[tuple[str, str]]) -> dict[str, set[str]]:
    """For each card, all the cards that must stand after it, directly or not."""
    direct: dict[str, set[str]] = {}
    for first, second in before:
        direct.setdefault(first, set()).add(second)

    def followers(card: str, seen: set[str]) -> set[str]:
        for following in direct.get(card, ()):
            if following not in seen:
                seen.add(following)
                followers(following, seen)
        return seen

    return {card: followers(card, set()) for card in direct}


def fewest_moves(order: Sequence[str], after: dict[str, set[str]]) -> int:
    """The fewest cards to lift and put back until the order respects the graph."""
    return len(cards_to_move(order, after))


def cards_to_move(order: Sequence[str], after: dict[str, set[str]]) -> set[str]:
    """A smallest set of cards to lift and put back until the order respects the graph.

    The cards that stay must hold no conflict, a pair that stands the wrong way round. Conflicts are
    transitive, so they partially order the cards, and a set without conflict is an antichain of
    that order. By Dilworth's theorem the largest one has as many cards as chains are needed to
    cover all, which is n minus a maximum bipartite matching of the conflicts: the matching is the
    number of moves. König's theorem gives the cards themselves, as a smallest set of ends that
    every conflict touches.
    """
    conflicts = {
        earlier: [later for later in order[position + 1 :] if earlier in after.get(later, ())]
        for position, earlier in enumerate(order)
    }
    partner: dict[str, str] = {}  # later card -> the earlier card it is matched with

    def match(card: str, tried: set[str]) -> bool:
        for other in conflicts[card]:
            if other not in tried:
                tried.add(other)
                if other not in partner or match(partner[other], tried):
                    partner[other] = card
                    return True
        return False

    for card in order:
        match(card, set())

    # What can be reached by alternating paths from the earlier cards without a partner.
    reached = [card for card in order if card not in partner.values()]
    reached_later: set[str] = set()
    for card in reached:
        for other in conflicts[card]:
            if other not in reached_later:
                reached_later.add(other)
                reached.append(partner[other])
    return (set(order) - set(reached)) | reached_later


def _exchanges(
    order: tuple[str, ...], groups: Sequence[Sequence[str]]
) -> Iterator[tuple[str, ...]]:
    for choice in product(*(permutations(group) for group in groups)):
        rename = {
            card: new
            for group, permuted in zip(groups, choice, strict=True)
            for card, new in zip(group, permuted, strict=True)
        }
        yield tuple(rename.get(card, card) for card in order)


def _where(card: str, answer: OrderAnswer, texts: dict[str, str]) -> str:
    """Between which cards a card belongs that stands on the wrong side of one of them."""
    earlier = {f"“{texts[first]}”": None for first, second in answer.before if second == card}
    later = {f"“{texts[second]}”": None for first, second in answer.before if first == card}
    both = f" {_('and')} "
    if earlier and later:
        sentence = _("“{card}” comes after {earlier} and before {later}.")
    elif earlier:
        sentence = _("“{card}” comes after {earlier}.")
    else:
        sentence = _("“{card}” comes before {later}.")
    return sentence.format(card=texts[card], earlier=both.join(earlier), later=both.join(later))


def _first_conflict(question: Order, order: Sequence[str], after: dict[str, set[str]]) -> str:
    texts = question.texts
    for position, later in enumerate(order):
        for earlier in order[:position]:
            if earlier in after.get(later, ()):
                return _(
                    "“{first}” stands before “{second}”. "
                    "Ask which of the two needs the other's result."
                ).format(first=texts[earlier], second=texts[later])
    return ""
