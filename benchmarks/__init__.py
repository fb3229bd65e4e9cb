"""Developers' stopwatches: what runs, languages and the eye cost. Run from a checkout, not shipped."""
