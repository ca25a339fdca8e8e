"""The student's side: what runs in a notebook's kernel. No key ever comes here."""
