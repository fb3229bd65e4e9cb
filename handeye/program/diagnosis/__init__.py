"""Failures in a plan or a run, as facts, and the sentences that describe them."""
