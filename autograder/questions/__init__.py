"""What questions, answers and marks of all kinds share, and the protocol of a kind.

`autograder.questions.kind_protocol` is the protocol, `autograder.questions.registry` finds the
kinds in `autograder.kinds`, in other distributions and in courses.
"""
