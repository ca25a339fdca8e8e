"""Functions to read: which of some is right, and what does one that is wrong return?"""

from __future__ import annotations

from dataclasses import dataclass

from autograder.exchange.messages import Value
from autograder.language import _

LETTERS = "ABCDEFGH"


@dataclass(frozen=True)
class Reading:
    """Some functions, one of them right, and a call of one that is wrong.

    ``codes`` are their sources; ``called`` is the wrong one of the second question, ``call`` the
    call as a reader sees it, and ``values`` what it may return, of which ``returned`` is true.
    ``remarks`` say of each function that is wrong what is wrong with it.
    """

    codes: tuple[str, ...]
    right: int
    called: int
    call: str
    values: tuple[str, ...]
    returned: int
    remarks: tuple[str, ...]

    def shown(self) -> dict[str, Value]:
        """What is asked, without what is true."""
        return {
            "codes": list(self.codes),
            "called": LETTERS[self.called],
            "call": self.call,
            "values": list(self.values),
        }

    def mark(self, chosen: object, returned: object) -> dict[str, Value]:
        """What is said of the two answers, which are numbers from 0."""
        found, computed = chosen == self.right, returned == self.returned
        said = []
        if found:
            said.append(_("{letter} is right.").format(letter=LETTERS[self.right]))
        elif isinstance(chosen, int) and 0 <= chosen < len(self.codes):
            wrong = _("{letter} is not right: {remark}")
            said.append(wrong.format(letter=LETTERS[chosen], remark=self.remarks[chosen]))
            said.append(_("{letter} is.").format(letter=LETTERS[self.right]))
        value = self.values[self.returned]
        if computed:
            returns = _("And {letter} returns {value} there.")
        else:
            returns = _("{letter} returns {value} there.")
        said.append(returns.format(letter=LETTERS[self.called], value=f"`{value}`"))
        if chosen != self.called:
            about = _("About {letter}: {remark}")
            remark = self.remarks[self.called]
            said.append(about.format(letter=LETTERS[self.called], remark=remark))
        return {"right": found and computed, "parts": [found, computed], "said": " ".join(said)}
