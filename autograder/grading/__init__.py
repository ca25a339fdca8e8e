"""How one submission is graded, and what another run would change."""
