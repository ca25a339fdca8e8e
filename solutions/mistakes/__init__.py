"""Known wrong implementations, one per misconception; each is complete, so that it can run."""
