"""The same with all hypotheses in one matrix product."""
