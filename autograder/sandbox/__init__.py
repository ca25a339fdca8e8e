"""Isolation of student code, and nothing else.

Who starts whom, from the trusted side to the student's::

    Sandbox          (launcher.py)   one for each worker of a run; asks ``tiers.py`` what works here
      Session        (session.py)    one notebook of one submission: runs it, evaluates responses
        Conversation (conversation.py)  questions to one child, each with a nonce and a time
        Host         (host.py)       one process inside the isolation, used for many notebooks;
                                     zygote_start.py starts it
    ----------------------------------------------------------------- bubblewrap, a user of its own
          zygote     (inside/zygote.py)          everything imported, no key; forks
    ----------------------------------------------------------------- Landlock, seccomp, limits
            child    (inside/notebook_child.py)  one notebook: student code runs from here on
              fork   (the same)                  one response, so that a crash costs one question

With ``--no-sandbox`` `no_isolation.py` starts ``inside/plain_process.py`` in place of host, zygote
and child.

Messages cross in `autograder.exchange`. Nothing that comes back is believed: `Conversation` takes
only answers that carry the nonce of its question, and `Session` has them cleaned by
`autograder.exchange.replies`.
"""
