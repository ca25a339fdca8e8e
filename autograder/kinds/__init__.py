"""The kinds of question, a folder each, behind `autograder.questions.kind_protocol`.

A folder holds in ``kind.py`` the object ``KIND``; what runs beside a student's code is in
``inside/`` and imports nothing of the trusted side. The rest of the engine names no kind.
"""
