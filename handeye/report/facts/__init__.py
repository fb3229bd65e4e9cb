"""Facts of a run for whoever shows it: what was seen, felt, planned and found, as values."""
