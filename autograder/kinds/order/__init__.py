"""Order: cards to put in the right order."""
