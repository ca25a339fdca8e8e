"""The kinds of question, a folder each, behind one protocol.

`autograder.kinds.kind` says what a kind does, `autograder.kinds.registry` finds the folders. A
folder holds in ``kind.py`` the object ``KIND``; what runs beside a student's code is in
``inside/`` and imports nothing of the trusted side. The rest of the engine names no kind.
"""
