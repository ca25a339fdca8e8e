"""How one submission is graded, how a class is spread, and what another run would change.

`submission` and `chapter` grade one submission. `whole_class` reads a class and hands each
submission to a `spread.Spread`: `threads` here. `graded` is what comes back.
"""
