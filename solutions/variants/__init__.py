"""Right work in other clothes: responses that must earn everything, whatever the hidden inputs.

A module holds the ways to write the function of its name; every function without a leading
underscore is one. `typed.toml` holds equal forms of the expressions, as students type them.
`autograder check` tries them all.
"""
