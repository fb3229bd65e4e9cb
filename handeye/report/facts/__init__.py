"""Facts of a run for display: things seen, felt, planned and found, as values."""
