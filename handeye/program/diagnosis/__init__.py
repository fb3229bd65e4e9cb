"""Facts about failures in a plan or a run, and sentences for them."""
