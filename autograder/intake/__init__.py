"""What was handed in: zips, notebooks, people and times. Trusts nothing that it reads."""
